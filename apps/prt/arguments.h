#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "apps/common/parse.h"

namespace prt::cli {

/// A command line that would do the same again, without the option that says where to.
///
/// @param start  the words before the options
std::string describeCommand(const std::string& start, const CLI::App& command,
                            std::string_view outputOption);

/// Adds an option whose text `parse` turns into an optional value; without one it is wrong usage.
///
/// @param expected  what the option takes, for the help and the error: "none|aces|neutral"
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
