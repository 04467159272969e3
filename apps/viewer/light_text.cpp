#include "apps/viewer/light_text.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "apps/common/parse.h"

namespace prt::viewer {
namespace {

struct KindTraits {
    std::string_view prefix;
    const char* name;
    std::array<LightNumber, 3> numbers;
};

constexpr LightNumber kAzimuth{"azimuth", -180.0, 180.0, 30.0};
constexpr LightNumber kTurbidity{"turbidity", 2.0, 10.0, 3.0};

/// In the sequence of LightKind.
constexpr std::array<KindTraits, 4> kKinds = {{
    {"uniform:",
     "uniform light",
     {{{"red", 0.0, 4.0, 1.0}, {"green", 0.0, 4.0, 1.0}, {"blue", 0.0, 4.0, 1.0}}}},
    {"sun:",
     "a sun",
     {{kAzimuth, {"elevation", -90.0, 90.0, 40.0}, {"diameter", 0.0, 90.0, 10.0}}}},
    {"sky:", "a clear sky", {{kAzimuth, {"elevation", 0.0, 90.0, 40.0}, kTurbidity}}},
    {"daylight:", "sky and sun", {{kAzimuth, {"elevation", 0.0, 90.0, 40.0}, kTurbidity}}},
}};

const KindTraits& traitsOf(LightKind kind) {
    return kKinds[static_cast<std::size_t>(kind)];
}

/// The numbers that may be left out, filled in.
std::string complete(LightKind kind, const std::string& numbers) {
    const auto commaCount = std::count(numbers.begin(), numbers.end(), ',');
    if (kind == LightKind::uniform && commaCount == 0)
        return numbers + "," + numbers + "," + numbers;
    const bool hasTurbidity = kind == LightKind::sky || kind == LightKind::daylight;
    return hasTurbidity && commaCount == 1 ? numbers + ",3" : numbers;
}

/// Without zeros at the end.
std::string formatNumber(double number) {
    std::string digits = fmt::format("{:.2f}", number);
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.back() == '.') digits.pop_back();
    return digits == "-0" ? "0" : digits;
}

}  // namespace

const char* lightKindName(LightKind kind) {
    return traitsOf(kind).name;
}

std::span<const LightNumber, 3> lightNumbers(LightKind kind) {
    return traitsOf(kind).numbers;
}

LightText usualLight(LightKind kind) {
    LightText light{.kind = kind};
    std::ranges::transform(lightNumbers(kind), light.numbers.begin(), &LightNumber::usual);
    return light;
}

double usualStops(LightKind kind) {
    constexpr double kSkyStops = -5.0;  // 1 is 1000 cd/m2 there
    return kind == LightKind::sky || kind == LightKind::daylight ? kSkyStops : 0.0;
}

std::optional<LightText> parseLightText(const std::string& source) {
    for (std::size_t i = 0; i < kKinds.size(); ++i) {
        if (!source.starts_with(kKinds[i].prefix)) continue;
        const auto kind = static_cast<LightKind>(i);
        const auto triple =
            cli::parseTriple(complete(kind, source.substr(kKinds[i].prefix.size())));
        if (!triple) return std::nullopt;
        return LightText{kind, {triple->x, triple->y, triple->z}};
    }
    return std::nullopt;
}

std::string formatLightText(const LightText& light) {
    return fmt::format("{}{},{},{}", traitsOf(light.kind).prefix, formatNumber(light.numbers[0]),
                       formatNumber(light.numbers[1]), formatNumber(light.numbers[2]));
}

}  // namespace prt::viewer
