#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

namespace prt::viewer {

enum class LightKind { uniform, sun, sky, daylight };

/// A LIGHT argument whose numbers can be chosen on sliders.
struct LightText {
    LightKind kind = LightKind::uniform;
    std::array<double, 3> numbers{};  ///< as lightNumbers(kind) calls them
};

/// One of the numbers of a light.
struct LightNumber {
    const char* name;
    double least;
    double most;
    double usual;
};

/// "a sun"
const char* lightKindName(LightKind kind);
std::span<const LightNumber, 3> lightNumbers(LightKind kind);

/// A light of usual numbers.
LightText usualLight(LightKind kind);
/// With this factor in stops it is about as bright as the others.
double usualStops(LightKind kind);

/// None for a file, and for text whose numbers are not as `prt light --help` says.
std::optional<LightText> parseLightText(const std::string& source);

/// The LIGHT argument, with numbers of at most two decimals.
std::string formatLightText(const LightText& light);

}  // namespace prt::viewer
