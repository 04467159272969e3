#include "apps/prt/compress_method.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string_view>

#include <fmt/format.h>

#include "apps/common/light_argument.h"
#include "apps/common/text.h"
#include "apps/prt/arguments.h"
#include "prt/base/error.h"
#include "prt/compress/compression_error.h"

namespace prt::cli {

const char* const kMethodHelp =
    R"(Choose --method cpca: vertices in clusters, each of which is a sum of a few vectors that its cluster has.
With 64 clusters of 15 components an RGB layer of 5 bands, 300 bytes a vertex as floats, takes some 19, and
what is seen is off by a few thousandths. --bytes-per-vertex 16 finds the best clusters for a size, and
--max-error 0.005 the fewest bytes for an error. Name the light that you have in mind with --weigh-by (see
prt light --help): what is kept is then what it shows. u16 and u8 store each coefficient by itself: of u16
nothing can be seen, of u8 little. pca and vq are the two halves of clusters, to compare with.

Of matrices (glossy transport) what clusters share outweighs what vertices store: --bases u8 halves it at
little cost. With 256 clusters of 11 components a mono layer of 5 and 5 bands, 2500 bytes a vertex as floats
and 124 MB for 50,000 vertices, takes 51 and 2.5 MB, and errs by 2.7 %: no more than 256 rays do.)";

namespace {

constexpr std::size_t kMaxCount = 65536;
constexpr std::size_t kLeastVertexBytes = CoefficientTable::kPanelWidth;

enum class Form { columns, pca, vq, clusters };

struct Method {
    std::string_view name;
    Form form;
    TransferEncoding encoding = TransferEncoding::float32;  ///< of columns
    std::size_t clusterCount = 0;                           ///< by default
    std::size_t componentCount = 0;
};

constexpr std::array<Method, 6> kMethods = {{
    {"float", Form::columns, TransferEncoding::float32},
    {"u16", Form::columns, TransferEncoding::unorm16},
    {"u8", Form::columns, TransferEncoding::unorm8},
    {"pca", Form::pca, TransferEncoding::unorm8, 1, 23},
    {"vq", Form::vq, TransferEncoding::unorm8, 256, 0},
    {"cpca", Form::clusters, TransferEncoding::unorm8, 64, 15},
}};

const Method* findMethod(std::string_view name) {
    const auto found = std::ranges::find(kMethods, name, &Method::name);
    return found == kMethods.end() ? nullptr : &*found;
}

std::optional<std::string> parseMethod(const std::string& name) {
    return findMethod(name) ? std::optional(name) : std::nullopt;
}

std::optional<TransferEncoding> parseWeights(std::string_view name) {
    const Method* method = findMethod(name);
    return method && method->form == Form::columns ? std::optional(method->encoding) : std::nullopt;
}

std::string_view weightsName(TransferEncoding encoding) {
    return std::ranges::find(kMethods, encoding, &Method::encoding)->name;
}

std::optional<std::size_t> parseCount(std::string_view text) {
    const std::optional<std::uint64_t> count = parseWholeNumber(text);
    return count && *count > 0 && *count <= kMaxCount ? std::optional<std::size_t>(*count)
                                                      : std::nullopt;
}

std::optional<double> parsePositive(std::string_view text) {
    const std::optional<double> number = parseNumber(text);
    return number && *number > 0.0 ? number : std::nullopt;
}

[[noreturn]] void refuse(const std::string& option, const std::string& why) {
    throw CLI::ValidationError(option, why);
}

/// Refuses options that the method has no use for.
void checkMethod(const Method& method, const MethodArguments& arguments) {
    const std::string with = fmt::format("has no meaning with --method {}", method.name);
    if (arguments.clusterCount && method.form != Form::vq && method.form != Form::clusters)
        refuse("--clusters", with);
    if (arguments.componentCount && method.form != Form::pca && method.form != Form::clusters)
        refuse("--components", with);
    if (arguments.weights && method.form != Form::pca && method.form != Form::clusters)
        refuse("--weights", with);
    if (arguments.bases && method.form == Form::columns) refuse("--bases", with);
    const std::string budget = arguments.bytesPerVertex ? "--bytes-per-vertex" : "--max-error";
    if (!arguments.bytesPerVertex && !arguments.maxError) return;
    if (arguments.bytesPerVertex && *arguments.bytesPerVertex < kLeastVertexBytes)
        refuse(budget, fmt::format("a vertex takes {} bytes at least", kLeastVertexBytes));
    if (arguments.bytesPerVertex && arguments.maxError)
        refuse("--bytes-per-vertex", "cannot be kept together with --max-error: give one of them");
    if (method.form != Form::clusters) refuse(budget, with);
    if (arguments.clusterCount || arguments.componentCount || arguments.weights)
        refuse(budget, "chooses clusters, components and weights itself: leave them out");
}

}  // namespace

void addMethodOptions(CLI::App& command, MethodArguments& arguments) {
    addParsedOption(command, "--method", arguments.method, parseMethod, "float|u16|u8|pca|vq|cpca",
                    "how transfer is stored, see below")
        ->default_str(arguments.byDefault);
    addParsedOption(command, "--clusters", arguments.clusterCount, parseCount, "N",
                    "of vq and cpca [256, 64]");
    addParsedOption(command, "--components", arguments.componentCount, parseCount, "N",
                    "of pca and of each cluster of cpca; best 3, 7, 11, ... [23, 15]");
    addParsedOption(command, "--weights", arguments.weights, parseWeights, "u8|u16|float",
                    "how a component's weight is stored [u8, u16 above 256 clusters]");
    addParsedOption(command, "--bases", arguments.bases, parseWeights, "u8|u16|float",
                    "how what a cluster's vertices share is stored [u16]");
    addParsedOption(command, "--bytes-per-vertex", arguments.bytesPerVertex, parsePositive, "BYTES",
                    "of each layer, bases and all: cpca chooses what gives the least error");
    addParsedOption(command, "--max-error", arguments.maxError, parsePositive, "PART",
                    "of the transfer, or as seen: cpca chooses what takes fewest bytes");
    command
        .add_option("--weigh-by", arguments.light,
                    "weigh and tell errors as they are seen under this light")
        ->type_name("LIGHT");
}

CompressOptions makeCompressOptions(const MethodArguments& arguments, std::uint64_t seed) {
    const Method& method = *findMethod(methodName(arguments));
    checkMethod(method, arguments);
    CompressOptions options{.encoding = method.encoding};
    if (method.form == Form::columns) return options;
    ClusterOptions& clusters = options.clusters.emplace();
    clusters.clusterCount = arguments.clusterCount.value_or(method.clusterCount);
    clusters.componentCount = arguments.componentCount.value_or(method.componentCount);
    clusters.basesEncoding = arguments.bases.value_or(clusters.basesEncoding);
    clusters.seed = seed;
    const bool fitBytes = clusters.clusterCount <= largestClusterCount(TransferEncoding::unorm8);
    if (!fitBytes) options.encoding = TransferEncoding::unorm16;
    if (arguments.weights) options.encoding = *arguments.weights;
    if (!fitBytes && options.encoding == TransferEncoding::unorm8)
        refuse("--weights", fmt::format("u8 numbers 256 clusters, not {}", clusters.clusterCount));
    if (arguments.bytesPerVertex) options.budget = {.bytesPerReceiver = *arguments.bytesPerVertex};
    if (arguments.maxError) options.budget = {.maxError = *arguments.maxError};
    return options;
}

std::vector<Vec3d> loadErrorLight(const MethodArguments& arguments, int bandCount,
                                  const ReaderLimits& limits) {
    if (arguments.light.empty()) return {};
    const Lighting light = loadLight(arguments.light, bandCount, {}, limits.images()).lighting;
    const Vec3d mean = light.coefficients.at(0);
    if (mean[0] + mean[1] + mean[2] <= 0.0)
        throw Error(ErrorCode::invalidOption, "is dark: no error would be seen under it",
                    arguments.light, "choose another light for --weigh-by");
    return light.coefficients;
}

std::string methodName(const MethodArguments& arguments) {
    if (arguments.method) return *arguments.method;
    const bool meansClusters = arguments.clusterCount || arguments.componentCount ||
                               arguments.weights || arguments.bases || arguments.bytesPerVertex ||
                               arguments.maxError;
    return meansClusters ? "cpca" : arguments.byDefault;
}

std::string describeMethod(const MethodArguments& arguments) {
    std::string text = fmt::format("--method {}", methodName(arguments));
    if (arguments.clusterCount) text += fmt::format(" --clusters {}", *arguments.clusterCount);
    if (arguments.componentCount)
        text += fmt::format(" --components {}", *arguments.componentCount);
    if (arguments.weights) text += fmt::format(" --weights {}", weightsName(*arguments.weights));
    if (arguments.bases) text += fmt::format(" --bases {}", weightsName(*arguments.bases));
    if (arguments.bytesPerVertex)
        text += fmt::format(" --bytes-per-vertex {}", *arguments.bytesPerVertex);
    if (arguments.maxError) text += fmt::format(" --max-error {}", *arguments.maxError);
    if (!arguments.light.empty())
        text += " --weigh-by " + std::filesystem::path(arguments.light).filename().string();
    return text;
}

double forecastVertexBytes(const CompressOptions& options, std::size_t coefficientCount,
                           std::size_t vertexCount) {
    constexpr std::size_t kWidth = CoefficientTable::kPanelWidth;
    if (options.budget)
        return std::max(options.budget->bytesPerReceiver, static_cast<double>(kLeastVertexBytes));
    const auto attributeBytes = [&](std::size_t count) {
        return static_cast<double>(CoefficientTable::countPanels(count) * kWidth *
                                   bytesPerCoefficient(options.encoding));
    };
    if (!options.clusters) return attributeBytes(coefficientCount);
    const std::size_t componentCount = std::min(options.clusters->componentCount, coefficientCount);
    const std::size_t clusterCount = std::min(options.clusters->clusterCount, vertexCount);
    const std::size_t sharedBytes = clusterCount * (1 + componentCount) * coefficientCount *
                                    bytesPerCoefficient(options.clusters->basesEncoding);
    return attributeBytes(1 + componentCount) +
           static_cast<double>(sharedBytes) / static_cast<double>(vertexCount);
}

void tellCompression(const CompressedLayer& layer, const TransferLayer& original,
                     std::size_t bytesBefore, const MethodArguments& arguments,
                     std::span<const Vec3d> light, StageLog& log) {
    const CompressionError error = measureCompressionError(layer, original, light);
    std::string text = fmt::format("{}: {} a vertex", transportName(layer.transport),
                                   formatCount(bytesPerReceiver(layer), "byte"));
    if (layer.bases)
        text += fmt::format(", {:.3g} with the bases of {},", countBytesPerReceiver(layer),
                            formatCount(layer.bases->clusterCount(), "cluster"));
    text += fmt::format(" instead of {}; error {:.2g} % of the transfer", bytesBefore,
                        100.0 * error.relativeRmse);
    if (!light.empty())
        text += fmt::format(", {:.2g} % {} under {}", 100.0 * error.seen,
                            isGlossy(layer.transport) ? "of what comes in" : "as seen",
                            arguments.light);
    log.tell(text + fmt::format(", at most {:.2g}", error.largest));
}

}  // namespace prt::cli
