#include "prt/light/analytic_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

Lighting discLighting(const Vec3d& direction, double halfAngleRadians, const Vec3d& radiance,
                      int bandCount) {
    return zonalLighting(capZonal(bandCount, halfAngleRadians), direction, radiance);
}

Lighting sunLighting(const Vec3d& direction, double halfAngleRadians, int bandCount) {
    if (halfAngleRadians == 0.0) {
        Lighting lighting(bandCount);
        std::vector<double> values(lighting.coefficients.size());
        evaluateSh(direction, bandCount, values);
        std::transform(values.begin(), values.end(), lighting.coefficients.begin(),
                       [](double value) { return Vec3d(value); });
        return lighting;
    }
    // A facing surface sees π sin² α of a disc, and no more than its own hemisphere.
    const double sine = std::sin(std::min(halfAngleRadians, 0.5 * std::numbers::pi));
    return discLighting(direction, halfAngleRadians, Vec3d(std::numbers::inv_pi / (sine * sine)),
                        bandCount);
}

}  // namespace prt
