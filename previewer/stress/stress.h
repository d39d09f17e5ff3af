// SPDX-License-Identifier: Apache-2.0
//
// Stiff and extreme scenes, each generated, with what must come of it: a picture within a tolerance or a
// clear refusal. docs/stress.md has the table.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/error.h"
#include "image/image.h"
#include "renderer/renderer.h"
#include "renderer/settings.h"
#include "stress/scene_file.h"

namespace bounce::stress {

struct Picture {
    Image image;
    FrameReport report;
    std::vector<std::string> warnings;  // of the loader
    [[nodiscard]] glm::dvec3 at(int x, int y) const;
    [[nodiscard]] double mean() const;
};

// What came of a case.
struct Verdict {
    bool as_expected = false;
    std::string got;
    double bias = 0.0;  // mean over the expected picture's, less one; NaN where there is none
};

// How far a picture may be from the expected one: its worst value, over that pixel's or the picture's mean,
// whichever is more; and its mean, over the mean. The case says why.
struct Tolerance {
    double worst = 0.0;
    double mean = 0.0;
};

// How much of the heavy cases is done.
enum class Size { small, full };

// What a case draws with. Needs a current context.
class StressRun {
  public:
    StressRun(std::filesystem::path folder, Size size, bool every_technique);

    // 48x32 pixels, few lights, small maps, no antialiasing, every pass searched for what is not finite.
    [[nodiscard]] static Settings settings();
    [[nodiscard]] bool full() const { return size_ == Size::full; }
    // Writes the file, loads and draws it. With every_technique also by the others, whose pictures must be
    // finite. Throws what loading and drawing do.
    Picture draw(const SceneFile& file, const Settings& with = settings(), double frame = 1.0);

  private:
    std::filesystem::path folder_;
    Size size_;
    bool every_technique_;
    int files_ = 0;
};

struct StressCase {
    std::string name;
    std::string expected;  // with the tolerance, and why it is this
    Verdict (*run)(StressRun& run);
};

// By subject, in the order of docs/stress.md.
[[nodiscard]] std::vector<StressCase> light_cases();
[[nodiscard]] std::vector<StressCase> geometry_cases();
[[nodiscard]] std::vector<StressCase> surface_cases();
[[nodiscard]] std::vector<StressCase> motion_cases();
[[nodiscard]] std::vector<StressCase> picture_cases();
[[nodiscard]] std::vector<StressCase> stress_cases();

struct StressResult {
    Verdict verdict;
    bool finite = true;  // no pass of any picture left a NaN or an infinite value
    double seconds = 0.0;
};
// Runs a case; what it throws is what came of it.
[[nodiscard]] StressResult run_case(const StressCase& of, StressRun& run);

// ---- verdicts ----

[[nodiscard]] Verdict same(const Image& got, const Image& expected, const Tolerance& tolerance);
// Every pixel has this value.
[[nodiscard]] Verdict even(const Image& got, const glm::dvec3& value, const Tolerance& tolerance);
// Nothing but black, and the report says why: a black frame is not silent.
[[nodiscard]] Verdict black_with_note(const Picture& got);
// At most this share of the other picture's light; and where it has none, a note that says why.
[[nodiscard]] Verdict at_most(const Picture& got, const Picture& lit, double share);
// Both verdicts must be as expected.
[[nodiscard]] Verdict both(const Verdict& a, const Verdict& b);
// What drawing throws: the error's code, and words that its sentence has.
[[nodiscard]] Verdict refused(StressRun& run, const SceneFile& file, ExitCode code,
                              const std::vector<std::string>& words, const Settings& with);

}  // namespace bounce::stress
