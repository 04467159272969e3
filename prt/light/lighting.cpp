#include "prt/light/lighting.h"

#include <algorithm>

#include "prt/base/assert.h"
#include "prt/basis/sh_rotation.h"

namespace prt {

namespace {

/// The lighting with `change` made to the coefficients of each channel.
template <class Change>
Lighting changeChannels(const Lighting& lighting, const Change& change) {
    Lighting changed(lighting.bandCount);
    std::vector<double> values(lighting.coefficients.size());
    for (int channel = 0; channel < 3; ++channel) {
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = lighting.coefficients[i][channel];
        change(values);
        for (std::size_t i = 0; i < values.size(); ++i)
            changed.coefficients[i][channel] = values[i];
    }
    return changed;
}

}  // namespace

Lighting makeBasisLighting(int bandCount, int index) {
    PRT_ASSERT(index >= 0 && index < shCoefficientCount(bandCount), "a function of these bands");
    Lighting lighting(bandCount);
    lighting.coefficients[static_cast<std::size_t>(index)] = Vec3d(1.0);
    return lighting;
}

Lighting rotate(const Lighting& lighting, const Mat3d& rotation) {
    const std::size_t count = lighting.coefficients.size();
    std::vector<double> channels;
    for (int channel = 0; channel < 3; ++channel)
        for (const Vec3d& coefficient : lighting.coefficients)
            channels.push_back(coefficient[channel]);
    rotateSh(rotation, lighting.bandCount, channels, channels);

    Lighting rotated(lighting.bandCount);
    for (std::size_t i = 0; i < count; ++i)
        rotated.coefficients[i] = {channels[i], channels[count + i], channels[2 * count + i]};
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
    return scale(lighting, Vec3d(factor));
}

Lighting scale(const Lighting& lighting, const Vec3d& factor) {
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

Lighting convertTo(ShConvention convention, const Lighting& lighting) {
    return changeChannels(lighting,
                          [&](std::vector<double>& values) { convertShTo(convention, values); });
}

Lighting convertFrom(ShConvention convention, const Lighting& lighting) {
    return changeChannels(lighting,
                          [&](std::vector<double>& values) { convertShFrom(convention, values); });
}

Lighting interpolate(const Lighting& a, const Lighting& b, double t) {
    return add(scale(a, 1.0 - t), scale(b, t));
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
