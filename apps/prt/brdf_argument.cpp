#include "apps/prt/brdf_argument.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "apps/prt/arguments.h"
#include "prt/base/error.h"
#include "prt/io/merl.h"

namespace prt::cli {
namespace {

constexpr std::string_view kMeasuredPrefix = "merl:";

/// Such a lobe is a mirror to every purpose of ours.
constexpr double kMaxExponent = 1e6;

/// A BRDF that numbers describe.
struct BrdfKind {
    std::string_view prefix;
    std::string_view form;
    std::size_t numberCount;
    std::size_t sharesCount;  ///< of its first numbers, which are from 0 to 1
    BrdfSource (*make)(const Vec3d& rgb, double fourth, double fifth);
};

constexpr std::array<BrdfKind, 4> kKinds = {
    {{"lambert:", "lambert:r,g,b", 3, 3,
      [](const Vec3d& rgb, double, double) -> BrdfSource {
          return {.brdf = {.lobes = {LambertLobe{.albedo = rgb}}}};
      }},
     {"phong:", "phong:r,g,b,exponent", 4, 3,
      [](const Vec3d& rgb, double exponent, double) -> BrdfSource {
          return {.brdf = {.lobes = {PhongLobe{.albedo = rgb, .exponent = exponent}}}};
      }},
     {"ggx:", "ggx:r,g,b,roughness", 4, 4,
      [](const Vec3d& rgb, double roughness, double) -> BrdfSource {
          return {.brdf = {.lobes = {GgxLobe{.f0 = rgb, .alpha = roughness * roughness}}},
                  .ggxRoughness = roughness};
      }},
     {"gltf:", "gltf:r,g,b,metallic,roughness", 5, 5,
      [](const Vec3d& rgb, double metallic, double roughness) -> BrdfSource {
          return {.brdf = makeGltfBrdf(
                      Vec3f(rgb), {static_cast<float>(metallic), static_cast<float>(roughness)})};
      }}}};

bool startsWithKind(std::string_view text) {
    return text.starts_with(kMeasuredPrefix) ||
           std::any_of(kKinds.begin(), kKinds.end(),
                       [&](const BrdfKind& kind) { return text.starts_with(kind.prefix); });
}

[[noreturn]] void throwMalformed(const std::string& argument, const std::string& complaint) {
    throw Error(ErrorCode::invalidOption, complaint, argument.empty() ? "''" : argument,
                "see prt brdf --help");
}

/// "0.5,1,2"; empty if a part is not a number.
std::vector<double> parseNumbers(std::string_view text) {
    std::vector<double> numbers;
    for (std::size_t start = 0; start <= text.size();) {
        const std::size_t comma = std::min(text.find(',', start), text.size());
        const std::optional<double> number = parseNumber(text.substr(start, comma - start));
        if (!number) return {};
        numbers.push_back(*number);
        start = comma + 1;
    }
    return numbers;
}

BrdfSource parseKind(const std::string& spec, const BrdfKind& kind) {
    std::vector<double> numbers = parseNumbers(std::string_view(spec).substr(kind.prefix.size()));
    if (numbers.size() != kind.numberCount)
        throwMalformed(spec, fmt::format("is not {} with {} numbers", kind.form, kind.numberCount));
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const double largest = i < kind.sharesCount ? 1.0 : kMaxExponent;
        if (numbers[i] < 0.0 || numbers[i] > largest)
            throwMalformed(spec, fmt::format("has {} where a number from 0 to {} is wanted",
                                             numbers[i], largest));
    }
    numbers.resize(5, 0.0);
    return kind.make({numbers[0], numbers[1], numbers[2]}, numbers[3], numbers[4]);
}

/// MATERIAL=SPEC or SPEC; names may hold the sign too.
BrdfArgument parseArgument(const std::string& text) {
    if (!startsWithKind(text))
        for (std::size_t sign = text.find('='); sign != std::string::npos;
             sign = text.find('=', sign + 1))
            if (startsWithKind(std::string_view(text).substr(sign + 1)))
                return {text.substr(0, sign), loadBrdf(text.substr(sign + 1)).brdf};
    return {{}, loadBrdf(text).brdf};
}

std::string listNames(const Scene& scene) {
    std::set<std::string> names;
    for (const Material& material : scene.materials)
        if (!material.name.empty()) names.insert(material.name);
    if (names.empty()) return "its materials have no names; leave the name out to mean all of them";
    return fmt::format("its materials: {}", fmt::join(names, ", "));
}

}  // namespace

BrdfSource loadBrdf(const std::string& spec) {
    for (const BrdfKind& kind : kKinds)
        if (spec.starts_with(kind.prefix)) return parseKind(spec, kind);
    if (!spec.starts_with(kMeasuredPrefix))
        throwMalformed(spec,
                       "is not one of lambert: phong: ggx: gltf: with its numbers, or "
                       "merl:FILE.binary");
    LoadedMerlBrdf loaded = readMerlBrdf(spec.substr(kMeasuredPrefix.size()));
    return {.brdf = {.lobes = {MeasuredLobe{std::move(loaded.brdf)}}},
            .negativeCount = loaded.negativeCount};
}

void addBrdfOption(CLI::App& command, std::vector<BrdfArgument>& arguments) {
    const auto read = [&arguments](const std::vector<std::string>& texts) {
        for (const std::string& text : texts)
            arguments.push_back(parseArgument(text));
    };
    command
        .add_option_function<std::vector<std::string>>(
            "--brdf", read,
            "what materials are made of instead (see prt brdf --help); may be given again")
        ->type_name("[MATERIAL=]SPEC")
        ->allow_extra_args(false);
}

GivenBrdfs resolveBrdfs(const Scene& scene, std::span<const BrdfArgument> arguments,
                        const std::string& scenePath) {
    if (arguments.empty()) return {};
    GivenBrdfs named(scene.materials.size());
    std::optional<Brdf> ofOthers;
    for (const BrdfArgument& argument : arguments) {
        bool isTaken = !argument.material && ofOthers;
        bool isFound = !argument.material;
        if (!argument.material) ofOthers = argument.brdf;
        for (std::size_t i = 0; i < named.size(); ++i)
            if (scene.materials[i].name == argument.material) {
                isTaken = isTaken || named[i];
                isFound = true;
                named[i] = argument.brdf;
            }
        if (isTaken)
            throw Error(ErrorCode::invalidOption,
                        argument.material ? fmt::format("is given twice for the material '{}'",
                                                        *argument.material)
                                          : "is given twice for all materials",
                        "--brdf");
        if (!isFound)
            throw Error(ErrorCode::invalidOption,
                        fmt::format("has no material named '{}'", *argument.material), scenePath,
                        listNames(scene));
    }
    for (std::optional<Brdf>& brdf : named)
        if (!brdf) brdf = ofOthers;
    return named;
}

}  // namespace prt::cli
