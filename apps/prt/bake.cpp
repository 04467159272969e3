#include "prt/transport/bake.h"

#include <sys/resource.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/prt/arguments.h"
#include "apps/prt/commands.h"
#include "apps/prt/interrupts.h"
#include "apps/prt/stage_log.h"
#include "apps/prt/text.h"
#include "prt/asset/asset.h"
#include "prt/base/error.h"
#include "prt/base/file.h"
#include "prt/basis/sh.h"
#include "prt/compress/compress_transfer.h"
#include "prt/io/scene_io.h"
#include "prt/scene/refine.h"

namespace prt::cli {
namespace {

static_assert(kEveryBounce == kInfiniteBounces);

constexpr float kKeepEdges = std::numeric_limits<float>::infinity();
constexpr std::array<std::pair<std::string_view, TransferEncoding>, 3> kMethods = {{
    {"float", TransferEncoding::float32},
    {"u16", TransferEncoding::unorm16},
    {"u8", TransferEncoding::unorm8},
}};

struct BakeArguments {
    std::string scene;
    std::string output;
    std::string stats;
    float maxEdgeLength =
        0.0f;  // metres; 0 chooses from the scene, kKeepEdges leaves all as they are
    TransferEncoding encoding = TransferEncoding::float32;
    BakeOptions bake;
};

/// Seconds of each stage outside bakeTransfer, which keeps its own.
struct StageSeconds {
    double load = 0.0;
    double compress = 0.0;
    double write = 0.0;
    double total = 0.0;
};

std::optional<TransferEncoding> parseMethod(std::string_view name) {
    for (const auto& [method, encoding] : kMethods)
        if (method == name) return encoding;
    return std::nullopt;
}

std::string_view methodName(TransferEncoding encoding) {
    for (const auto& [method, known] : kMethods)
        if (known == encoding) return method;
    return encodingName(encoding);
}

std::optional<float> parseEdgeLength(std::string_view text) {
    if (text == "none") return kKeepEdges;
    const std::optional<double> length = parseNumber(text);
    const auto metres = static_cast<float>(length.value_or(0.0));
    return metres > 0.0f ? std::optional(metres) : std::nullopt;
}

std::optional<Isa> parseRunnableIsa(std::string_view name) {
    const std::optional<Isa> isa = parseIsa(name);
    return isa && *isa <= detectIsa() ? isa : std::nullopt;
}

/// Checks all that can be checked before any work is done.
void checkArguments(const BakeArguments& arguments) {
    requireSuffix(arguments.output, ".glb");
    std::error_code ignored;
    if (std::filesystem::equivalent(arguments.scene, arguments.output, ignored))
        throw Error(ErrorCode::invalidOption, "would overwrite the scene it is baked from",
                    arguments.output, "choose another name, such as scene.prt.glb");
    const DeferInterrupts whileProbing;
    checkWritable(arguments.output);
    if (!arguments.stats.empty()) checkWritable(arguments.stats);
}

/// Reads the scene and makes its triangles small enough to hold a shadow. Sets
/// the edge length that was chosen.
Scene prepareScene(BakeArguments& arguments, StageLog& log) {
    Stopwatch watch;
    Scene scene = loadScene(arguments.scene);
    if (scene.triangleCount() == 0)
        throw Error(ErrorCode::malformed, "has no triangles to bake", arguments.scene);
    for (const std::string& warning : scene.warnings)
        log.warn(arguments.scene + ": " + warning);
    log.finishStage("load", watch.seconds(),
                    fmt::format("{}, {}, {}", formatCount(scene.meshes.size(), "mesh"),
                                formatCount(scene.vertexCount(), "vertex"),
                                formatCount(scene.triangleCount(), "triangle")));
    if (arguments.maxEdgeLength == kKeepEdges) return scene;

    watch = Stopwatch();
    if (arguments.maxEdgeLength == 0.0f) arguments.maxEdgeLength = defaultMaxEdgeLength(scene);
    Scene refined = refineEdges(scene, {.maxEdgeLength = arguments.maxEdgeLength});
    log.finishStage("refine", watch.seconds(),
                    fmt::format("edges to {:.3g} m: {}, {}", arguments.maxEdgeLength,
                                formatCount(refined.vertexCount(), "vertex"),
                                formatCount(refined.triangleCount(), "triangle")));
    return refined;
}

/// The options that decide the result, so that the same scene and this command make the same asset.
Provenance makeProvenance(const BakeArguments& arguments, const BakeStats& stats) {
    const BakeOptions& bake = arguments.bake;
    const bool infinite = bake.bounceCount == kInfiniteBounces;
    const bool keepEdges = arguments.maxEdgeLength == kKeepEdges;
    const std::string command = fmt::format(
        "bake --transport {} --bands {} --samples {} --bounces {} --max-edge {} --method {} --seed "
        "{} --isa {}",
        transportName(bake.transport), bake.bandCount, bake.sampleCount,
        infinite ? "inf" : std::to_string(bake.bounceCount),
        keepEdges ? "none" : fmt::format("{}", arguments.maxEdgeLength),
        methodName(arguments.encoding), bake.seed, isaName(stats.isa));
    return {.generator = "OpenPRT " PRT_VERSION,
            .command = command,
            .sampleCount = bake.sampleCount,
            .bounceCount = stats.bounceCount,
            .seed = bake.seed,
            .isa = std::string(isaName(stats.isa))};
}

std::uint64_t measurePeakBytes() {
    rusage usage = {};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
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
        {"peak_bytes", measurePeakBytes()},
    };
    return json.dump(2) + "\n";
}

std::size_t countBytesPerReceiver(const CompressedTransfer& transfer) {
    std::size_t bytes = 0;
    for (const CompressedLayer& layer : transfer.layers)
        bytes += layer.data.size();
    return bytes / transfer.receiverCount;
}

TransferField bakeInterruptibly(const Scene& scene, BakeOptions options, BakeStats& stats,
                                StageLog& log) {
    const DeferInterrupts untilTheCallback;
    options.progress = log.callback();
    TransferField field = bakeTransfer(scene, options, &stats);
    stopIfInterrupted();
    if (stats.invalidRayCount > 0)
        log.warn(fmt::format("{} were not finite and count as blocked",
                             formatCount(stats.invalidRayCount, "ray")));
    return field;
}

void runBake(BakeArguments arguments) {
    const Stopwatch total;
    StageLog log;
    StageSeconds seconds;
    checkArguments(arguments);
    stopIfInterrupted();

    const Scene scene = prepareScene(arguments, log);
    seconds.load = total.seconds();

    BakeStats stats;
    const TransferField field = bakeInterruptibly(scene, arguments.bake, stats, log);

    const Stopwatch compressWatch;
    const CompressedTransfer transfer = compressTransfer(field, {.encoding = arguments.encoding});
    seconds.compress = compressWatch.seconds();
    log.finishStage("compress", seconds.compress,
                    fmt::format("{}, {} a vertex", methodName(arguments.encoding),
                                formatCount(countBytesPerReceiver(transfer), "byte")));

    const Stopwatch writeWatch;
    const std::vector<std::byte> bytes =
        encodeAsset(scene, transfer, makeProvenance(arguments, stats));
    const DeferInterrupts whileWriting;
    writeFileAtomically(arguments.output, bytes);
    seconds.write = writeWatch.seconds();
    log.finishStage("write", seconds.write,
                    fmt::format("{}, {}", arguments.output, formatBytes(bytes.size())));

    seconds.total = total.seconds();
    if (!arguments.stats.empty()) writeFileAtomically(arguments.stats, formatStats(stats, seconds));
}

constexpr const char* kFooter =
    R"(Example: prt bake statue.glb -o statue.prt.glb --samples 4096 --bounces inf --method u16

The asset is a glTF with one layer for each transport up to the one asked for, so that all of them
can be shown. The same seed gives the same bytes for any number of threads, on one instruction set.)";

}  // namespace

void addBakeCommand(CLI::App& app) {
    const auto arguments = std::make_shared<BakeArguments>();
    BakeOptions& bake = arguments->bake;
    CLI::App* command =
        app.add_subcommand("bake", "Precompute a scene's light transport: SCENE to OUT.prt.glb");
    command->footer(kFooter);
    command
        ->add_option("SCENE", arguments->scene,
                     "the scene: .gltf, .glb, .obj or .ply; metres, Y up")
        ->required();
    command->add_option("-o,--output", arguments->output, "the asset to write")
        ->type_name("OUT.prt.glb")
        ->required();
    addParsedOption(*command, "--transport", bake.transport, parseTransport,
                    "unshadowed|shadowed|interreflected", "how much of light transport to bake")
        ->default_str("interreflected");
    addIntegerOption(*command, "--bands", bake.bandCount, 1, kMaxBandCount,
                     "n bands of spherical harmonics, n*n coefficients; 1 to 10");
    addIntegerOption(*command, "--samples", bake.sampleCount, 16, 65536,
                     "rays a vertex; 16 to 65536");
    CLI::Option* bounces =
        addParsedOption(*command, "--bounces", bake.bounceCount, parseBounceCount, "N|inf",
                        "indirect bounces; 0 to 1000, or until nothing changes")
            ->default_str("2");
    addParsedOption(*command, "--max-edge", arguments->maxEdgeLength, parseEdgeLength,
                    "LENGTH|none",
                    "split edges longer than this, metres [a 16th of the scene's radius]");
    addParsedOption(*command, "--method", arguments->encoding, parseMethod, "float|u16|u8",
                    "how a coefficient is stored: 4, 2 or 1 bytes")
        ->default_str("float");
    addParsedOption(*command, "--seed", bake.seed, parseSeed, "N", "of the random directions")
        ->default_str("1");
    addIntegerOption(*command, "--threads", bake.threadCount, 0, 4096, "0 for one a core");
    command
        ->add_option("--memory", bake.memoryBytes,
                     "for the hits of rays, beyond it they go to disk; K M G T")
        ->transform(CLI::AsSizeValue(false).description(""))
        ->check(CLI::PositiveNumber.description(""))
        ->type_name("BYTES")
        ->default_str("8G");
    addParsedOption(
        *command, "--isa", bake.isa, parseRunnableIsa, "sse4|avx2|avx512",
        fmt::format("instruction set, for the same bytes elsewhere [{}]", isaName(detectIsa())));
    command->add_option("--stats", arguments->stats, "write seconds, rays and memory as JSON")
        ->type_name("FILE.json");

    command->callback([arguments, bounces] {
        const bool pointless = bounces->count() > 0 && arguments->bake.bounceCount != 0;
        if (pointless && arguments->bake.transport != Transport::interreflected)
            throw CLI::ValidationError("--bounces",
                                       "bounces are baked with --transport interreflected only");
        runBake(*arguments);
    });
}

}  // namespace prt::cli
