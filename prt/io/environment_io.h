#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "prt/io/image_io.h"
#include "prt/light/environment.h"
#include "prt/light/lighting.h"

namespace prt {

/// An environment from a file, and what had to be mended in it.
struct LoadedEnvironment {
    Environment environment;
    SanitiseReport mended;
};

/// Reads an image as an environment. NaN and negative texels become 0, infinite ones the largest
/// finite value; all are counted.
///
/// @param path  an image, or a folder with six square faces named px nx py ny pz nz (or posx negx
///              …) as OpenGL stores them, which become a horizontal strip
/// @param map   the layout of an image; by default recognised from the shape
/// @throws Error  as readImage; malformed when no layout, or not the one wanted, has this shape;
///                invalidOption when a folder is given a layout
LoadedEnvironment loadEnvironment(const std::filesystem::path& path,
                                  std::optional<SphereMap> map = {},
                                  const ImageLimits& limits = {});

/// `{"bands": n, "convention": "cs", "coefficients": [[r, g, b], … n² of them]}`.
///
/// @param convention  what the coefficients are turned into
std::string lightingToJson(const Lighting& lighting, ShConvention convention = ShConvention::cs);

/// Reads what lightingToJson writes, in any of the named conventions.
///
/// @param name    how to call it in an error
/// @throws Error  malformed
Lighting lightingFromJson(const std::string& json, const std::string& name);

}  // namespace prt
