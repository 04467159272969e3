#include "apps/prt/bake_work.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/common/text.h"
#include "apps/prt/arguments.h"
#include "apps/prt/asset_output.h"
#include "apps/prt/bake_brdf.h"
#include "apps/prt/compress_method.h"
#include "apps/prt/interrupts.h"
#include "apps/prt/memory.h"
#include "apps/prt/stage_log.h"
#include "prt/asset/asset_header.h"
#include "prt/base/error.h"
#include "prt/base/file.h"
#include "prt/compress/compress_transfer.h"
#include "prt/io/scene_io.h"
#include "prt/scene/refine.h"
#include "prt/transport/refine_adaptively.h"

namespace prt::cli {
namespace {

/// Seconds of each stage outside bakeTransfer, which keeps its own.
struct StageSeconds {
    double load = 0.0;
    double compress = 0.0;
    double write = 0.0;
    double total = 0.0;
};

/// Checks all that can be checked before any work is done.
void checkOutputs(const BakeArguments& arguments) {
    checkAssetOutput(arguments.output, arguments.scene, "the scene it is baked from");
    const DeferInterrupts whileProbing;
    if (!arguments.stats.empty()) checkWritable(arguments.stats);
}

/// Puts vertices where shadows need them, if that is asked for. Sets the edge length that was
/// chosen.
Scene refineWhereNeeded(Scene scene, BakeArguments& arguments, StageLog& log) {
    RefineArguments& refine = arguments.refine;
    if (refine.maxError == 0.0f) return scene;
    const Stopwatch watch;
    if (refine.minEdgeLength == 0.0f) refine.minEdgeLength = defaultMinEdgeLength(scene);
    const BakeOptions& bake = arguments.bake;
    AdaptiveRefineStats stats;
    Scene refined = refineAdaptively(scene,
                                     {.maxError = refine.maxError,
                                      .minEdgeLength = refine.minEdgeLength,
                                      .maxVertexCount = arguments.limits.refinedVertices(),
                                      .bandCount = bake.bandCount,
                                      .sampleCount = bake.sampleCount,
                                      .seed = bake.seed,
                                      .threadCount = bake.threadCount,
                                      .isa = bake.isa,
                                      .progress = log.callback()},
                                     &stats);
    log.finishStage(
        "refine", watch.seconds(),
        fmt::format("to an error of {:g}: {}, {}", refine.maxError,
                    formatCount(refined.vertexCount(), "vertex"),
                    stats.ranOutOfVertices ? "all that --max-vertices allows" : "as asked"));
    return refined;
}

/// Reads the scene and makes its triangles small enough to hold a shadow. Sets
/// the edge length that was chosen.
Scene prepareScene(BakeArguments& arguments, StageLog& log) {
    Stopwatch watch;
    Scene scene = loadScene(arguments.scene, arguments.limits.scene());
    if (scene.triangleCount() == 0)
        throw Error(ErrorCode::malformed, "has no triangles to bake", arguments.scene);
    for (const std::string& warning : scene.warnings)
        log.warn(arguments.scene + ": " + warning);
    log.finishStage("load", watch.seconds(),
                    fmt::format("{}, {}, {}", formatCount(scene.meshes.size(), "mesh"),
                                formatCount(scene.vertexCount(), "vertex"),
                                formatCount(scene.triangleCount(), "triangle")));
    if (arguments.maxEdgeLength == kKeepEdges)
        return refineWhereNeeded(std::move(scene), arguments, log);

    watch = Stopwatch();
    if (arguments.maxEdgeLength == 0.0f) arguments.maxEdgeLength = defaultMaxEdgeLength(scene);
    Scene refined = refineEdges(scene, {.maxEdgeLength = arguments.maxEdgeLength,
                                        .maxVertexCount = arguments.limits.refinedVertices()});
    log.finishStage("refine", watch.seconds(),
                    fmt::format("edges to {:.3g} m: {}, {}", arguments.maxEdgeLength,
                                formatCount(refined.vertexCount(), "vertex"),
                                formatCount(refined.triangleCount(), "triangle")));
    return refineWhereNeeded(std::move(refined), arguments, log);
}

/// What the layers of a bake will take of each vertex in the asset.
double countVertexBytes(const BakeOptions& bake, const CompressOptions& compress,
                        std::size_t vertexCount) {
    const auto countLayer = [&](int channelCount, int incidentBandCount) {
        return forecastVertexBytes(
            compress, coefficientsPerReceiver(bake.bandCount, channelCount, incidentBandCount),
            vertexCount);
    };
    double bytes = 0.0;
    for (const int incidentBandCount : {0, bake.incidentBandCount}) {
        if (incidentBandCount > 0 && !isGlossy(bake.transport)) continue;
        bytes += countLayer(1, incidentBandCount);
        if (hasBounces(bake.transport)) bytes += countLayer(3, incidentBandCount);
    }
    return bytes;
}

/// Checks that a binary glTF can hold what will be baked, and the disk too, before it is.
void checkAssetSize(const Scene& scene, const BakeArguments& arguments,
                    const CompressOptions& compress, StageLog& log) {
    constexpr std::uint64_t kLargeBytes = 100'000'000;
    constexpr std::uint64_t kMaxBytes = UINT32_MAX;
    const double vertexBytes = countVertexBytes(arguments.bake, compress, scene.vertexCount());
    const auto bytes =
        static_cast<std::uint64_t>(static_cast<double>(scene.vertexCount()) * vertexBytes);
    if (bytes > kMaxBytes)
        throw Error(
            ErrorCode::limitExceeded,
            fmt::format("would need {} of transfer, more than the {} that a binary glTF can have",
                        formatBytes(bytes), formatBytes(kMaxBytes)),
            arguments.output, "use fewer bands, --method cpca, u16 or u8, or split the scene");
    std::error_code unknown;
    const std::uint64_t freeBytes =
        std::filesystem::space(std::filesystem::absolute(arguments.output).parent_path(), unknown)
            .available;
    if (!unknown && bytes > freeBytes)
        throw Error(ErrorCode::writeFailed,
                    fmt::format("needs more than {}, and its disk has {} left", formatBytes(bytes),
                                formatBytes(freeBytes)),
                    arguments.output, "make space, or use fewer bands or --method cpca, u16 or u8");
    if (isGlossy(arguments.bake.transport) && !compress.clusters && bytes > kLargeBytes)
        log.warn(
            fmt::format("matrices will take {} in the asset; --method cpca needs about a hundredth",
                        formatBytes(bytes)));
}

/// Says what the bake will take.
///
/// @param allowedBytes  0: not said
/// @throws Error  outOfMemory if that is more than there is, or more than is allowed
void tellForecast(const BakeForecast& forecast, std::uint64_t allowedBytes, const Stopwatch& build,
                  StageLog& log) {
    const std::uint64_t memoryBytes = std::max<std::uint64_t>(peakBytes(), forecast.memoryBytes);
    std::string summary = fmt::format(
        "{}; to come: {}, {} of memory", formatCount(forecast.receiverCount, "receiver"),
        formatQuantity(static_cast<double>(forecast.rayCount), "rays"), formatBytes(memoryBytes));
    if (forecast.diskBytes > 0)
        summary += fmt::format(", {} on disk", formatBytes(forecast.diskBytes));
    if (forecast.unitCount > 0)
        summary += fmt::format(", {}", formatCount(forecast.unitCount, "unit"));
    log.finishStage("build", build.seconds(), summary);
    if (allowedBytes > 0 && forecast.memoryBytes > allowedBytes)
        throw Error(ErrorCode::outOfMemory,
                    fmt::format("the bake cannot do with {} of memory, it needs {}",
                                formatBytes(allowedBytes), formatBytes(forecast.memoryBytes)),
                    {}, "allow more with --memory");
    if (memoryBytes <= grantedBytes()) return;
    throw Error(ErrorCode::outOfMemory,
                fmt::format("the bake needs {} of memory, and there are {}",
                            formatBytes(memoryBytes), formatBytes(grantedBytes())),
                {}, "keep more of it on disk with a smaller --memory");
}

/// Runs a bake that an interrupt of the user stops in good order.
template <class Bake>
auto runInterruptibly(const Scene& scene, const BakeArguments& arguments, StageLog& log,
                      Bake bake) {
    // Until the first ray there is nothing to put in order: the program ends at once.
    std::optional<DeferInterrupts> untilTheCallback;
    const Stopwatch build;
    BakeOptions options = arguments.bake;
    BakeReflection reflection = makeBakeReflection(scene, arguments);
    options.reflection = std::move(reflection.reflection);
    options.progress = log.callback();
    options.announce = [&](const BakeForecast& forecast) {
        untilTheCallback.emplace();
        tellForecast(forecast, arguments.bake.memoryBytes, build, log);
    };
    options.checkpoint.callerSettings = callerSettings(arguments, reflection.setting);
    const std::string folder = options.checkpoint.folder.string();
    try {
        auto result = bake(options);
        stopIfInterrupted();
        return result;
    } catch (const Error& error) {
        if (error.code() != ErrorCode::cancelled || folder.empty()) throw;
        throw Error(ErrorCode::cancelled, "interrupted", {},
                    "the same command goes on from what is in " + folder);
    }
}

TransferField bakeScene(const Scene& scene, const BakeArguments& arguments, BakeStats& stats,
                        StageLog& log) {
    TransferField field = runInterruptibly(scene, arguments, log, [&](const BakeOptions& options) {
        return bakeTransfer(scene, options, &stats);
    });
    for (const std::string& warning : stats.warnings)
        log.warn(warning);
    if (stats.invalidRayCount > 0)
        log.warn(fmt::format("{} were not finite and count as blocked",
                             formatCount(stats.invalidRayCount, "ray")));
    if (stats.resumedUnitCount > 0)
        log.tell(fmt::format("{} of rays came from the checkpoint",
                             formatCount(stats.resumedUnitCount, "unit")));
    return field;
}

std::uint64_t countVertexBytes(const CompressedTransfer& transfer) {
    double bytes = 0.0;
    for (const CompressedLayer& layer : transfer.layers)
        bytes += static_cast<double>(bytesPerReceiver(layer)) + sharedBytesPerReceiver(layer);
    return static_cast<std::uint64_t>(std::ceil(bytes));
}

/// Compresses layer after layer, and tells the errors of each.
///
/// @param light  under which they are seen
CompressedTransfer compressAndTell(TransferField field, const BakeArguments& arguments,
                                   const CompressOptions& options, std::span<const Vec3d> light,
                                   StageLog& log) {
    CompressedTransfer transfer{
        field.bandCount, field.receiverCount, std::move(field.receiverOfVertex), {}};
    for (TransferLayer& layer : field.layers) {
        transfer.layers.push_back(compressLayer(layer, field.bandCount, options));
        tellCompression(transfer.layers.back(), layer,
                        layer.coefficients.columnCount() * sizeof(float), arguments.method, light,
                        log);
        layer.coefficients = {};
    }
    return transfer;
}

/// Bakes, and keeps no more of it than the asset needs.
CompressedTransfer bakeCompressed(const Scene& scene, const BakeArguments& arguments,
                                  CompressOptions compress, std::span<const Vec3d> light,
                                  BakeStats& stats, StageSeconds& seconds, StageLog& log) {
    TransferField field = bakeScene(scene, arguments, stats, log);
    const Stopwatch watch;
    compress.threadCount = arguments.bake.threadCount;
    compress.progress = log.callback();
    if (compress.clusters) compress.clusters->light.assign(light.begin(), light.end());
    CompressedTransfer transfer =
        compress.clusters || !light.empty()
            ? compressAndTell(std::move(field), arguments, compress, light, log)
            : compressTransfer(std::move(field), compress);
    seconds.compress = watch.seconds();
    log.finishStage("compress", seconds.compress,
                    fmt::format("{}, {} a vertex", methodName(arguments.method),
                                formatCount(countVertexBytes(transfer), "byte")));
    return transfer;
}

std::string formatStats(const BakeStats& stats, const StageSeconds& seconds) {
    const double raysPerSecond =
        stats.traceSeconds > 0.0 ? static_cast<double>(stats.rayCount) / stats.traceSeconds : 0.0;
    const nlohmann::ordered_json json = {
        {"seconds",
         {{"load", seconds.load},
          {"build", stats.buildSeconds},
          {"trace", stats.traceSeconds},
          {"accumulate", stats.accumulateSeconds},
          {"bounce", stats.bounceSeconds},
          {"compress", seconds.compress},
          {"write", seconds.write},
          {"total", seconds.total}}},
        {"rays", stats.rayCount},
        {"rays_per_second", raysPerSecond},
        {"receivers", stats.receiverCount},
        {"peak_bytes", peakBytes()},
    };
    return json.dump(2) + "\n";
}

}  // namespace

void bakeToAsset(BakeArguments arguments) {
    const Stopwatch total;
    StageLog log;
    StageSeconds seconds;
    const CompressOptions compress = makeCompressOptions(arguments.method, arguments.bake.seed);
    checkOutputs(arguments);
    const std::vector<Vec3d> light =
        loadErrorLight(arguments.method, arguments.bake.bandCount, arguments.limits);
    stopIfInterrupted();

    const Scene scene = prepareScene(arguments, log);
    checkAssetSize(scene, arguments, compress, log);
    seconds.load = total.seconds();

    BakeStats stats;
    const CompressedTransfer transfer =
        bakeCompressed(scene, arguments, compress, light, stats, seconds, log);

    const Stopwatch writeWatch;
    const DeferInterrupts whileWriting;
    writeAsset(arguments.output, scene, transfer, makeProvenance(arguments, stats));
    seconds.write = writeWatch.seconds();
    log.finishStage("write", seconds.write,
                    fmt::format("{}, {}", arguments.output,
                                formatBytes(std::filesystem::file_size(arguments.output))));
    if (!arguments.bake.checkpoint.folder.empty())
        log.tell(fmt::format("{} can be removed, or kept to bake again with another --method",
                             arguments.bake.checkpoint.folder.string()));

    seconds.total = total.seconds();
    if (!arguments.stats.empty()) writeFileAtomically(arguments.stats, formatStats(stats, seconds));
}

void bakeShare(BakeArguments arguments, UnitRange units) {
    const Stopwatch total;
    StageLog log;
    const Scene scene = prepareScene(arguments, log);
    const UnitReport report = runInterruptibly(
        scene, arguments, log,
        [&](const BakeOptions& options) { return bakeUnits(scene, options, units); });
    for (const std::string& warning : report.warnings)
        log.warn(warning);
    log.finishStage("units", total.seconds(),
                    fmt::format("{} of {} missing in {}", formatCount(report.missingUnitCount),
                                formatCount(report.unitCount, "unit"),
                                arguments.bake.checkpoint.folder.string()));
}

}  // namespace prt::cli
