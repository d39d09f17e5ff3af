// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

namespace bounce::viewer {

// What to do when drawing takes longer than a frame lasts.
enum class Pace {
    realtime,     // frames are dropped, so that the motion has its true speed
    every_frame,  // none is dropped; the motion slows down
};

// Which frame is shown. Knows no clock: the caller says what time it is, in seconds from any start.
class Playback {
  public:
    explicit Playback(const scene::FrameRange& range) : range_(range), frame_(range.start) {}

    // Goes on with another range (the scene was loaded again); the frame is kept where it lies in it.
    void set_range(const scene::FrameRange& range);

    // At the end and not looping, playing starts over.
    void play(double now_s);
    void pause() { playing_ = false; }
    void toggle(double now_s) { playing_ ? pause() : play(now_s); }
    // Frames beyond the range stop at its ends. Playing goes on from there.
    void seek(int frame, double now_s);
    // One frame on or back, past the ends to the other end; pauses.
    void step(int frames);
    void set_loop(bool loop) { loop_ = loop; }
    void set_pace(Pace pace, double now_s);

    // To be called before drawing. True where the frame is another one than before.
    bool advance(double now_s);
    // How long the frame still lasts, from now_s; 0 where the next one is due. Playing only.
    [[nodiscard]] double seconds_to_next(double now_s) const;

    [[nodiscard]] int frame() const { return frame_; }
    [[nodiscard]] double time_s() const { return scene::time_of_frame(range_, frame_); }
    [[nodiscard]] bool playing() const { return playing_; }
    [[nodiscard]] bool loop() const { return loop_; }
    [[nodiscard]] Pace pace() const { return pace_; }
    [[nodiscard]] const scene::FrameRange& range() const { return range_; }
    [[nodiscard]] int last_frame() const { return range_.end > range_.start ? range_.end : range_.start; }

  private:
    [[nodiscard]] int count() const { return last_frame() - range_.start + 1; }
    void show(int frame, double since_s);

    scene::FrameRange range_;
    int frame_;
    bool playing_ = false;
    bool loop_ = true;
    Pace pace_ = Pace::realtime;
    double since_s_ = 0.0;  // when the frame began, by its own schedule
};

}  // namespace bounce::viewer
