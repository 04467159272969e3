#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "apps/prt/light_sum.h"

namespace prt::cli {

/// Where the light itself is written to as an image, and how.
struct EnvironmentOutput {
    std::string path;
    SphereMap layout = SphereMap::latLong;
    int cellSize = 512;       ///< as sphereMapSize takes it
    std::string prefiltered;  ///< a folder of cubes for rough mirrors
    int prefilteredSize = 128;
};

/// Adds --environment, --layout, --size, --prefilter and --prefilter-size.
void addEnvironmentOptions(CLI::App& command, EnvironmentOutput& output);

/// @throws Error  invalidOption for a path of another suffix, or a folder that is there
void checkEnvironmentOutput(const EnvironmentOutput& output);

/// Writes what was asked for, if anything. @throws Error writeFailed
void writeEnvironmentOutput(const LightSum& sum, const EnvironmentOutput& output);

}  // namespace prt::cli
