#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "prt/math/transform.h"
#include "prt/math/vector.h"

namespace prt::cli {

/// Width and height of a picture, in pixels.
struct PictureSize {
    int width = 1280;
    int height = 720;
};

/// Each reads the whole text, or nothing.
std::optional<double> parseNumber(std::string_view text);              ///< finite
std::optional<std::uint64_t> parseWholeNumber(std::string_view text);  ///< not negative
std::optional<Vec3d> parseTriple(std::string_view text);               ///< "x,y,z"
std::optional<PictureSize> parsePictureSize(
    std::string_view text);  ///< "1280x720", each side 1 … 16384

/// What parseBounceCount makes of "inf", as the library does.
inline constexpr int kEveryBounce = -1;
std::optional<int> parseBounceCount(std::string_view text);  ///< 0 … 1000, or "inf"

/// Turned by so many degrees about the world's x axis, then y, then z.
Mat3d rotationFromDegrees(const Vec3d& degrees);

/// The path's suffix with its full stop, in lower case.
std::string lowerSuffix(const std::string& path);

/// @throws Error  invalidOption if the path does not end in one of the suffixes ".png .exr"
void requireSuffix(const std::string& path, std::string_view suffixes);

/// A command line that would do the same again, without the option that says where to.
///
/// @param start  the words before the options
std::string describeCommand(const std::string& start, const CLI::App& command,
                            std::string_view outputOption);

/// Adds an option whose text `parse` turns into an optional value; without one it is wrong usage.
///
/// @param expected  what the option takes, for the help and the error: "none|aces"
template <class Target, class Parse>
CLI::Option* addParsedOption(CLI::App& command, const std::string& name, Target& value, Parse parse,
                             const std::string& expected, const std::string& help) {
    const auto read = [&value, parse, name, expected](const std::string& text) {
        const auto parsed = parse(text);
        if (!parsed)
            throw CLI::ValidationError(name, fmt::format("'{}' is not {}", text, expected));
        value = *parsed;
    };
    return command.add_option_function<std::string>(name, read, help)->type_name(expected);
}

/// Adds an option that takes an integer of [low, high] and shows its default.
template <class Integer>
CLI::Option* addIntegerOption(CLI::App& command, const std::string& name, Integer& value,
                              Integer low, Integer high, const std::string& help) {
    return command.add_option(name, value, help)
        ->check(CLI::Range(low, high).description(""))
        ->type_name("N")
        ->capture_default_str();
}

}  // namespace prt::cli
