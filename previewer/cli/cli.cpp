// SPDX-License-Identifier: Apache-2.0
#include "cli/cli.h"

#include <csignal>
#include <exception>
#include <new>

#include "cli/commands.h"
#include "core/json_fault.h"
#include "core/log.h"

namespace bounce::cli {

int run(int argc, char** argv) {
    // A file that grows past the limit of `ulimit -f` is then an error of the write, which is told, and not
    // the end.
    std::signal(SIGXFSZ, SIG_IGN);
    CLI::App app{
        "Bounce previews animated scenes with global illumination and says how far from Cycles they are."};
    app.name("bounce");
    app.set_version_flag("--version", "bounce " BOUNCE_VERSION);
    app.require_subcommand(1);
    bool verbose = false;
    app.add_flag("-v,--verbose", verbose, "Say more about what is being done");

    Run run_command;
    add_render(app, run_command);
    add_compare(app, run_command);
    add_convert(app, run_command);
    add_view(app, run_command);
    add_info(app, run_command);
    add_evaluate(app, run_command);
    add_bench(app, run_command);

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) {  // --help, --version
            return app.exit(error);
        }
        log::error("{} (see bounce --help)", error.what());
        return static_cast<int>(ExitCode::usage);
    }
    log::set_threshold(verbose ? log::Level::debug : log::Level::info);

    try {
        return static_cast<int>(run_command());
    } catch (const Error& error) {
        log::error("{}", error.what());
        return static_cast<int>(error.code());
    } catch (const std::bad_alloc&) {
        log::error("out of memory; try a smaller --size or scene");
        return static_cast<int>(ExitCode::failed);
    } catch (const nlohmann::json::exception& error) {
        log::error("unexpected failure, which is a defect of bounce: of a JSON text, {}", json_fault(error));
        return static_cast<int>(ExitCode::failed);
    } catch (const std::exception& error) {
        log::error("unexpected failure, which is a defect of bounce: {}", error.what());
        return static_cast<int>(ExitCode::failed);
    }
}

}  // namespace bounce::cli
