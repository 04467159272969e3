#include <algorithm>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/prt/arguments.h"
#include "apps/prt/commands.h"
#include "apps/prt/interrupts.h"
#include "apps/prt/light_argument.h"
#include "apps/prt/picture.h"
#include "apps/prt/stage_log.h"
#include "prt/asset/asset.h"
#include "prt/base/error.h"
#include "prt/base/file.h"
#include "prt/compress/compress_transfer.h"
#include "prt/io/image_io.h"
#include "prt/relight/relighter.h"
#include "prt/render/render_view.h"
#include "prt/scene/framing.h"
#include "prt/transport/unshadowed.h"

namespace prt::cli {
namespace {

struct RenderArguments {
    std::string asset;
    std::string light;
    std::string output;
    std::string camera;
    std::optional<Vec3d> eye;
    Vec3d target{0.0, 0.0, 0.0};
    double fovDegrees = 45.0;
    PictureSize size;
    std::optional<Transport> transport;
    Vec3d rotationDegrees{0.0, 0.0, 0.0};
    DisplayOptions display;
    bool background = false;
};

std::optional<ToneCurve> parseToneCurve(std::string_view name) {
    if (name == "none") return ToneCurve::none;
    if (name == "aces") return ToneCurve::aces;
    return std::nullopt;
}

Asset readPreparedAsset(const std::string& path, StageLog& log) {
    const Stopwatch watch;
    Asset asset = readAsset(path);
    if (asset.scene.triangleCount() == 0)
        throw Error(ErrorCode::malformed, "has no triangles to show", path);
    decodeTextures(asset.scene);
    for (const std::string& warning : asset.scene.warnings)
        log.warn(path + ": " + warning);
    log.finishStage("load", watch.seconds(), path);
    return asset;
}

Camera chooseCamera(const RenderArguments& arguments, const Scene& scene) {
    if (arguments.eye) {
        const double fovRadians = arguments.fovDegrees * std::numbers::pi / 180.0;
        return lookAt(Vec3f(*arguments.eye), Vec3f(arguments.target),
                      static_cast<float>(fovRadians));
    }
    if (arguments.camera.empty()) {
        const float aspectRatio =
            static_cast<float>(arguments.size.width) / static_cast<float>(arguments.size.height);
        return scene.cameras.empty() ? frameScene(scene, aspectRatio) : scene.cameras.front();
    }
    std::vector<std::string> names;
    for (const Camera& camera : scene.cameras) {
        if (camera.name == arguments.camera) return camera;
        names.push_back(camera.name);
    }
    throw Error(ErrorCode::invalidOption, fmt::format("has no camera named '{}'", arguments.camera),
                arguments.asset,
                names.empty() ? "it has no camera; use --eye and --target"
                              : fmt::format("its cameras: {}", fmt::join(names, ", ")));
}

Transport fullestTransport(const CompressedTransfer& transfer) {
    Transport fullest = Transport::unshadowed;
    for (const CompressedLayer& layer : transfer.layers)
        fullest = std::max(fullest, layer.transport);
    return fullest;
}

/// The unshadowed layer follows from the normals, so every asset can show it;
/// the others must have been baked.
CompressedTransfer provideLayer(const RenderArguments& arguments, Asset& asset,
                                Transport transport) {
    if (asset.transfer.findLayer(transport)) return std::move(asset.transfer);
    if (transport == Transport::unshadowed)
        return compressTransfer(makeUnshadowedTransfer(asset.scene, asset.transfer.bandCount),
                                {.encoding = TransferEncoding::float32});
    throw Error(ErrorCode::invalidOption,
                fmt::format("was baked without {} transport", transportName(transport)),
                arguments.asset,
                fmt::format("bake it with --transport {}", transportName(transport)));
}

/// B of every vertex of the scene (C7).
std::vector<Vec3f> relightVertices(const CompressedTransfer& transfer, Transport transport,
                                   const Lighting& lighting) {
    const Relighter relighter(transfer, transport);
    std::vector<Vec3f> receiverRadiance(relighter.receiverCount());
    relighter.relight(lighting, receiverRadiance);

    std::vector<Vec3f> vertexRadiance;
    vertexRadiance.reserve(transfer.receiverOfVertex.size());
    for (const std::uint32_t receiver : transfer.receiverOfVertex)
        vertexRadiance.push_back(receiverRadiance[receiver]);
    return vertexRadiance;
}

Image renderPicture(const RenderArguments& arguments, Asset asset, const LightSource& light,
                    StageLog& log) {
    const Transport transport = arguments.transport.value_or(fullestTransport(asset.transfer));
    const Camera camera = chooseCamera(arguments, asset.scene);
    const Mat3d rotation = rotationFromDegrees(arguments.rotationDegrees);

    const Stopwatch watch;
    const CompressedTransfer transfer = provideLayer(arguments, asset, transport);
    const std::vector<Vec3f> vertexRadiance =
        relightVertices(transfer, transport, rotate(light.lighting, rotation));
    log.finishStage(
        "relight", watch.seconds(),
        fmt::format("{}, {} bands", transportName(transport), light.lighting.bandCount));

    std::optional<Environment> background;
    if (arguments.background) background = makeBackground(light, rotation);
    const RayScene rays(asset.scene);
    return renderView(asset.scene, rays, vertexRadiance, camera,
                      {.width = arguments.size.width,
                       .height = arguments.size.height,
                       .background = background ? &*background : nullptr,
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
    Asset asset = readPreparedAsset(arguments.asset, log);
    const LightSource light = loadLight(arguments.light, asset.transfer.bandCount);
    if (const auto mending = describeMending(light.mended))
        log.warn(arguments.light + ": " + *mending);
    const Image picture = renderPicture(arguments, std::move(asset), light, log);

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

void addCameraOptions(CLI::App& command, RenderArguments& arguments) {
    CLI::Option* camera = command.add_option(
        "--camera", arguments.camera, "a camera of the scene [its first, else all of it in view]");
    camera->type_name("NAME");
    CLI::Option* eye = addParsedOption(command, "--eye", arguments.eye, parseTriple, "X,Y,Z",
                                       "where the camera stands, world metres");
    CLI::Option* target = addParsedOption(command, "--target", arguments.target, parseTriple,
                                          "X,Y,Z", "what it looks at, world metres");
    CLI::Option* fov = command.add_option("--fov", arguments.fovDegrees,
                                          "its vertical field of view, degrees; 1 to 170");
    fov->check(CLI::Range(1.0, 170.0).description(""))->type_name("DEG")->capture_default_str();
    eye->needs(target)->excludes(camera);
    target->needs(eye);
    fov->needs(eye);
}

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
    addParsedOption(*command, "--rotate", arguments->rotationDegrees, parseTriple, "X,Y,Z",
                    "turn the light about the world's x axis, then y, then z, degrees")
        ->default_str("0,0,0");
    addCameraOptions(*command, *arguments);
    addParsedOption(*command, "--size", arguments->size, parsePictureSize, "WxH",
                    "of the picture, pixels")
        ->default_str("1280x720");
    CLI::Option* exposure = command->add_option("--exposure", arguments->display.exposureStops,
                                                "brighten by so many stops (.png)");
    exposure->check(CLI::Range(-100.0, 100.0).description(""))
        ->type_name("EV")
        ->capture_default_str();
    CLI::Option* tone = addParsedOption(*command, "--tone", arguments->display.toneCurve,
                                        parseToneCurve, "none|aces", "tone curve (.png)")
                            ->default_str("aces");
    command->add_flag("--background", arguments->background,
                      "show the light where no surface is, instead of black");

    command->callback([arguments, exposure, tone] {
        if (isExr(arguments->output) && exposure->count() + tone->count() > 0)
            throw CLI::ValidationError("--exposure and --tone",
                                       "an .exr is linear radiance and takes neither");
        runRender(*arguments);
    });
}

}  // namespace prt::cli
