// SPDX-License-Identifier: Apache-2.0
#include "cli/tuned_options.h"

#include <algorithm>
#include <array>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.h"
#include "core/log.h"
#include "evaluate/machine.h"
#include "evaluate/tuning.h"

namespace bounce::cli {
namespace {

// Groups of options that say how light is drawn; a file gives no others.
bool chooses_settings(const CLI::Option& option) {
    constexpr std::array<std::string_view, 4> groups{k_light_transport_group, k_rsm_group, k_vpl_group,
                                                     k_ism_group};
    return std::find(groups.begin(), groups.end(), option.get_group()) != groups.end();
}

// An App that takes the options of RenderOptions, the last where one is given twice.
class OptionsParser {
  public:
    OptionsParser() {
        options_.add_to(app_);
        for (CLI::Option* option : app_.get_options()) {
            option->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
        }
    }
    // Once. Throws CLI::Error, and what RenderOptions::check() throws.
    RenderOptions parse(std::vector<std::string> words) {
        std::reverse(words.begin(), words.end());  // CLI11 takes them from the back
        app_.parse(words);
        options_.check();
        return options_;
    }
    [[nodiscard]] const CLI::Option* find(const std::string& name) const {
        return app_.get_option_no_throw(name);
    }

  private:
    CLI::App app_;
    RenderOptions options_;
};

// Throws input_error where the file's settings are none of how light is drawn, or cannot be drawn.
void check_file(const TunedSettings& tuned, const std::string& file) {
    OptionsParser parser;
    for (const std::string& word : tuned.options) {
        if (!word.starts_with("-")) {
            continue;  // a value: no setting has a negative one
        }
        const CLI::Option* option = parser.find(word);
        if (option == nullptr) {
            throw input_error(fmt::format("the tuning file {} gives the unknown option {}", file, word));
        }
        if (!chooses_settings(*option)) {
            throw input_error(fmt::format(
                "the tuning file {} gives {}, which is no option of how light is drawn", file, word));
        }
    }
    const auto refuse = [&](const std::exception& error) {
        throw input_error(fmt::format("the tuning file {} gives \"{}\": {}", file,
                                      fmt::join(tuned.options, " "), error.what()));
    };
    try {
        (void)parser.parse(tuned.options);
    } catch (const CLI::Error& error) {
        refuse(error);
    } catch (const Error& error) {
        refuse(error);
    }
}

const TunedSettings& require_settings(const Tuning& tuning, const RenderOptions& typed) {
    const TunedSettings* tuned = settings_within(tuning, *typed.budget_ms);
    if (tuned == nullptr) {
        throw input_error(
            tuning.budgets.empty()
                ? fmt::format("the tuning file {} has no settings", typed.tuning)
                : fmt::format(
                      "the tuning file {} has no settings for {:g} ms a frame; its least budget is {:g} ms",
                      typed.tuning, *typed.budget_ms, tuning.budgets.front().budget_ms));
    }
    return *tuned;
}

}  // namespace

RenderOptions with_tuning(const CLI::App& command, const RenderOptions& typed) {
    if (!typed.budget_ms && typed.tuning.empty()) {
        return typed;
    }
    if (!typed.budget_ms) {
        throw usage_error(
            "--tuning needs --budget-ms: the file, which bounce evaluate writes as tuning.json, has the "
            "settings "
            "that win within a time a frame");
    }
    if (typed.preset && *typed.preset != "auto") {
        throw usage_error(fmt::format(
            "--preset {} and --budget-ms both choose the settings; give one of them", *typed.preset));
    }
    if (typed.tuning.empty()) {
        return typed;  // by auto's own model
    }
    const Tuning tuning = read_tuning(typed.tuning);
    const TunedSettings& tuned = require_settings(tuning, typed);
    check_file(tuned, typed.tuning);

    OptionsParser parser;
    std::vector<std::string> words = tuned.options;
    for (const CLI::Option* option : command.get_options()) {
        const std::string name = option->get_name();
        // The file's settings are what preset auto is here.
        if (option->count() > 0 && name != "--preset" && parser.find(name) != nullptr) {
            words.insert(words.end(), {name, option->results().back()});
        }
    }
    const std::string settings = fmt::format("{}", fmt::join(tuned.options, " "));
    try {
        RenderOptions merged = parser.parse(words);
        log::info("settings for {:g} ms from {}: {}", tuned.budget_ms, typed.tuning, settings);
        return merged;
    } catch (const Error& error) {
        throw Error(error.code(), fmt::format("{} (with the settings for {:g} ms from {}: {})", error.what(),
                                              tuned.budget_ms, typed.tuning, settings));
    }
}

void note_other_conditions(const RenderOptions& options, const Settings& settings) {
    if (options.tuning.empty()) {
        return;
    }
    const Tuning tuning = read_tuning(options.tuning);
    if (tuning.width != settings.width || tuning.height != settings.height) {
        log::info("note: {} was measured at {}x{}, this is {}x{}; its times are not these frames'",
                  options.tuning, tuning.width, tuning.height, settings.width, settings.height);
    }
    if (const Machine machine = this_machine();
        tuning.cpu != machine.cpu || tuning.threads != machine.threads) {
        log::info(
            "note: {} was measured on {} with {} threads, this is {} with {}; its times are not these "
            "frames'",
            options.tuning, tuning.cpu, tuning.threads, machine.cpu, machine.threads);
    }
}

}  // namespace bounce::cli
