#include "prt/light/analytic_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "prt/base/assert.h"
#include "prt/basis/zonal.h"

namespace prt {
namespace {

/// A zonal function about `axis`, in the given colour.
Lighting zonalLighting(std::span<const double> zonal, const Vec3d& axis, const Vec3d& color) {
    Lighting lighting(static_cast<int>(zonal.size()));
    std::vector<double> coefficients(lighting.coefficients.size());
    rotateZonal(zonal, axis, coefficients);
    for (std::size_t i = 0; i < coefficients.size(); ++i) {
        lighting.coefficients[i] = color * coefficients[i];
    }
    return lighting;
}

}  // namespace

Lighting uniformLighting(const Vec3d& radiance, int bandCount) {
    Lighting lighting(bandCount);
    lighting.coefficients[0] = radiance * (2.0 / std::numbers::inv_sqrtpi);
    return lighting;
}

Lighting directionalLighting(const Vec3d& direction, const Vec3d& irradiance, int bandCount) {
    Lighting lighting(bandCount);
    std::vector<double> values(lighting.coefficients.size());
    evaluateSh(direction, bandCount, values);
    for (std::size_t i = 0; i < values.size(); ++i)
        lighting.coefficients[i] = irradiance * values[i];
    return lighting;
}

Lighting discLighting(const Vec3d& direction, double halfAngleRadians, const Vec3d& radiance,
                      int bandCount) {
    return zonalLighting(capZonal(bandCount, halfAngleRadians), direction, radiance);
}

Lighting sunLighting(const Vec3d& direction, double halfAngleRadians, int bandCount) {
    if (halfAngleRadians == 0.0) return directionalLighting(direction, Vec3d(1.0), bandCount);
    // A facing surface sees π sin² α of a disc, and no more than its own hemisphere.
    const double sine = std::sin(std::min(halfAngleRadians, 0.5 * std::numbers::pi));
    return discLighting(direction, halfAngleRadians, Vec3d(std::numbers::inv_pi / (sine * sine)),
                        bandCount);
}

Lighting sphereLighting(const Vec3d& center, double radius, const Vec3d& radiance, int bandCount) {
    PRT_ASSERT(radius > 0.0, "a sphere has an extent");
    const double distance = center.length();
    if (distance <= radius) return uniformLighting(radiance, bandCount);
    return discLighting(center / distance, std::asin(radius / distance), radiance, bandCount);
}

Lighting hemisphereLighting(const Vec3d& up, const Vec3d& skyRadiance, const Vec3d& groundRadiance,
                            int bandCount) {
    return add(uniformLighting(groundRadiance, bandCount),
               discLighting(up, 0.5 * std::numbers::pi, skyRadiance - groundRadiance, bandCount));
}

Lighting gradientLighting(const Vec3d& up, const Vec3d& topRadiance, const Vec3d& bottomRadiance,
                          int bandCount) {
    std::vector<double> zonal(static_cast<std::size_t>(bandCount), 0.0);
    // cos θ is y_10 over its constant, √(3/4π).
    if (bandCount > 1) zonal[1] = 0.5 * std::sqrt(4.0 * std::numbers::pi / 3.0);
    return add(uniformLighting((topRadiance + bottomRadiance) * 0.5, bandCount),
               zonalLighting(zonal, up, topRadiance - bottomRadiance));
}

}  // namespace prt
