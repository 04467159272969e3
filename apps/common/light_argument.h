#pragma once

#include <memory>
#include <optional>
#include <string>

#include "prt/io/image_io.h"
#include "prt/light/environment.h"
#include "prt/light/lighting.h"
#include "prt/render/distant_light.h"

namespace prt::cli {

/// The forms of LIGHT, for --help.
inline constexpr const char* kLightHelp = R"(LIGHT is one of
  FILE.exr .hdr .png .jpg  an environment: lat-long, angular map, cross or strip, told by its shape;
                           an octahedral map with --map;
                           or a folder with six faces px nx py ny pz nz
  uniform:r,g,b            the same radiance from everywhere (uniform:v for grey)
  sun:azimuth,elevation,angle
                           a disc of unit irradiance on a surface facing it, in degrees: azimuth
                           from +x towards +z, elevation above the horizon, angle its diameter
  sky:azimuth,elevation[,turbidity]
                           a clear sky whose sun stands there, without the sun itself; turbidity 2
                           (clear) to 10 (hazy) [3]; 1 is 1000 cd/m2, so expose by some -5 stops
  daylight:azimuth,elevation[,turbidity]
                           the same with its sun
  FILE.json                coefficients as `prt light --format json` writes them)";

/// Whether a file's name is that of an image, which may be a light: .exr .hdr .png .jpg .jpeg.
bool isImageName(const std::string& path);

/// The layouts of images, "lat-long|angular|…".
std::string sphereMapNames();

/// A disc in the sky, as sunLighting projects it.
struct Sun {
    Vec3d direction{0.0, 1.0, 0.0};
    double halfAngleRadians = 0.0;
};

/// What people call a LIGHT argument: "museum" for lights/museum.exr, else the argument itself.
std::string nameLight(const std::string& argument);

/// What a LIGHT argument stands for.
struct LightSource {
    Lighting lighting;
    std::optional<Environment> environment{};  ///< where the light is an image
    SanitiseReport mended{};                   ///< what had to be mended in that image
    std::optional<Sun> sun{};                  ///< where it is one
};

/// Reads a LIGHT argument.
///
/// @param bandCount  of the lighting; coefficients from a file may have fewer
/// @param map        forces the layout of an image
/// @param limits     of an image
/// @throws Error     as the readers of files; invalidOption for a malformed argument
LightSource loadLight(const std::string& argument, int bandCount, std::optional<SphereMap> map,
                      const ImageLimits& limits);

/// The sentence that says which texels were mended; nothing where all were good.
std::optional<std::string> describeMending(const SanitiseReport& mended);

/// The light itself rather than its bands; coefficients stand for themselves.
std::unique_ptr<DistantLight> makeExactLight(const LightSource& light, const Mat3d& rotation);

/// The light as an image to be seen behind a scene: the environment, or
/// what the coefficients stand for.
Environment makeBackground(const LightSource& light);

/// The same with its sun, as mirrors show it.
Environment makeMirroredLight(const LightSource& light);

/// The light itself as an image; coefficients stand for themselves.
///
/// @param cellSize  as sphereMapSize takes it
Environment drawLight(const LightSource& light, const Mat3d& rotation, SphereMap map, int cellSize);

}  // namespace prt::cli
