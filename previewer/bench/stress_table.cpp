// SPDX-License-Identifier: Apache-2.0
//
// Stiff and extreme scenes (previewer/stress): what must come of each and what came.
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <unistd.h>

#include "bench/experiments.h"
#include "core/error.h"
#include "core/log.h"
#include "stress/stress.h"

namespace bounce::bench {
namespace {

// Gone with all that is in it.
class ScratchFolder {
  public:
    ScratchFolder()
        : path_(std::filesystem::temp_directory_path() / fmt::format("bounce-stress-{}", getpid())) {
        std::filesystem::create_directories(path_);
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ScratchFolder(ScratchFolder&&) = delete;
    ScratchFolder& operator=(ScratchFolder&&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace

void measure_stress(const BenchInputs& inputs, BenchReport& report) {
    const Settings settings = stress::StressRun::settings();
    report.scene = "generated scenes";
    report.timing = "wall clock of a whole case: files written, loaded and drawn, shaders compiled";
    report.settings = {{"size", fmt::format("{}x{}", settings.width, settings.height)},
                       {"VPLs", std::to_string(settings.vpls)},
                       {"map size", std::to_string(settings.ism_size)}};
    const ScratchFolder folder;
    const bool quick = inputs.options.quick;
    stress::StressRun run(folder.path(), quick ? stress::Size::small : stress::Size::full, !quick);
    Table table{.title = "Stiff and extreme scenes",
                .note = quick ? "Heavy cases are small ones."
                              : "Each is also drawn by five other techniques, "
                                "whose passes must leave nothing that is not "
                                "finite.",
                .columns = {{"case", ""},
                            {"expected", ""},
                            {"got", ""},
                            {"as expected", ""},
                            {"NaN", ""},
                            {"bias", "%"},
                            {"time", "s"}},
                .rows = {}};
    int as_expected = 0;
    for (const stress::StressCase& one : stress::stress_cases()) {
        if (one.name.find(inputs.options.only) == std::string::npos) {
            continue;
        }
        inputs.interrupts.throw_if_interrupted("nothing is written");
        const stress::StressResult result = run_case(one, run);
        const bool good = result.verdict.as_expected && result.finite;
        as_expected += good ? 1 : 0;
        log::info("{:<8}{}: {}", good ? "as must" : "NOT", one.name, result.verdict.got);
        table.rows.push_back({one.name, one.expected, result.verdict.got, good ? "yes" : "NO",
                              result.finite ? "none" : "FOUND",
                              std::isfinite(result.verdict.bias) ? Cell(100.0 * result.verdict.bias) : Cell(),
                              result.seconds});
    }
    if (table.rows.empty()) {
        throw usage_error(fmt::format("no case's name holds '{}'", inputs.options.only));
    }
    report.checks.push_back({"cases as expected", static_cast<double>(as_expected), Check::Kind::at_least,
                             static_cast<double>(table.rows.size()), ""});
    report.tables.push_back(std::move(table));
}

}  // namespace bounce::bench
