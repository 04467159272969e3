#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/common/light_argument.h"
#include "apps/common/relit_asset.h"
#include "apps/prt/arguments.h"
#include "apps/prt/brdf_argument.h"
#include "apps/prt/commands.h"
#include "apps/prt/interrupts.h"
#include "apps/prt/limits.h"
#include "apps/prt/prepared_asset.h"
#include "apps/prt/report.h"
#include "apps/prt/stage_log.h"
#include "apps/prt/staged_folder.h"
#include "apps/prt/view_options.h"
#include "prt/base/error.h"
#include "prt/light/environment.h"
#include "prt/render/exit_shading.h"

namespace prt::cli {
namespace {

static_assert(kEveryBounce == kUnlimitedBounces);

/// The numbers of bands from the first to the last.
struct BandCounts {
    int first = 0;
    int last = -1;  // none
};

struct CompareArguments {
    std::string asset;
    std::vector<std::string> lights;
    std::string output;
    ViewArguments view{.size = {640, 360}};
    std::optional<ShownTransport> transport;
    std::vector<BrdfArgument> brdfs;
    std::optional<int> bounceCount;
    BandCounts bandCounts;
    bool triple = false;
    int referenceSamples = 256;
    Vec3d rotationDegrees{0.0, 0.0, 0.0};
    DisplayOptions display;
    std::uint64_t seed = 1;
    int threadCount = 0;
    ReaderLimits limits;
    std::string command;  ///< as it was given
};

std::optional<BandCounts> parseBandCounts(std::string_view text) {
    const std::size_t colon = text.find(':');
    const auto first = parseNumber(text.substr(0, colon));
    const auto last = colon == std::string_view::npos ? first : parseNumber(text.substr(colon + 1));
    if (!first || !last || *first < 1.0 || *last < *first || *last > kMaxBandCount)
        return std::nullopt;
    const BandCounts counts{static_cast<int>(*first), static_cast<int>(*last)};
    return counts.first == *first && counts.last == *last ? std::optional(counts) : std::nullopt;
}

/// What a layer stores for a vertex, with its share of what is stored for all.
std::size_t countVertexBytes(const CompressedLayer& layer) {
    return bytesPerReceiver(layer) +
           static_cast<std::size_t>(std::ceil(sharedBytesPerReceiver(layer)));
}

/// What --triple shows one beside the other.
constexpr std::array kTriple = {ShownTransport::unshadowed,     ShownTransport::shadowed,
                                ShownTransport::interreflected, ShownTransport::glossyUnshadowed,
                                ShownTransport::glossyShadowed, ShownTransport::glossy};

/// Compares one asset with its path-traced truth, under one light after the other.
class AssetComparison {
  public:
    AssetComparison(const CompareArguments& arguments, StageLog& log)
        : arguments_(arguments),
          log_(log),
          asset_(readTimed()),
          brdfs_(resolveBrdfs(asset_.scene, arguments.brdfs, arguments.asset)),
          shown_(chooseShown(asset_, arguments.asset, arguments.transport, brdfs_)),
          relighter_(asset_, arguments.asset, brdfs_, arguments.threadCount),
          camera_(chooseCamera(arguments.view, asset_.scene, arguments.asset)),
          rotation_(rotationFromDegrees(arguments.rotationDegrees)),
          rays_(asset_.scene, {.threadCount = arguments.threadCount}) {
        if (arguments.bandCounts.last > asset_.transfer.bandCount)
            throw Error(ErrorCode::invalidOption,
                        fmt::format("was baked with {} bands only", asset_.transfer.bandCount),
                        arguments.asset, "ask for fewer --band-counts, or bake more --bands");
        for (const std::string& sentence : describeLostLobes(asset_, shown_, brdfs_))
            log.warn(sentence);
        for (const std::optional<Brdf>& brdf : brdfs_)
            tracedBrdfs_.push_back(brdf.value_or(Brdf()));
        referenceOptions_ = makeReferenceOptions();
    }

    ReportLight compareUnder(const LightSource& source, const std::string& name) {
        const Lighting lighting = bandsOf(source, asset_.transfer.bandCount);
        const std::vector<ExitRadiance> vertexRadiance = relight(shown_, lighting);
        const MirroredLights mirrored = mirrorLights(vertexRadiance, source, lighting);
        const Image inBands = render(vertexRadiance, mirrored.inBands);
        ReportLight light{.name = name, .bandCount = lighting.bandCount};
        light.relit = inBands;
        if (mirrored.itself) {
            light.relit = render(vertexRadiance, mirrored.itself);
            light.relitInBands = inBands;
        }

        const Reference sameBands = trace("path tracing in bands", *makeBandLimitedLight(lighting));
        const Reference itself = trace("path tracing", *makeExactLight(source, rotation_));
        const Stopwatch watch;
        light.sameBands = judge(inBands, vertexRadiance, mirrored.inBands, sameBands);
        light.itself = judge(light.relit, vertexRadiance, mirrored.itself, itself);
        finishStage("measure", watch, name);

        for (int n = arguments_.bandCounts.first; n <= arguments_.bandCounts.last; ++n)
            light.byBandCount.emplace_back(
                n, relightAndJudge(shown_, bandsOf(source, n), mirrored.itself, itself.view));
        for (const ShownTransport shown : kTriple)
            if (arguments_.triple && shown <= shown_ && isAvailable(asset_.transfer, shown))
                light.byTransport.emplace_back(
                    shown, relightAndJudge(shown, lighting, mirrored.inBands, sameBands.view));
        return light;
    }

    /// All but the lights.
    Report makeReport() const {
        const CompressedLayer* layer = findShownLayer(asset_.transfer, shown_);
        return {.asset = arguments_.asset,
                .command = arguments_.command,
                .provenance = asset_.provenance,
                .vertexCount = asset_.scene.vertexCount(),
                .triangleCount = asset_.scene.triangleCount(),
                .assetBytes = std::filesystem::file_size(arguments_.asset),
                .bytesPerVertex = layer ? countVertexBytes(*layer) : 0,
                .transport = shown_,
                .materials = describeMaterials(),
                .referenceSamples = referenceOptions_.samplesPerRay *
                                    referenceOptions_.view.samplesPerAxis *
                                    referenceOptions_.view.samplesPerAxis,
                .bounceCount = referenceOptions_.bounceCount,
                .display = arguments_.display,
                .seconds = seconds_};
    }

  private:
    Asset readTimed() {
        const Stopwatch watch;
        Asset asset = readPreparedAsset(arguments_.asset, arguments_.limits.images(), log_);
        addSeconds("load", watch.seconds());
        return asset;
    }

    ReferenceOptions makeReferenceOptions() const {
        const int bakedBounces = hasBounces(shown_) ? asset_.provenance.bounceCount : 0;
        ReferenceOptions options = {
            .view = {.width = arguments_.view.size.width,
                     .height = arguments_.view.size.height,
                     .seed = arguments_.seed,
                     .threadCount = arguments_.threadCount,
                     .progress = log_.callback()},
            .samplesPerVertex = arguments_.referenceSamples,
            .bounceCount = arguments_.bounceCount.value_or(bakedBounces),
            .surfaceModel = isGlossy(shown_) ? SurfaceModel::gltf : SurfaceModel::diffuse,
            .materialBrdfs = tracedBrdfs_};
        const int raysPerPixel = options.view.samplesPerAxis * options.view.samplesPerAxis;
        options.samplesPerRay =
            std::max(2, (arguments_.referenceSamples + raysPerPixel - 1) / raysPerPixel);
        return options;
    }

    /// What the reports of glossy assets say of each material.
    std::vector<ReportMaterial> describeMaterials() const {
        std::vector<ReportMaterial> materials;
        for (std::size_t i = 0; isGlossy(shown_) && i < asset_.scene.materials.size(); ++i) {
            const Material& material = asset_.scene.materials[i];
            materials.push_back(
                {.name = material.name.empty() ? fmt::format("material {}", i) : material.name,
                 .surface = {material.metallicFactor, material.roughnessFactor},
                 .isTextured = material.metallicRoughnessTexture.has_value(),
                 .isReplaced = !brdfs_.empty() && brdfs_[i].has_value()});
        }
        return materials;
    }

    Lighting bandsOf(const LightSource& source, int bandCount) const {
        return truncate(rotate(source.lighting, rotation_),
                        std::min(bandCount, source.lighting.bandCount));
    }

    std::vector<ExitRadiance> relight(ShownTransport shown, const Lighting& lighting) {
        const Stopwatch watch;
        std::vector<ExitRadiance> radiance = relighter_.relight(shown, lighting, camera_.eye);
        addSeconds("relight", watch.seconds());
        return radiance;
    }

    /// What mirror-like surfaces show of a light, if there are any.
    struct MirroredLights {
        std::optional<MirrorEnvironment> inBands{};
        std::optional<MirrorEnvironment> itself{};
    };

    MirroredLights mirrorLights(const std::vector<ExitRadiance>& vertexRadiance,
                                const LightSource& source, const Lighting& lighting) {
        constexpr int kReconstructionWidth = 256;  // of ten bands at most
        if (!hasMirrors(vertexRadiance)) return {};
        const Stopwatch watch;
        const MirrorOptions options{.threadCount = arguments_.threadCount};
        MirroredLights lights;
        lights.inBands = makeMirrorEnvironment(
            {SphereMap::latLong, reconstructLatLong(lighting, kReconstructionWidth)}, {}, options);
        lights.itself = makeMirrorEnvironment(makeMirroredLight(source), rotation_, options);
        addSeconds("prefilter", watch.seconds());
        return lights;
    }

    Image render(const std::vector<ExitRadiance>& vertexRadiance,
                 const std::optional<MirrorEnvironment>& mirrors) {
        const Stopwatch watch;
        RenderOptions view = referenceOptions_.view;
        if (mirrors) view.mirrors = &*mirrors;
        Image picture = renderView(asset_.scene, rays_, vertexRadiance, camera_, view);
        addSeconds("render", watch.seconds());
        return picture;
    }

    Reference trace(const std::string& stage, const DistantLight& light) {
        const Stopwatch watch;
        Reference reference =
            traceReference(asset_.scene, rays_, light, camera_, referenceOptions_);
        addSeconds(stage, watch.seconds());
        return reference;
    }

    JudgedPicture relightAndJudge(ShownTransport shown, const Lighting& lighting,
                                  const std::optional<MirrorEnvironment>& mirrors,
                                  const PathTracedView& reference) {
        Image picture = render(relight(shown, lighting), mirrors);
        PictureComparison comparison = comparePictures(picture, reference, arguments_.display);
        return {std::move(picture), std::move(comparison)};
    }

    JudgedReference judge(const Image& relit, const std::vector<ExitRadiance>& vertexRadiance,
                          const std::optional<MirrorEnvironment>& mirrors,
                          const Reference& reference) const {
        JudgedReference judged{
            .radiance = reference.view.radiance,
            .comparison = comparePictures(relit, reference.view, arguments_.display),
            .atVertices = compareAtVertices(showVertices(vertexRadiance, mirrors), reference),
            .vertexCount = reference.vertices.size()};
        if (isGlossy(shown_))
            judged.byMaterial = compareMaterials(asset_.scene, rays_, camera_,
                                                 referenceOptions_.view, relit, reference.view);
        return judged;
    }

    /// As the reference has them: B of diffuse surfaces, what others send to the eye.
    std::vector<Vec3f> showVertices(const std::vector<ExitRadiance>& vertexRadiance,
                                    const std::optional<MirrorEnvironment>& mirrors) const {
        if (isGlossy(shown_))
            return shadeVertices(asset_.scene, vertexRadiance, camera_.eye,
                                 mirrors ? &*mirrors : nullptr);
        std::vector<Vec3f> radiance;
        for (const ExitRadiance& exit : vertexRadiance)
            radiance.push_back(exit.perBaseColor);
        return radiance;
    }

    void finishStage(const std::string& stage, const Stopwatch& watch, const std::string& summary) {
        addSeconds(stage, watch.seconds());
        log_.finishStage(stage, watch.seconds(), summary);
    }

    void addSeconds(const std::string& stage, double seconds) {
        const auto known = std::find_if(seconds_.begin(), seconds_.end(),
                                        [&](const auto& entry) { return entry.first == stage; });
        if (known == seconds_.end())
            seconds_.emplace_back(stage, seconds);
        else
            known->second += seconds;
    }

    const CompareArguments& arguments_;
    StageLog& log_;
    std::vector<std::pair<std::string, double>> seconds_;
    Asset asset_;
    GivenBrdfs brdfs_;
    std::vector<Brdf> tracedBrdfs_;  // as WalkOptions has them
    ShownTransport shown_;
    AssetRelighter relighter_;
    Camera camera_;
    Mat3d rotation_;
    RayScene rays_;
    ReferenceOptions referenceOptions_;
};

void runCompare(const CompareArguments& arguments) {
    {
        const DeferInterrupts whileProbing;
        StagedFolder::check(arguments.output);
    }
    stopIfInterrupted();

    StageLog log;
    AssetComparison comparison(arguments, log);
    std::vector<LightSource> sources;
    for (const std::string& light : arguments.lights) {
        sources.push_back(loadLight(light, kMaxBandCount, {}, arguments.limits.images()));
        if (const auto mending = describeMending(sources.back().mended))
            log.warn(light + ": " + *mending);
    }
    std::vector<ReportLight> lights;
    for (std::size_t i = 0; i < sources.size(); ++i)
        lights.push_back(comparison.compareUnder(sources[i], arguments.lights[i]));
    Report report = comparison.makeReport();
    report.lights = std::move(lights);

    const DeferInterrupts whileWriting;
    const Stopwatch watch;
    StagedFolder folder(arguments.output);
    writeReport(folder.path(), report);
    stopIfInterrupted();
    folder.commit();
    log.finishStage("write", watch.seconds(),
                    (std::filesystem::path(arguments.output) / "index.html").string());
}

constexpr const char* kFooter =
    R"(Examples: prt compare statue.prt.glb --light museum.exr -o report
          prt compare slab.prt.glb --light sun:30,60,0 --light sun:30,60,20 --band-counts 2:10 -o report

Open REPORT_DIR/index.html. The relit asset is held against pictures of our path tracer, of the same
camera and the same rays from it: under the light in the asset's bands, where only the bake can be at
fault, and under the light itself, where bands are missing too. comparison.json has the numbers, and
the .exr files the radiance.

)";

}  // namespace

void addCompareCommand(CLI::App& app) {
    const auto arguments = std::make_shared<CompareArguments>();
    CLI::App* command = app.add_subcommand(
        "compare", "Hold a relit asset against path-traced truth: a page of pictures and errors");
    command->footer(std::string(kFooter) + kLightHelp);
    command->add_option("ASSET", arguments->asset, "what prt bake wrote")->required();
    command->add_option("--light", arguments->lights, "a light, as below; may be given again")
        ->type_name("LIGHT")
        ->required()
        ->allow_extra_args(false);
    command->add_option("-o,--output", arguments->output, "the folder to make")
        ->type_name("REPORT_DIR")
        ->required();
    addIntegerOption(*command, "--reference-samples", arguments->referenceSamples, 32, 1 << 20,
                     "paths a pixel and a vertex; rounded up to a multiple of 16");
    addParsedOption(*command, "--transport", arguments->transport, parseShownTransport,
                    kShownTransportForms, "how much of light transport to compare [all there is]");
    addBrdfOption(*command, arguments->brdfs);
    addParsedOption(*command, "--bounces", arguments->bounceCount, parseBounceCount, "N|inf",
                    "indirect bounces of the reference [as many as were baked]");
    addParsedOption(*command, "--band-counts", arguments->bandCounts, parseBandCounts,
                    "N|FIRST:LAST",
                    "also relight with so many bands of the light, each held against the truth");
    command->add_flag("--triple", arguments->triple,
                      "also show the asset unshadowed, shadowed and interreflected, and glossy so");
    addRotationOption(*command, arguments->rotationDegrees);
    addViewOptions(*command, arguments->view);
    addDisplayOptions(*command, arguments->display);
    addParsedOption(*command, "--seed", arguments->seed, parseWholeNumber, "N",
                    "of the random paths")
        ->default_str("1");
    addIntegerOption(*command, "--threads", arguments->threadCount, 0, 4096, "0 for one a core");
    addPixelLimit(*command, arguments->limits);

    command->callback([arguments, command] {
        arguments->command = describeCommand("prt compare " + arguments->asset, *command, "output");
        runCompare(*arguments);
    });
}

}  // namespace prt::cli
