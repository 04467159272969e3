#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/common/light_argument.h"
#include "apps/common/picture.h"
#include "apps/common/relit_asset.h"
#include "apps/prt/arguments.h"
#include "apps/prt/brdf_argument.h"
#include "apps/prt/commands.h"
#include "apps/prt/interrupts.h"
#include "apps/prt/light_window.h"
#include "apps/prt/limits.h"
#include "apps/prt/prepared_asset.h"
#include "apps/prt/stage_log.h"
#include "apps/prt/view_options.h"
#include "prt/base/file.h"
#include "prt/render/mirror_shading.h"
#include "prt/render/render_view.h"

namespace prt::cli {
namespace {

struct RenderArguments {
    std::string asset;
    std::string light;
    std::string output;
    ViewArguments view;
    std::optional<ShownTransport> transport;
    std::vector<BrdfArgument> brdfs;
    Vec3d rotationDegrees{0.0, 0.0, 0.0};
    std::string window = "none";
    DisplayOptions display;
    bool background = false;
    ReaderLimits limits;
};

/// The light as it is turned and smoothed for what is shown of the asset.
Lighting prepareLighting(const RenderArguments& arguments, const Asset& asset,
                         const LightSource& light, ShownTransport shown) {
    const Lighting turned = rotate(light.lighting, rotationFromDegrees(arguments.rotationDegrees));
    return lowerRinging(turned, arguments.window,
                        [&] { return deringForAsset(asset, arguments.asset, shown, turned); });
}

Image renderPicture(const RenderArguments& arguments, const Asset& asset, const LightSource& light,
                    StageLog& log) {
    const GivenBrdfs brdfs = resolveBrdfs(asset.scene, arguments.brdfs, arguments.asset);
    const ShownTransport shown = chooseShown(asset, arguments.asset, arguments.transport, brdfs);
    for (const std::string& sentence : describeLostLobes(asset, shown, brdfs))
        log.warn(sentence);
    const Camera camera = chooseCamera(arguments.view, asset.scene, arguments.asset);
    const Mat3d rotation = rotationFromDegrees(arguments.rotationDegrees);

    Stopwatch watch;
    AssetRelighter relighter(asset, arguments.asset, brdfs);
    const std::vector<ExitRadiance> vertexRadiance =
        relighter.relight(shown, prepareLighting(arguments, asset, light, shown), camera.eye);
    log.finishStage(
        "relight", watch.seconds(),
        fmt::format("{}, {} bands", shownTransportName(shown), light.lighting.bandCount));

    std::optional<Environment> background;
    if (arguments.background) background = makeBackground(light);
    std::optional<MirrorEnvironment> mirrors;
    if (hasMirrors(vertexRadiance)) {
        watch = Stopwatch();
        mirrors = makeMirrorEnvironment(makeMirroredLight(light), rotation);
        log.finishStage("prefilter", watch.seconds(), "the light for mirror-like surfaces");
    }
    const RayScene rays(asset.scene);
    return renderView(asset.scene, rays, vertexRadiance, camera,
                      {.width = arguments.view.size.width,
                       .height = arguments.view.size.height,
                       .background = background ? &*background : nullptr,
                       .worldFromBackground = rotation,
                       .mirrors = mirrors ? &*mirrors : nullptr,
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
          prt render spheres.prt.glb --light museum.exr --brdf merl:gold-paint.binary -o gold.png

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
    addParsedOption(*command, "--transport", arguments->transport, parseShownTransport,
                    kShownTransportForms, "how much of light transport to show [all there is]");
    addBrdfOption(*command, arguments->brdfs);
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
