#include "apps/prt/light_sum.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <fmt/format.h>

namespace prt::cli {
namespace {

/// Takes the sun out of an image, and its share out of the coefficients.
std::optional<DiscLight> takeSunOut(LightSource& light) {
    if (!light.environment) return std::nullopt;
    SunSplit split = splitSun(*light.environment);
    if (!split.sun) return std::nullopt;
    light.lighting = projectLighting(split.rest, light.lighting.bandCount);
    light.environment = std::move(split.rest);
    return split.sun;
}

}  // namespace

LightSum sumLights(const std::vector<std::string>& arguments, const LightSumOptions& options,
                   int bandCount) {
    LightSum sum{.options = options, .lighting = Lighting(bandCount)};
    for (const std::string& argument : arguments) {
        LightSource light = loadLight(argument, bandCount, options.map, options.limits.images());
        if (const auto mending = describeMending(light.mended))
            fmt::print(stderr, "prt: warning: {}: {}\n", argument, *mending);
        if (options.withoutSuns) {
            if (std::optional<DiscLight> sun = takeSunOut(light)) {
                sun->direction = options.rotation * sun->direction;
                sun->radiance *= options.factor;
                sum.suns.push_back(*sun);
            }
        }
        const Lighting turned = scale(rotate(light.lighting, options.rotation), options.factor);
        // Coefficients from a file may have fewer bands; those that they lack are 0.
        sum.knownBandCount = std::max(sum.knownBandCount, turned.bandCount);
        for (std::size_t i = 0; i < turned.coefficients.size(); ++i)
            sum.lighting.coefficients[i] += turned.coefficients[i];
        sum.sources.push_back(std::move(light));
    }
    return sum;
}

Environment drawLights(const LightSum& sum, SphereMap map, int cellSize) {
    const auto [width, height] = sphereMapSize(map, cellSize);
    Environment drawn{map, Image(width, height)};
    for (const LightSource& light : sum.sources) {
        const Image image = drawLight(light, sum.options.rotation, map, cellSize).radiance;
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            drawn.radiance.pixels[i] += image.pixels[i] * Vec3f(sum.options.factor);
    }
    return drawn;
}

std::string describeSun(const DiscLight& sun) {
    constexpr double kDegrees = 180.0 / std::numbers::pi;
    const double sine = std::sin(sun.halfAngleRadians);
    const Vec3d irradiance = sun.radiance * (std::numbers::pi * sine * sine);
    return fmt::format("sun:{:.3f},{:.3f},{:.3f} --scale {:.6g},{:.6g},{:.6g}",
                       std::atan2(sun.direction.z, sun.direction.x) * kDegrees + 0.0,
                       std::asin(std::clamp(sun.direction.y, -1.0, 1.0)) * kDegrees + 0.0,
                       2.0 * sun.halfAngleRadians * kDegrees, irradiance.x, irradiance.y,
                       irradiance.z);
}

}  // namespace prt::cli
