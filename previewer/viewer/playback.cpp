// SPDX-License-Identifier: Apache-2.0
#include "viewer/playback.h"

#include <algorithm>
#include <cmath>

namespace bounce::viewer {

void Playback::set_range(const scene::FrameRange& range) {
    range_ = range;
    frame_ = std::clamp(frame_, range_.start, last_frame());
}

void Playback::show(int frame, double since_s) {
    frame_ = frame;
    since_s_ = since_s;
}

void Playback::play(double now_s) {
    if (count() < 2) {
        return;
    }
    const bool over = !loop_ && frame_ == last_frame();
    show(over ? range_.start : frame_, now_s);
    playing_ = true;
}

void Playback::seek(int frame, double now_s) {
    show(std::clamp(frame, range_.start, last_frame()), now_s);
}

void Playback::step(int frames) {
    playing_ = false;
    const int offset = (frame_ - range_.start + frames) % count();
    frame_ = range_.start + (offset < 0 ? offset + count() : offset);
}

void Playback::set_pace(Pace pace, double now_s) {
    pace_ = pace;
    since_s_ = now_s;
}

double Playback::seconds_to_next(double now_s) const {
    return std::max(0.0, since_s_ + 1.0 / range_.fps - now_s);
}

bool Playback::advance(double now_s) {
    // A hair of tolerance: sums of 1/fps are not exact, and a frame that is due is due.
    constexpr double hair = 1e-6;
    const double due = std::floor((now_s - since_s_) * range_.fps + hair);
    if (!playing_ || due < 1.0) {
        return false;
    }
    const int before = frame_;
    const bool realtime = pace_ == Pace::realtime;
    // Whole turns of a loop change nothing but the schedule; the remainder fits an int.
    const double passed = realtime ? due : 1.0;
    if (!loop_ && frame_ + passed >= last_frame()) {
        show(last_frame(), now_s);
        playing_ = false;
        return frame_ != before;
    }
    const int offset = frame_ - range_.start + static_cast<int>(std::fmod(passed, count()));
    // Real time keeps its schedule, so that rounding up to whole frames does not add up; showing every
    // frame starts a new one from now.
    show(range_.start + offset % count(), realtime ? since_s_ + due / range_.fps : now_s);
    return frame_ != before;
}

}  // namespace bounce::viewer
