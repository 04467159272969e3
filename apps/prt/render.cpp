#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/common/light_argument.h"
#include "apps/common/picture.h"
#include "apps/common/relit_asset.h"
#include "apps/common/text.h"
#include "apps/prt/arguments.h"
#include "apps/prt/brdf_argument.h"
#include "apps/prt/commands.h"
#include "apps/prt/interrupts.h"
#include "apps/prt/limits.h"
#include "apps/prt/prepared_asset.h"
#include "apps/prt/stage_log.h"
#include "apps/prt/view_options.h"
#include "prt/base/file.h"
#include "prt/gpu/gl_context.h"
#include "prt/gpu/gpu_glossy_relighter.h"
#include "prt/gpu/gpu_picture.h"
#include "prt/gpu/gpu_relighter.h"
#include "prt/gpu/gpu_vertex_radiance.h"
#include "prt/light/resampling.h"
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
    LightingArguments lighting;
    DisplayOptions display;
    bool background = false;
    bool gpu = false;
    ReaderLimits limits;
};

/// What is drawn, by rays or by OpenGL.
struct PreparedView {
    GivenBrdfs brdfs;
    ShownTransport shown = ShownTransport::shadowed;
    Camera camera;
    Mat3d worldFromLight;
    Lighting lighting;
};

PreparedView prepareView(const RenderArguments& arguments, const Asset& asset,
                         const LightSource& light, StageLog& log) {
    PreparedView view;
    view.brdfs = resolveBrdfs(asset.scene, arguments.brdfs, arguments.asset);
    view.shown = chooseShown(asset, arguments.asset, arguments.transport, view.brdfs);
    for (const std::string& sentence : describeLostLobes(asset, view.shown, view.brdfs))
        log.warn(sentence);
    view.camera = chooseCamera(arguments.view, asset.scene, arguments.asset);
    view.worldFromLight = rotationFromDegrees(arguments.lighting.rotationDegrees);
    view.lighting =
        prepareLighting(light.lighting, arguments.lighting, asset, arguments.asset, view.shown);
    return view;
}

std::string describeRelighting(const PreparedView& view) {
    return fmt::format("{}, {}", shownTransportName(view.shown),
                       formatCount(static_cast<std::uint64_t>(view.lighting.bandCount), "band"));
}

std::vector<ExitRadiance> relightVertices(const RenderArguments& arguments, const Asset& asset,
                                          const PreparedView& view) {
    return AssetRelighter(asset, arguments.asset, view.brdfs)
        .relight(view.shown, view.lighting, view.camera.eye);
}

MirrorEnvironment prefilter(Environment mirrored, const PreparedView& view, StageLog& log) {
    const Stopwatch watch;
    MirrorEnvironment mirrors = makeMirrorEnvironment(std::move(mirrored), view.worldFromLight);
    log.finishStage("prefilter", watch.seconds(), "the light for mirror-like surfaces");
    return mirrors;
}

Image drawByRays(const RenderArguments& arguments, const Asset& asset, const LightSource& light,
                 const PreparedView& view, StageLog& log) {
    const Stopwatch watch;
    const std::vector<ExitRadiance> vertexRadiance = relightVertices(arguments, asset, view);
    log.finishStage("relight", watch.seconds(), describeRelighting(view));

    std::optional<Environment> background;
    if (arguments.background) background = makeBackground(light);
    std::optional<MirrorEnvironment> mirrors;
    if (hasMirrors(vertexRadiance)) mirrors = prefilter(makeMirroredLight(light), view, log);
    const RayScene rays(asset.scene);
    return renderView(asset.scene, rays, vertexRadiance, view.camera,
                      {.width = arguments.view.size.width,
                       .height = arguments.view.size.height,
                       .background = background ? &*background : nullptr,
                       .worldFromBackground = view.worldFromLight,
                       .mirrors = mirrors ? &*mirrors : nullptr,
                       .progress = log.callback()});
}

/// All is relit by OpenGL but what diffuse surfaces show by their normals alone.
std::unique_ptr<GpuRadiance> relightOnCard(const RenderArguments& arguments, const Asset& asset,
                                           const PreparedView& view) {
    if (isGlossy(view.shown)) {
        auto relighter = std::make_unique<GpuGlossyRelighter>(
            AssetRelighter(asset, arguments.asset, view.brdfs)
                .makeGlossyRelighter<GpuGlossyRelighter>(view.shown));
        relighter->relight(view.lighting);
        relighter->lookFrom(view.camera.eye);
        return relighter;
    }
    if (const CompressedLayer* layer = findShownLayer(asset.transfer, view.shown)) {
        auto relighter = std::make_unique<GpuRelighter>(asset.transfer, layer->transport);
        relighter->relight(view.lighting);
        return relighter;
    }
    auto uploaded = std::make_unique<GpuVertexRadiance>(asset.scene.vertexCount());
    uploaded->upload(relightVertices(arguments, asset, view));
    return uploaded;
}

/// In the context that is current.
Image drawByOpenGl(const RenderArguments& arguments, const Asset& asset, const LightSource& light,
                   const PreparedView& view, StageLog& log) {
    const GpuScene scene(asset.scene);
    const Stopwatch watch;
    const std::unique_ptr<GpuRadiance> radiance = relightOnCard(arguments, asset, view);
    log.finishStage("relight", watch.seconds(), describeRelighting(view));

    std::optional<GpuBackground> background;
    if (arguments.background) background.emplace(resampleAsLatLong(makeBackground(light)));
    std::optional<GpuMirrors> mirrors;
    if (radiance->hasMirrors())
        mirrors.emplace(prefilter(resampleAsLatLong(makeMirroredLight(light)), view, log));
    return drawGpuPicture(std::array{GpuObject{&scene, radiance.get()}}, view.camera,
                          {.width = arguments.view.size.width,
                           .height = arguments.view.size.height,
                           .background = background ? &*background : nullptr,
                           .worldFromBackground = view.worldFromLight,
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
    std::optional<GlContext> context;
    if (arguments.gpu) {
        context.emplace();
        log.tell("drawn by " + describeDriver());
    }
    const ImageLimits limits = arguments.limits.images();
    const Asset asset = readPreparedAsset(arguments.asset, limits, log);
    const LightSource light = loadLight(arguments.light, asset.transfer.bandCount, {}, limits);
    if (const auto mending = describeMending(light.mended))
        log.warn(arguments.light + ": " + *mending);
    const PreparedView view = prepareView(arguments, asset, light, log);
    const Image picture = arguments.gpu ? drawByOpenGl(arguments, asset, light, view, log)
                                        : drawByRays(arguments, asset, light, view, log);

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
    addLightingOptions(*command, arguments->lighting);
    addViewOptions(*command, arguments->view);
    const auto [exposure, tone] = addDisplayOptions(*command, arguments->display, " (.png)");
    command->add_flag("--background", arguments->background,
                      "show the light where no surface is, instead of black");
    command->add_flag("--gpu", arguments->gpu, "draw by OpenGL 4.3, which needs no display");
    addPixelLimit(*command, arguments->limits);

    command->callback([arguments, exposure = exposure, tone = tone] {
        if (isExr(arguments->output) && exposure->count() + tone->count() > 0)
            throw CLI::ValidationError("--exposure and --tone",
                                       "an .exr is linear radiance and takes neither");
        runRender(*arguments);
    });
}

}  // namespace prt::cli
