#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/prt/arguments.h"
#include "apps/prt/commands.h"
#include "apps/prt/interrupts.h"
#include "apps/prt/light_argument.h"
#include "apps/prt/light_window.h"
#include "apps/prt/limits.h"
#include "apps/prt/picture.h"
#include "apps/prt/relit_asset.h"
#include "apps/prt/stage_log.h"
#include "apps/prt/view_options.h"
#include "prt/base/file.h"
#include "prt/render/render_view.h"

namespace prt::cli {
namespace {

struct RenderArguments {
    std::string asset;
    std::string light;
    std::string output;
    ViewArguments view;
    std::optional<Transport> transport;
    Vec3d rotationDegrees{0.0, 0.0, 0.0};
    std::string window = "none";
    DisplayOptions display;
    bool background = false;
    ReaderLimits limits;
};

Image renderPicture(const RenderArguments& arguments, const Asset& asset, const LightSource& light,
                    StageLog& log) {
    const Transport transport = arguments.transport.value_or(fullestTransport(asset.transfer));
    const Camera camera = chooseCamera(arguments.view, asset.scene, arguments.asset);
    const Mat3d rotation = rotationFromDegrees(arguments.rotationDegrees);

    const Stopwatch watch;
    const Lighting turned = rotate(light.lighting, rotation);
    const Lighting lighting = lowerRinging(turned, arguments.window, [&] {
        return deringForAsset(asset, arguments.asset, transport, turned);
    });
    const std::vector<Vec3f> vertexRadiance =
        relightVertices(asset, arguments.asset, transport, lighting);
    log.finishStage(
        "relight", watch.seconds(),
        fmt::format("{}, {} bands", transportName(transport), light.lighting.bandCount));

    std::optional<Environment> background;
    if (arguments.background) background = makeBackground(light);
    const RayScene rays(asset.scene);
    return renderView(asset.scene, rays, vertexRadiance, camera,
                      {.width = arguments.view.size.width,
                       .height = arguments.view.size.height,
                       .background = background ? &*background : nullptr,
                       .worldFromBackground = rotation,
                       .progress = log.callback()});
}

void runRender(const RenderArguments& arguments) {
    requireSuffix(arguments.output, kPictureSuffixes);
    {
        const DeferInterrupts whileProbing;
        checkWritable(arguments.output);
    }
    stopIfInterrupted();

    StageLog log;
    const ImageLimits limits = arguments.limits.images();
    const Asset asset = readPreparedAsset(arguments.asset, limits, log);
    const LightSource light = loadLight(arguments.light, asset.transfer.bandCount, {}, limits);
    if (const auto mending = describeMending(light.mended))
        log.warn(arguments.light + ": " + *mending);
    const Image picture = renderPicture(arguments, asset, light, log);

    const DeferInterrupts whileWriting;
    const Stopwatch watch;
    writePicture(arguments.output, picture, arguments.display);
    log.finishStage("write", watch.seconds(), arguments.output);
}

constexpr const char* kFooter =
    R"(Examples: prt render statue.prt.glb --light museum.exr --background -o statue.png
          prt render statue.prt.glb --light sun:30,45,0.53 --transport shadowed -o statue.exr

A .png is a picture for the screen: exposure, tone curve, sRGB. An .exr is linear radiance,
untouched.

)";

}  // namespace

void addRenderCommand(CLI::App& app) {
    const auto arguments = std::make_shared<RenderArguments>();
    CLI::App* command =
        app.add_subcommand("render", "Draw a baked asset under a light: OUT.png or OUT.exr");
    command->footer(std::string(kFooter) + kLightHelp);
    command->add_option("ASSET", arguments->asset, "what prt bake wrote")->required();
    command->add_option("--light", arguments->light, "the light, as below")
        ->type_name("LIGHT")
        ->required();
    command->add_option("-o,--output", arguments->output, "the picture to write")
        ->type_name("OUT.png|exr")
        ->required();
    addParsedOption(*command, "--transport", arguments->transport, parseTransport,
                    "unshadowed|shadowed|interreflected",
                    "how much of light transport to show [all there is]");
    addRotationOption(*command, arguments->rotationDegrees);
    addWindowOption(*command, arguments->window,
                    "lower ringing; auto: as little as leaves no negative reflection");
    addViewOptions(*command, arguments->view);
    const auto [exposure, tone] = addDisplayOptions(*command, arguments->display, " (.png)");
    command->add_flag("--background", arguments->background,
                      "show the light where no surface is, instead of black");
    addPixelLimit(*command, arguments->limits);

    command->callback([arguments, exposure = exposure, tone = tone] {
        if (isExr(arguments->output) && exposure->count() + tone->count() > 0)
            throw CLI::ValidationError("--exposure and --tone",
                                       "an .exr is linear radiance and takes neither");
        runRender(*arguments);
    });
}

}  // namespace prt::cli
