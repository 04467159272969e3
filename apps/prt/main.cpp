#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "apps/prt/commands.h"
#include "apps/prt/help_formatter.h"
#include "apps/prt/interrupts.h"
#include "apps/prt/memory.h"
#include "prt/base/error.h"

namespace {

enum ExitCode { kDone = 0, kFailed = 1, kWrongUsage = 2 };

constexpr const char* kDescription =
    R"(Bakes a scene's light transport once, so that any environment can relight it in real time.

  prt scene teapot -o teapot.glb           a scene to begin with; or take your own
  prt bake teapot.glb -o teapot.prt.glb    once: rays become transfer coefficients
  prt render teapot.prt.glb --light sun:60,45,10 -o teapot.png
                                           as often as you like, under any light
  prt view teapot.prt.glb                  in a window: turn the light, and see it at once
  prt web teapot.prt.glb -o teapot.html    the same in one page, for anyone with a browser)";

constexpr const char* kFooter =
    R"(SCENE is a .gltf, .glb, .obj or .ply file. LIGHT is an environment image, uniform:r,g,b,
sun:azimuth,elevation,angle, sky:… or daylight:azimuth,elevation, or the JSON that `prt light` writes
(see prt light --help).
Exit codes: 0 done, 1 the data or the machine is at fault, 2 wrong usage, 75 interrupted (see --checkpoint).)";

int fail(ExitCode code, const std::string& message) {
    std::fputs(("prt: error: " + message + "\n").c_str(), stderr);
    return code;
}

int exitCodeOf(const prt::Error& error) {
    if (error.code() == prt::ErrorCode::cancelled) {
        const std::string hint = error.hint().empty() ? "" : " (" + error.hint() + ")";
        std::fputs(("prt: interrupted" + hint + "\n").c_str(), stderr);
        return prt::cli::kInterruptedExitCode;
    }
    const bool wrongUsage = error.code() == prt::ErrorCode::invalidOption;
    return fail(wrongUsage ? kWrongUsage : kFailed, error.message());
}

/// Help and version are asked for by "errors" with exit code 0, all others are wrong usage.
int exitCodeOf(const CLI::App& app, const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    if (app.get_subcommands().empty() && app.remaining_size() > 0)
        return fail(kWrongUsage, fmt::format("there is no command {} (see prt --help)",
                                             app.remaining().front()));
    std::string command = "prt";
    for (const CLI::App* chosen : app.get_subcommands())
        command += " " + chosen->get_name();
    return fail(kWrongUsage, fmt::format("{} (see {} --help)", error.what(), command));
}

/// Reads the command line and does what it says.
int runCommand(int argumentCount, char** arguments) {
    CLI::App app(kDescription, "prt");
    app.formatter(std::make_shared<prt::cli::HelpFormatter>());
    app.set_version_flag("--version", "prt " PRT_VERSION, "show the version");
    app.footer(kFooter);
    app.set_help_flag("-h,--help", "show this help");
    app.require_subcommand(1);
    prt::cli::addSceneCommand(app);
    prt::cli::addBakeCommand(app);
    prt::cli::addMergeCommand(app);
    prt::cli::addCompressCommand(app);
    prt::cli::addLightCommand(app);
    prt::cli::addBrdfCommand(app);
    prt::cli::addRenderCommand(app);
    prt::cli::addExportCommand(app);
    prt::cli::addWebCommand(app);
    prt::cli::addCompareCommand(app);
    prt::cli::addViewCommand(app);
    prt::cli::addInfoCommand(app);
    prt::cli::addCheckCommand(app);
    try {
        app.parse(argumentCount, arguments);
    } catch (const CLI::ParseError& error) {
        return exitCodeOf(app, error);
    }
    return kDone;
}

int run(int argumentCount, char** arguments) {
    try {
        return runCommand(argumentCount, arguments);
    } catch (const prt::Error& error) {
        return exitCodeOf(error);
    } catch (const std::bad_alloc&) {
        // Without an allocation, for there may be no memory for one.
        std::fputs(
            "prt: error: the machine has too little memory for this (use a smaller scene or "
            "fewer bands)\n",
            stderr);
        return kFailed;
    } catch (const std::system_error& error) {
        // Only printing lets these through: the library's own come as Error.
        return fail(kFailed, std::string("standard output: cannot be written: ") + error.what());
    } catch (const std::exception& error) {
        return fail(kFailed, error.what());
    }
}

}  // namespace

int main(int argumentCount, char** arguments) {
    prt::cli::installInterruptHandler();
    prt::cli::reserveMemoryForTheEnd();
    // A file-size limit then shows as a failed write, which names the file.
    std::signal(SIGXFSZ, SIG_IGN);
    const int exitCode = run(argumentCount, arguments);
    if (std::fflush(stdout) != 0) return fail(kFailed, "standard output: cannot be written");
    return exitCode;
}
