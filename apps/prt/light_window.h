#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "apps/common/ringing.h"
#include "prt/light/lighting.h"

namespace prt::cli {

/// How ringing is lowered, as --window and --nonnegative say.
struct WindowArguments {
    std::string window = "none";
    std::string nonNegative = "radiance";  ///< or "irradiance", or the path of an asset
};

/// Adds --window.
void addWindowOption(CLI::App& command, std::string& window, const std::string& help);

/// Adds --window and --nonnegative.
void addWindowOptions(CLI::App& command, WindowArguments& arguments);

/// The window and what it is for, in a few words.
std::string describeWindow(const WindowArguments& arguments);

/// @throws Error  as readAsset for the asset; invalidOption if it has fewer bands than the light
Lighting lowerRinging(const Lighting& lighting, const WindowArguments& arguments);

}  // namespace prt::cli
