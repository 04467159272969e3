#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "apps/common/shown_transport.h"
#include "apps/prt/stage_log.h"
#include "prt/asset/asset.h"
#include "prt/io/image_io.h"
#include "prt/light/lighting.h"

namespace prt::cli {

/// readShownAsset, its warnings passed on.
///
/// @param limits  of its textures
Asset readPreparedAsset(const std::string& path, const ImageLimits& limits, StageLog& log);

/// What --rotate and --window make of a light.
struct LightingArguments {
    Vec3d rotationDegrees{0.0, 0.0, 0.0};
    std::string window = "none";
};

/// Adds --rotate and --window.
void addLightingOptions(CLI::App& command, LightingArguments& arguments);

/// The light as it is turned and smoothed for what is shown of an asset.
///
/// @param path  how to call the asset in an error
Lighting prepareLighting(const Lighting& lighting, const LightingArguments& arguments,
                         const Asset& asset, const std::string& path, ShownTransport shown);

}  // namespace prt::cli
