#include "prt/light/lighting.h"

#include <algorithm>

#include "prt/base/assert.h"
#include "prt/basis/sh_rotation.h"

namespace prt {

Lighting rotate(const Lighting& lighting, const Mat3d& rotation) {
    const ShRotation shRotation(rotation, lighting.bandCount);
    Lighting rotated(lighting.bandCount);
    std::vector<double> source(lighting.coefficients.size());
    std::vector<double> target(lighting.coefficients.size());
    for (int channel = 0; channel < 3; ++channel) {
        for (std::size_t i = 0; i < source.size(); ++i)
            source[i] = lighting.coefficients[i][channel];
        shRotation.apply(source, target);
        for (std::size_t i = 0; i < target.size(); ++i)
            rotated.coefficients[i][channel] = target[i];
    }
    return rotated;
}

Lighting add(const Lighting& a, const Lighting& b) {
    PRT_ASSERT(a.bandCount == b.bandCount, "both lights have the same bands");
    Lighting sum = a;
    for (std::size_t i = 0; i < sum.coefficients.size(); ++i)
        sum.coefficients[i] += b.coefficients[i];
    return sum;
}

Lighting scale(const Lighting& lighting, double factor) {
    Lighting scaled = lighting;
    for (Vec3d& coefficient : scaled.coefficients)
        coefficient *= factor;
    return scaled;
}

Lighting applyWindow(const Lighting& lighting, std::span<const double> factors) {
    PRT_ASSERT(factors.size() == static_cast<std::size_t>(lighting.bandCount),
               "there is one factor a band");
    Lighting windowed = lighting;
    for (std::size_t i = 0; i < windowed.coefficients.size(); ++i) {
        windowed.coefficients[i] *=
            factors[static_cast<std::size_t>(shDegree(static_cast<int>(i)))];
    }
    return windowed;
}

Lighting truncate(const Lighting& lighting, int bandCount) {
    PRT_ASSERT(bandCount >= 1 && bandCount <= lighting.bandCount, "the bands kept are there");
    Lighting truncated(bandCount);
    std::copy_n(lighting.coefficients.begin(), truncated.coefficients.size(),
                truncated.coefficients.begin());
    return truncated;
}

Vec3d reconstruct(const Lighting& lighting, const Vec3d& direction) {
    std::vector<double> values(lighting.coefficients.size());
    evaluateSh(direction, lighting.bandCount, values);
    Vec3d radiance(0.0);
    for (std::size_t i = 0; i < values.size(); ++i)
        radiance += lighting.coefficients[i] * values[i];
    return radiance;
}

}  // namespace prt
