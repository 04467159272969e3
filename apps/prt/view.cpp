#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/common/light_argument.h"
#include "apps/common/picture.h"
#include "apps/prt/arguments.h"
#include "apps/prt/commands.h"
#include "apps/prt/limits.h"
#include "apps/prt/stage_log.h"
#include "apps/viewer/frame_benchmark.h"
#include "apps/viewer/offscreen.h"
#include "apps/viewer/window.h"
#include "prt/base/error.h"

namespace prt::cli {
namespace {

/// What an object is seen in where no light is named: a clear day, and a little from below too.
constexpr std::array kFirstLights = {"daylight:150,40", "uniform:5"};

enum class Relit { automatic, cpu, opengl };

std::optional<Relit> parseRelit(std::string_view name) {
    if (name == "auto") return Relit::automatic;
    if (name == "cpu") return Relit::cpu;
    if (name == "opengl") return Relit::opengl;
    return std::nullopt;
}

struct ViewCommandArguments {
    std::vector<std::string> assets;
    std::vector<std::string> lights;
    std::string view;
    std::optional<ShownTransport> transport;
    PictureSize size;
    bool offscreen = false;
    bool panel = false;
    std::string screenshot;
    std::string script;
    int benchmarkFrames = 0;
    std::optional<int> sampleCount;
    int referenceSamples = 64;
    Relit relit = Relit::automatic;
    int threadCount = 0;
    ReaderLimits limits;
};

viewer::ViewState makeView(const ViewCommandArguments& arguments) {
    viewer::ViewState view;
    if (!arguments.view.empty()) view = viewer::loadView(arguments.view);
    for (const std::string& asset : arguments.assets)
        view.objects.push_back({.asset = asset});
    if (view.objects.empty())
        throw CLI::ValidationError("ASSET",
                                   "there is no asset to show, and no --view that names one");
    if (!arguments.lights.empty()) view.lights.clear();
    for (const std::string& light : arguments.lights)
        view.lights.push_back({.source = light});
    if (view.lights.empty())
        for (const char* light : kFirstLights)
            view.lights.push_back({.source = light});
    if (arguments.transport) view.left.transport = arguments.transport;
    return view;
}

std::vector<viewer::ScriptStep> makeScript(const ViewCommandArguments& arguments) {
    std::vector<viewer::ScriptStep> script;
    if (!arguments.script.empty()) script = viewer::loadScript(arguments.script);
    if (!arguments.screenshot.empty()) script.push_back({.screenshot = arguments.screenshot});
    return script;
}

viewer::StageOptions makeStageOptions(const ViewCommandArguments& arguments, bool takesPictures) {
    viewer::StageOptions stage{.limits = arguments.limits.images(),
                               .threadCount = arguments.threadCount};
    if (takesPictures) stage.awaitedPathsPerPixel = arguments.referenceSamples;
    if (arguments.relit != Relit::automatic)
        stage.relightsOnCard = arguments.relit == Relit::opengl;
    return stage;
}

void viewOffscreen(const ViewCommandArguments& arguments, const viewer::ViewState& view) {
    const viewer::OffscreenOptions options{.width = arguments.size.width,
                                           .height = arguments.size.height,
                                           .sampleCount = arguments.sampleCount,
                                           .stage = makeStageOptions(arguments, true)};
    if (arguments.benchmarkFrames > 0) {
        fmt::print("{}", viewer::benchmarkOffscreen(view, arguments.benchmarkFrames, options));
        return;
    }
    StageLog log;
    for (const std::string& fault : viewer::runOffscreen(view, makeScript(arguments), options))
        log.warn(fault);
}

void viewInWindow(const ViewCommandArguments& arguments, const viewer::ViewState& view) {
    const std::vector<viewer::ScriptStep> script = makeScript(arguments);
    const viewer::WindowOptions options{.width = arguments.size.width,
                                        .height = arguments.size.height,
                                        .isPanelOpen = arguments.panel,
                                        .stage = makeStageOptions(arguments, !script.empty()),
                                        .script = script};
    if (arguments.benchmarkFrames > 0)
        fmt::print("{}", viewer::benchmarkWindow(view, arguments.benchmarkFrames, options));
    else
        viewer::runWindow(view, options);
}

constexpr const char* kFooter =
    R"(Examples: prt view statue.prt.glb --light museum.exr
          prt view statue.prt.glb vase.prt.glb --light sky:150,40 --light sun:150,40,0.53
          prt view statue.prt.glb --light museum.exr --offscreen --screenshot statue.png
          prt view statue.prt.glb --benchmark 200 --offscreen

In the window F1 shows all keys; drag to turn the object, with Ctrl to turn the light, and drop
assets, images and saved views onto it. A view that was saved there opens again with --view. A
SCRIPT is a JSON array of steps {"view": {…}, "screenshot": "FILE.png|exr"}, each of which changes
some values of the view, as a saved one names them, and takes a picture. With --offscreen nothing
but OpenGL is needed, no display.

)";

}  // namespace

void addViewCommand(CLI::App& app) {
    const auto arguments = std::make_shared<ViewCommandArguments>();
    CLI::App* command =
        app.add_subcommand("view", "Turn the light around baked assets in a window");
    command->footer(std::string(kFooter) + kLightHelp);
    command->add_option("ASSET", arguments->assets, "what prt bake wrote; several share the light");
    command
        ->add_option("--light", arguments->lights,
                     "a light, as below; again for more, which add up [a clear day]")
        ->type_name("LIGHT");
    command->add_option("--view", arguments->view, "begin with a view that was saved")
        ->type_name("FILE.json");
    addParsedOption(*command, "--transport", arguments->transport, parseShownTransport,
                    kShownTransportForms, "how much of light transport to show [all there is]");
    addParsedOption(*command, "--size", arguments->size, parsePictureSize, "WxH",
                    "of the window, pixels")
        ->default_str(fmt::format("{}x{}", arguments->size.width, arguments->size.height));
    CLI::Option* offscreen =
        command->add_flag("--offscreen", arguments->offscreen, "draw without a window");
    command->add_flag("--panel", arguments->panel, "begin with the window's panel open");
    CLI::Option* screenshot =
        command->add_option("--screenshot", arguments->screenshot, "write a picture, and end");
    screenshot->type_name("OUT.png|exr");
    CLI::Option* script = command->add_option(
        "--script", arguments->script, "change the view and take pictures as it says, and end");
    script->type_name("SCRIPT.json");
    CLI::Option* benchmark =
        addIntegerOption(*command, "--benchmark", arguments->benchmarkFrames, 1, 1'000'000,
                         "turn the light for so many frames, and print their times as JSON");
    benchmark->default_str("");
    benchmark->excludes(screenshot)->excludes(script);
    command
        ->add_option("--samples", arguments->sampleCount,
                     "a pixel, without a window [as in one, at rest or moving]")
        ->check(CLI::Range(1, 64).description(""))
        ->type_name("N");
    addIntegerOption(*command, "--reference-samples", arguments->referenceSamples, 1, 1 << 20,
                     "paths a pixel of a path-traced pane, in pictures that are written");
    addParsedOption(*command, "--relight", arguments->relit, parseRelit, "auto|cpu|opengl",
                    "what relights; auto: opengl on a graphics card")
        ->default_str("auto");
    addIntegerOption(*command, "--threads", arguments->threadCount, 0, 4096, "0 for one a core");
    addPixelLimit(*command, arguments->limits);

    command->callback([arguments, offscreen, screenshot, script, benchmark] {
        if (offscreen->count() > 0 &&
            screenshot->count() + script->count() + benchmark->count() == 0)
            throw CLI::ValidationError("--offscreen",
                                       "needs a --screenshot, a --script or a --benchmark to do");
        const viewer::ViewState view = makeView(*arguments);
        if (arguments->offscreen)
            viewOffscreen(*arguments, view);
        else
            viewInWindow(*arguments, view);
    });
}

}  // namespace prt::cli
