#include "apps/prt/bake_options.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "apps/prt/arguments.h"
#include "apps/prt/bake_brdf.h"
#include "apps/prt/compress_method.h"
#include "prt/base/error.h"
#include "prt/basis/sh.h"
#include "prt/transport/bake_settings.h"

namespace prt::cli {
namespace {

constexpr const char* kIncidentBandsOption = "--incident-bands";
constexpr const char* kMaxEdgeSetting = "max-edge";
constexpr const char* kRefineErrorSetting = "refine-error";
constexpr const char* kMinEdgeSetting = "min-edge";
constexpr const char* kMaxVerticesSetting = "max-vertices";
constexpr std::uint64_t kMaxVertexCount = 0xfffffffe;

std::optional<int> parseBounces(std::string_view text) {
    constexpr int kMaxBounceCount = 1000;
    if (text == "inf") return kInfiniteBounces;
    const std::optional<double> count = parseNumber(text);
    if (!count || *count < 0.0 || *count > kMaxBounceCount || *count != std::floor(*count))
        return std::nullopt;
    return static_cast<int>(*count);
}

std::optional<float> parseEdgeLength(std::string_view text) {
    if (text == "none") return kKeepEdges;
    const std::optional<double> length = parseNumber(text);
    const auto metres = static_cast<float>(length.value_or(0.0));
    return metres > 0.0f ? std::optional(metres) : std::nullopt;
}

std::string formatEdgeLength(float length) {
    return length == kKeepEdges ? "none" : fmt::format("{}", length);
}

std::optional<float> parsePositive(std::string_view text) {
    const auto number = static_cast<float>(parseNumber(text).value_or(0.0));
    return number > 0.0f ? std::optional(number) : std::nullopt;
}

std::optional<std::size_t> parseVertexCount(std::string_view text) {
    const std::optional<std::uint64_t> count = parseWholeNumber(text);
    return count && *count > 0 && *count <= kMaxVertexCount ? std::optional<std::size_t>(*count)
                                                            : std::nullopt;
}

/// What a setting holds, as `parse` reads it. @throws Error  malformed
template <class Parse>
auto readSetting(std::span<const Setting> settings, const std::string& name, Parse parse) {
    const auto value = parse(findSetting(settings, name));
    if (!value) throw Error(ErrorCode::malformed, "has a setting " + name + " that makes no sense");
    return *value;
}

std::optional<Isa> parseRunnableIsa(std::string_view name) {
    const std::optional<Isa> isa = parseIsa(name);
    return isa && *isa <= detectIsa() ? isa : std::nullopt;
}

void addRefineOptions(CLI::App& command, RefineArguments& refine) {
    CLI::Option* error = addParsedOption(
        command, "--refine-error", refine.maxError, parsePositive, "ERROR",
        "add vertices where interpolation is off by this part of a full sky; try 0.05");
    addParsedOption(command, "--min-edge", refine.minEdgeLength, parsePositive, "LENGTH",
                    "but halve no edge under twice this, metres [a 256th of the scene's radius]")
        ->needs(error);
}

}  // namespace

void addTransportOptions(CLI::App& command, BakeArguments& arguments) {
    BakeOptions& bake = arguments.bake;
    addParsedOption(command, "--transport", bake.transport, parseTransport,
                    "unshadowed|shadowed|interreflected|glossy-shadowed|glossy",
                    "how much of light transport to bake")
        ->default_str("interreflected");
    addIntegerOption(command, "--bands", bake.bandCount, 1, kMaxBandCount,
                     "n bands of spherical harmonics, n*n coefficients; 1 to 10");
    addIntegerOption(command, kIncidentBandsOption, bake.incidentBandCount, 1, kMaxBandCount,
                     "of the light at a glossy surface; with --bands 11 at most");
    addIntegerOption(command, "--samples", bake.sampleCount, 16, 65536,
                     "rays a vertex; 16 to 65536");
    addParsedOption(command, "--bounces", bake.bounceCount, parseBounces, "N|inf",
                    "indirect bounces; 0 to 1000, or until nothing changes")
        ->default_str("2");
    addBrdfOption(command, arguments.brdfs);
    addParsedOption(command, "--max-edge", arguments.maxEdgeLength, parseEdgeLength, "LENGTH|none",
                    "split edges longer than this, metres [a 16th of the scene's radius]");
    addRefineOptions(command, arguments.refine);
    addParsedOption(command, "--seed", bake.seed, parseWholeNumber, "N", "of the random directions")
        ->default_str("1");
    addParsedOption(
        command, "--isa", bake.isa, parseRunnableIsa, "sse4|avx2|avx512",
        fmt::format("instruction set, for the same bytes elsewhere [{}]", isaName(detectIsa())));
}

void checkTransportOptions(const CLI::App& command, const BakeOptions& bake) {
    const bool bounces = command.count("--bounces") > 0 && bake.bounceCount != 0;
    if (bounces && !hasBounces(bake.transport))
        throw CLI::ValidationError(
            "--bounces", "bounces are baked with --transport interreflected or glossy only");
    if (command.count("--brdf") > 0 && bake.transport != Transport::glossy)
        throw CLI::ValidationError(
            "--brdf", "light bounces off other materials with --transport glossy only");
    if (!isGlossy(bake.transport)) {
        if (command.count(kIncidentBandsOption) > 0)
            throw CLI::ValidationError(
                kIncidentBandsOption,
                "light at a surface is baked with --transport glossy-shadowed or glossy only");
        return;
    }
    if (bake.incidentBandCount + bake.bandCount - 1 > kMaxBandCount)
        throw CLI::ValidationError(
            kIncidentBandsOption,
            fmt::format("{} and --bands {} are more than {} together", bake.incidentBandCount,
                        bake.bandCount, kMaxBandCount + 1));
}

void addRunOptions(CLI::App& command, BakeArguments& arguments) {
    BakeOptions& bake = arguments.bake;
    addMethodOptions(command, arguments.method);
    addIntegerOption(command, "--threads", bake.threadCount, 0, 4096, "0 for one a core");
    command
        .add_option("--memory", bake.memoryBytes,
                    "memory to use in all, more goes to disk; K M G T")
        ->transform(CLI::AsSizeValue(false).description(""))
        ->check(CLI::PositiveNumber.description(""))
        ->type_name("BYTES")
        ->default_str("by the scene");
    command.add_option("--scratch", bake.scratchFolder, "folder for what goes to disk")
        ->type_name("DIR")
        ->default_str("the system's");
    addVertexLimit(command, arguments.limits);
    addPixelLimit(command, arguments.limits);
    command.add_option("--stats", arguments.stats, "write seconds, rays and memory as JSON")
        ->type_name("FILE.json");
}

std::vector<Setting> callerSettings(const BakeArguments& arguments, const std::string& brdfs) {
    std::vector<Setting> settings = {{kMaxEdgeSetting, formatEdgeLength(arguments.maxEdgeLength)},
                                     {"version", PRT_VERSION}};
    if (!brdfs.empty()) settings.push_back({"brdf", brdfs});
    const RefineArguments& refine = arguments.refine;
    if (refine.maxError == 0.0f) {
        settings.push_back({kRefineErrorSetting, "none"});
        return settings;
    }
    settings.push_back({kRefineErrorSetting, fmt::format("{}", refine.maxError)});
    settings.push_back({kMinEdgeSetting, fmt::format("{}", refine.minEdgeLength)});
    settings.push_back({kMaxVerticesSetting, std::to_string(arguments.limits.refinedVertices())});
    return settings;
}

void adoptFolderSettings(const std::filesystem::path& folder, BakeArguments& arguments) {
    const std::vector<Setting> settings = readFolderSettings(folder);
    try {
        applyBakeSettings(settings, arguments.bake);
        arguments.maxEdgeLength = readSetting(settings, kMaxEdgeSetting, parseEdgeLength);
        if (findSetting(settings, kRefineErrorSetting) == "none") return;
        arguments.refine = {readSetting(settings, kRefineErrorSetting, parsePositive),
                            readSetting(settings, kMinEdgeSetting, parsePositive)};
        arguments.limits.maxVertices = readSetting(settings, kMaxVerticesSetting, parseVertexCount);
    } catch (const Error& error) {
        throw Error(error.code(), std::string("its manifest ") + error.what(), folder.string());
    }
}

Provenance makeProvenance(const BakeArguments& arguments, const BakeStats& stats) {
    const BakeOptions& bake = arguments.bake;
    const bool infinite = bake.bounceCount == kInfiniteBounces;
    std::string command = fmt::format(
        "bake --transport {} --bands {}{} --samples {} --bounces {} --max-edge {} {} --seed "
        "{} --isa {}",
        transportName(bake.transport), bake.bandCount,
        isGlossy(bake.transport) ? fmt::format(" --incident-bands {}", bake.incidentBandCount) : "",
        bake.sampleCount, infinite ? "inf" : std::to_string(bake.bounceCount),
        formatEdgeLength(arguments.maxEdgeLength), describeMethod(arguments.method), bake.seed,
        isaName(stats.isa));
    command += describeBrdfs(arguments);
    const RefineArguments& refine = arguments.refine;
    if (refine.maxError > 0.0f)
        command +=
            fmt::format(" --refine-error {} --min-edge {} --max-vertices {}", refine.maxError,
                        refine.minEdgeLength, arguments.limits.refinedVertices());
    return {.generator = "OpenPRT " PRT_VERSION,
            .command = command,
            .sampleCount = bake.sampleCount,
            .bounceCount = stats.bounceCount,
            .seed = bake.seed,
            .isa = std::string(isaName(stats.isa))};
}

}  // namespace prt::cli
