// Bibliography
//   [Roughton24]  ZH3: Quadratic zonal harmonics
#include "prt/light/zh3.h"

#include <algorithm>
#include <cmath>

#include "prt/base/assert.h"
#include "prt/basis/zonal.h"
#include "prt/image/tone_curve.h"

namespace prt {
namespace {

constexpr double kY00 = 0.28209479177387814;  // sqrt(1 / (4 pi))
constexpr double kY10 = 0.48860251190291992;  // sqrt(3 / (4 pi)), of z
constexpr double kY20 = 0.31539156525252001;  // sqrt(5 / (16 pi)), of 3 z² − 1

/// The first degree as a vector: its value in a direction is √(3/4π) times the inner product.
Vec3d firstDegree(const Zh3& light, int channel) {
    return Vec3d(-light.linear[3][channel], -light.linear[1][channel], light.linear[2][channel]);
}

Zh3 takeLinear(const Lighting& lighting) {
    Zh3 light;
    std::copy_n(lighting.coefficients.begin(), light.linear.size(), light.linear.begin());
    return light;
}

}  // namespace

Vec3d zonalAxis(const Zh3& light) {
    const std::array<double, 3> first = {luminance(light.linear[1]), luminance(light.linear[2]),
                                         luminance(light.linear[3])};
    return optimalLinearDirection(first);
}

Zh3 compressToZh3(const Lighting& lighting) {
    PRT_ASSERT(lighting.bandCount >= 3, "the second degree is there");
    Zh3 light = takeLinear(lighting);
    std::array<double, 9> unit{};  // the second degree of z = 1
    rotateZonal(std::array{0.0, 0.0, 1.0}, zonalAxis(light), unit);
    for (std::size_t i = 4; i < unit.size(); ++i)
        light.zonal += lighting.coefficients[i] * unit[i];
    return light;
}

Zh3 hallucinateZh3(const Lighting& lighting) {
    PRT_ASSERT(lighting.bandCount >= 2, "the first degree is there");
    Zh3 light = takeLinear(lighting);
    const Vec3d axis = zonalAxis(light);
    for (int channel = 0; channel < 3; ++channel) {
        const double mean = light.linear[0][channel];
        if (mean <= 0.0) continue;
        const double ratio = std::abs(firstDegree(light, channel).dot(axis)) / mean;
        light.zonal[channel] = mean * ratio * (0.08 + 0.6 * ratio);
    }
    return light;
}

Lighting expandZh3(const Zh3& light) {
    Lighting lighting(3);
    std::copy(light.linear.begin(), light.linear.end(), lighting.coefficients.begin());
    std::array<double, 9> unit{};
    rotateZonal(std::array{0.0, 0.0, 1.0}, zonalAxis(light), unit);
    for (std::size_t i = 4; i < unit.size(); ++i)
        lighting.coefficients[i] = light.zonal * unit[i];
    return lighting;
}

Vec3d evaluateIrradiance(const Zh3& light, const Vec3d& normal) {
    const double z = normal.dot(zonalAxis(light));
    Vec3d irradiance = light.linear[0] * (clampedCosineFactor(0) * kY00) +
                       light.zonal * (clampedCosineFactor(2) * kY20 * (3.0 * z * z - 1.0));
    for (int channel = 0; channel < 3; ++channel)
        irradiance[channel] +=
            clampedCosineFactor(1) * kY10 * normal.dot(firstDegree(light, channel));
    return irradiance;
}

}  // namespace prt
