#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <iterator>
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
#include "apps/prt/asset_output.h"
#include "apps/prt/commands.h"
#include "apps/prt/interrupts.h"
#include "apps/prt/limits.h"
#include "apps/prt/prepared_asset.h"
#include "apps/prt/stage_log.h"
#include "apps/prt/view_options.h"
#include "prt/base/error.h"
#include "prt/gltf/glb_writer.h"
#include "prt/render/freeze.h"

namespace prt::cli {
namespace {

namespace fs = std::filesystem;

/// --exposure: so many stops, or what suits each light.
struct Exposure {
    bool isAutomatic = true;
    float stops = 0.0f;
};

struct ExportArguments {
    std::string asset;
    std::vector<std::string> lights;
    std::string output;
    bool frozen = false;
    std::optional<ShownTransport> transport;
    std::string camera;
    std::optional<Vec3d> eye;
    LightingArguments lighting;
    Exposure exposure;
    ToneCurve toneCurve = ToneCurve::none;
    ReaderLimits limits;
};

std::optional<Exposure> parseExposure(std::string_view text) {
    constexpr double kMostStops = 100.0;
    if (text == "auto") return Exposure{};
    const std::optional<double> stops = parseNumber(text);
    if (!stops || std::abs(*stops) > kMostStops) return std::nullopt;
    return Exposure{false, static_cast<float>(*stops)};
}

/// A light in a file's name: "museum" of lights/museum.exr, "sun-60-40-10" of sun:60,40,10.
std::string nameLightInFiles(const std::string& light) {
    std::string name = nameLight(light);
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-' && c != '_')
            c = '-';
    return name;
}

/// One file a light: OUT.glb where there is one, else OUT-museum.glb, OUT-sun-60-40-10.glb, …
std::vector<std::string> nameOutputs(const ExportArguments& arguments) {
    if (arguments.lights.size() == 1) return {arguments.output};
    const fs::path whole = arguments.output;
    std::vector<std::string> outputs;
    for (const std::string& light : arguments.lights) {
        fs::path output = whole;
        output.replace_filename(whole.stem().string() + "-" + nameLightInFiles(light) +
                                whole.extension().string());
        if (std::ranges::find(outputs, output.string()) != outputs.end())
            throw Error(ErrorCode::invalidOption, "would be written for two lights",
                        output.string(), "export them one by one");
        outputs.push_back(output.string());
    }
    return outputs;
}

/// From where surfaces that shine are seen.
std::optional<Vec3f> findEye(const ExportArguments& arguments, const Scene& scene) {
    if (arguments.eye) return Vec3f(*arguments.eye);
    if (arguments.camera.empty()) return std::nullopt;
    return chooseCamera({.camera = arguments.camera}, scene, arguments.asset).eye;
}

/// What was asked for; else with an eye all there is, and without one all that no eye changes.
ShownTransport chooseFrozen(const ExportArguments& arguments, const Asset& asset, bool hasEye) {
    auto shown = chooseShown(asset, arguments.asset, arguments.transport, {});
    if (hasEye && !isGlossy(shown))
        throw Error(
            ErrorCode::invalidOption,
            fmt::format("make no difference to {} transport, for which surfaces are diffuse",
                        shownTransportName(shown)),
            "--camera and --eye", "leave them out");
    if (hasEye || !isGlossy(shown)) return shown;
    if (arguments.transport)
        throw Error(ErrorCode::invalidOption,
                    fmt::format("{} is what one eye sees, and nothing says where that is",
                                shownTransportName(shown)),
                    "--transport", "add --camera or --eye");
    const auto isShown = [&] { return findShownLayer(asset.transfer, shown) != nullptr; };
    for (shown = ShownTransport::interreflected; !isShown();
         shown = static_cast<ShownTransport>(static_cast<int>(shown) - 1))
        if (shown == ShownTransport::unshadowed)
            throw Error(ErrorCode::invalidOption,
                        "was baked for surfaces that shine alone, which look different from "
                        "everywhere",
                        arguments.asset,
                        "say with --camera or --eye from where, or export --transport unshadowed");
    return shown;
}

/// Asset and eye, and what relights them.
struct FrozenView {
    const Asset& asset;
    ShownTransport shown;
    std::optional<Vec3f> eye;
    AssetRelighter relighter;
};

Scene freeze(FrozenView& view, const LightSource& light, const Lighting& lighting,
             const Mat3d& worldFromLight, const DisplayOptions& display) {
    const std::vector<ExitRadiance> exit =
        view.relighter.relight(view.shown, lighting, view.eye.value_or(Vec3f(0.0f)));
    if (isGlossy(view.shown)) {
        std::optional<MirrorEnvironment> mirrors;
        if (hasMirrors(exit))
            mirrors = makeMirrorEnvironment(makeMirroredLight(light), worldFromLight);
        return freezeView(view.asset.scene, exit, *view.eye, mirrors ? &*mirrors : nullptr,
                          display);
    }
    std::vector<Vec3f> radiance;
    std::ranges::transform(exit, std::back_inserter(radiance), &ExitRadiance::perBaseColor);
    return freezeScene(view.asset.scene, radiance, display);
}

void exportUnder(const ExportArguments& arguments, FrozenView& view, const LightSource& light,
                 const std::string& output, StageLog& log) {
    const Stopwatch watch;
    const Lighting lighting = prepareLighting(light.lighting, arguments.lighting, view.asset,
                                              arguments.asset, view.shown);
    const DisplayOptions display{.exposureStops = arguments.exposure.isAutomatic
                                                      ? chooseExposure(lighting)
                                                      : arguments.exposure.stops,
                                 .toneCurve = arguments.toneCurve};
    const Scene frozen = freeze(view, light, lighting,
                                rotationFromDegrees(arguments.lighting.rotationDegrees), display);
    for (const std::string& warning : frozen.warnings)
        log.warn(arguments.asset + ": " + warning);
    log.finishStage("relight", watch.seconds(),
                    fmt::format("{}, {}, exposure {:.2f}", shownTransportName(view.shown),
                                formatCount(static_cast<std::uint64_t>(lighting.bandCount), "band"),
                                display.exposureStops));
    const DeferInterrupts whileWriting;
    const Stopwatch write;
    writeGlb(output, frozen, nullptr, {.unlit = true});
    log.finishStage("write", write.seconds(),
                    fmt::format("{}, {}", output, formatBytes(fs::file_size(output))));
}

void runExport(const ExportArguments& arguments) {
    const std::vector<std::string> outputs = nameOutputs(arguments);
    for (const std::string& output : outputs)
        checkAssetOutput(output, arguments.asset, "the asset it is made from");
    stopIfInterrupted();

    StageLog log;
    const ImageLimits limits = arguments.limits.images();
    const Asset asset = readPreparedAsset(arguments.asset, limits, log);
    std::vector<LightSource> lights;
    for (const std::string& light : arguments.lights) {
        lights.push_back(loadLight(light, asset.transfer.bandCount, {}, limits));
        if (const auto mending = describeMending(lights.back().mended))
            log.warn(light + ": " + *mending);
    }
    const std::optional<Vec3f> eye = findEye(arguments, asset.scene);
    FrozenView view{asset, chooseFrozen(arguments, asset, eye.has_value()), eye,
                    AssetRelighter(asset, arguments.asset)};
    if (isGlossy(fullestShown(asset.transfer)) && !eye && !arguments.transport)
        log.tell("all surfaces are taken for diffuse (--camera or --eye freezes how they shine)");
    for (std::size_t i = 0; i < lights.size(); ++i) {
        stopIfInterrupted();
        exportUnder(arguments, view, lights[i], outputs[i], log);
    }
}

constexpr const char* kFooter =
    R"(Examples: prt export statue.prt.glb --frozen --light museum.exr -o statue.glb
          prt export statue.prt.glb --frozen --light museum.exr --light sun:60,40,10 -o statue.glb
          prt export spheres.prt.glb --frozen --light museum.exr --camera front -o spheres.glb

Any viewer of glTF shows such a file as it is under that light: radiance 2^EV stands in the colours of its
vertices (COLOR_0), which viewers multiply with the texture of base colour, and its materials ask for no other
light (KHR_materials_unlit). What is above 1 is white, so auto brings the brightest side of a white sphere to
0.8. A curve of --tone is applied before the texture is; viewers with a curve of their own need none here.
Of several lights each has a file: statue-museum.glb, statue-sun-60-40-10.glb.

Surfaces that shine look different from everywhere. They are frozen as one eye sees them, where --camera or
--eye says, their textures as the vertices have them; else all surfaces are shown as if they were diffuse.

)";

}  // namespace

void addExportCommand(CLI::App& app) {
    const auto arguments = std::make_shared<ExportArguments>();
    CLI::App* command = app.add_subcommand(
        "export", "Freeze a baked asset under a light, for any viewer: ASSET to OUT.glb");
    command->footer(std::string(kFooter) + kLightHelp);
    command->add_option("ASSET", arguments->asset, "what prt bake wrote")->required();
    command
        ->add_flag("--frozen", arguments->frozen,
                   "as plain glTF under a light that stays; there is no other kind yet")
        ->required();
    command
        ->add_option("--light", arguments->lights,
                     "the light, as below; again for more, each with a file of its own")
        ->type_name("LIGHT")
        ->required();
    command->add_option("-o,--output", arguments->output, "the file to write")
        ->type_name("OUT.glb")
        ->required();
    addParsedOption(*command, "--transport", arguments->transport, parseShownTransport,
                    kShownTransportForms, "how much of light transport to show [all there is]");
    CLI::Option* camera = command
                              ->add_option("--camera", arguments->camera,
                                           "the camera from which surfaces that shine are seen")
                              ->type_name("NAME");
    addParsedOption(*command, "--eye", arguments->eye, parseTriple, "X,Y,Z",
                    "or where they are seen from, world metres")
        ->excludes(camera);
    addLightingOptions(*command, arguments->lighting);
    addParsedOption(*command, "--exposure", arguments->exposure, parseExposure, "auto|EV",
                    "brighten by so many stops; auto: as each light needs")
        ->default_str("auto");
    addToneOption(*command, arguments->toneCurve, "tone curve, at the vertices");
    addPixelLimit(*command, arguments->limits);
    command->callback([arguments] { runExport(*arguments); });
}

}  // namespace prt::cli
