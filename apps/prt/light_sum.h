#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/common/light_argument.h"
#include "apps/prt/limits.h"
#include "prt/light/sun_split.h"

namespace prt::cli {

/// What is done to each of several LIGHT arguments before they are added.
struct LightSumOptions {
    std::optional<SphereMap> map{};  ///< forces the layout of images
    Mat3d rotation{};
    Vec3d factor{1.0, 1.0, 1.0};
    bool withoutSuns = false;  ///< images lose their sun, where they have one
    ReaderLimits limits{};
};

/// Several lights as one.
struct LightSum {
    LightSumOptions options{};
    std::vector<LightSource> sources{};
    std::vector<DiscLight> suns{};  ///< that were taken out, turned and scaled as the rest
    Lighting lighting{};            ///< the sum
    int knownBandCount = 0;         ///< bands that at least one of them has
};

/// Reads the lights, and warns on stderr of what had to be mended in them.
///
/// @throws Error  as loadLight
LightSum sumLights(const std::vector<std::string>& arguments, const LightSumOptions& options,
                   int bandCount);

/// The lights themselves as one image. @param cellSize  as sphereMapSize takes it
Environment drawLights(const LightSum& sum, SphereMap map, int cellSize);

/// The arguments that stand for a sun that was taken out: "sun:30,45,0.5 --scale 1,1,1".
std::string describeSun(const DiscLight& sun);

}  // namespace prt::cli
