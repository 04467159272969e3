// Bibliography
//   [Ramamoorthi01]  An efficient representation for irradiance environment maps
#include "prt/light/environment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "prt/base/assert.h"
#include "prt/light/lat_long_projection.h"

namespace prt {
namespace {

/// The largest finite channel, at least 0.
float findLargestFinite(const Image& radiance) {
    float largest = 0.0f;
    for (const Vec3f& texel : radiance.pixels) {
        for (int channel = 0; channel < 3; ++channel) {
            if (std::isfinite(texel[channel])) largest = std::max(largest, texel[channel]);
        }
    }
    return largest;
}

/// Projects any image, each texel as if all its light came through its centre.
Lighting projectTexels(const Environment& environment, int bandCount) {
    const Image& image = environment.radiance;
    Lighting lighting(bandCount);
    std::vector<double> values(lighting.coefficients.size());
    double totalSolidAngle = 0.0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const SphereTexel texel = sphereTexel(environment.map, image.width, image.height, x, y);
            if (texel.solidAngle == 0.0) continue;
            totalSolidAngle += texel.solidAngle;
            const Vec3d flux = Vec3d(image.at(x, y)) * texel.solidAngle;
            evaluateSh(texel.direction, bandCount, values);
            for (std::size_t i = 0; i < values.size(); ++i) {
                lighting.coefficients[i] += flux * values[i];
            }
        }
    }
    return scale(lighting, 4.0 * std::numbers::pi / totalSolidAngle);
}

/// The solid angle that a texel shows of a disc.
double measureCoverage(const Environment& environment, int x, int y, const Vec3d& direction,
                       double halfAngleRadians) {
    constexpr int kSplit = 16;
    const Image& image = environment.radiance;
    const double cosine = std::cos(halfAngleRadians);
    double solidAngle = 0.0;
    for (int k = 0; k < kSplit * kSplit; ++k) {
        const SpherePlace place =
            spherePlace(environment.map, image.width, image.height, x + (k % kSplit + 0.5) / kSplit,
                        y + (k / kSplit + 0.5) / kSplit);
        if (place.direction.dot(direction) > cosine)
            solidAngle += place.solidAngleDensity / (kSplit * kSplit);
    }
    return solidAngle;
}

/// The terms of a row's Fourier series in azimuth, Σ_l L_lm p_lm for each m ≥ 0 and −m.
///
/// @param polar  y_lm of the row's polar angle at azimuth 0
void sumDegrees(const Lighting& lighting, std::span<const double> polar, std::span<Vec3d> cosines,
                std::span<Vec3d> sines) {
    for (int m = 0; m < lighting.bandCount; ++m) {
        Vec3d cosine(0.0), sine(0.0);
        for (int l = m; l < lighting.bandCount; ++l) {
            const double value = polar[static_cast<std::size_t>(shIndex(l, m))];
            cosine += lighting.coefficients[static_cast<std::size_t>(shIndex(l, m))] * value;
            sine += lighting.coefficients[static_cast<std::size_t>(shIndex(l, -m))] * value;
        }
        cosines[static_cast<std::size_t>(m)] = cosine;
        sines[static_cast<std::size_t>(m)] = m > 0 ? sine : Vec3d(0.0);
    }
}

Vec3d sumOrders(std::span<const Vec3d> cosines, std::span<const Vec3d> sines,
                double azimuthRadians) {
    const double cosStep = std::cos(azimuthRadians), sinStep = std::sin(azimuthRadians);
    double cosine = 1.0, sine = 0.0;
    Vec3d sum(0.0);
    for (std::size_t m = 0; m < cosines.size(); ++m) {
        sum += cosines[m] * cosine + sines[m] * sine;
        const double nextCosine = cosStep * cosine - sinStep * sine;
        sine = cosStep * sine + sinStep * cosine;
        cosine = nextCosine;
    }
    return sum;
}

}  // namespace

SanitiseReport sanitise(Image& radiance) {
    const float largest = findLargestFinite(radiance);
    SanitiseReport report;
    for (Vec3f& texel : radiance.pixels) {
        bool hasNan = false, hasInfinity = false, hasNegative = false;
        for (int channel = 0; channel < 3; ++channel) {
            float& value = texel[channel];
            hasNan |= std::isnan(value);
            hasInfinity |= value == std::numeric_limits<float>::infinity();
            hasNegative |= value < 0.0f;
            value = value >= 0.0f ? std::min(value, largest) : 0.0f;
        }
        report.nanCount += hasNan ? 1 : 0;
        report.infiniteCount += hasInfinity ? 1 : 0;
        report.negativeCount += hasNegative ? 1 : 0;
    }
    return report;
}

Lighting projectLighting(const Environment& environment, int bandCount) {
    PRT_ASSERT(bandCount >= 1, "there is at least one band");
    PRT_ASSERT(!environment.radiance.pixels.empty(), "the environment has texels");
    return environment.map == SphereMap::latLong ? projectLatLong(environment.radiance, bandCount)
                                                 : projectTexels(environment, bandCount);
}

Vec3f lookUpRadiance(const Environment& environment, const Vec3f& direction) {
    const Image& image = environment.radiance;
    Vec3f radiance(0.0f);
    for (const auto& [x, y, weight] :
         bilinearTexels(environment.map, image.width, image.height, direction)) {
        if (weight > 0.0f) radiance += image.at(x, y) * weight;
    }
    return radiance;
}

void addDisc(Environment& environment, const Vec3d& direction, double halfAngleRadians,
             const Vec3d& flux) {
    Image& image = environment.radiance;
    std::vector<double> coverage(image.pixels.size(), 0.0), solidAngles(image.pixels.size(), 0.0);
    double total = 0.0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const auto index = static_cast<std::size_t>(y * image.width + x);
            const SphereTexel texel = sphereTexel(environment.map, image.width, image.height, x, y);
            solidAngles[index] = texel.solidAngle;
            if (texel.solidAngle == 0.0) continue;
            // No texel of these maps is longer than eight times the root of its solid angle, but at
            // the poles, where it is one row high.
            const double reach = std::max(8.0 * std::sqrt(texel.solidAngle), 8.0 / image.height);
            const double angle = std::acos(std::clamp(texel.direction.dot(direction), -1.0, 1.0));
            if (angle < halfAngleRadians - reach)
                coverage[index] = texel.solidAngle;
            else if (angle < halfAngleRadians + reach)
                coverage[index] = measureCoverage(environment, x, y, direction, halfAngleRadians);
            total += coverage[index];
        }
    }
    if (total == 0.0) {
        const Vec2f center =
            pixelFromDirection(environment.map, image.width, image.height, Vec3f(direction));
        const int x = std::clamp(static_cast<int>(center.x), 0, image.width - 1);
        const int y = std::clamp(static_cast<int>(center.y), 0, image.height - 1);
        coverage[static_cast<std::size_t>(y * image.width + x)] = total = 1.0;
    }
    for (std::size_t i = 0; i < coverage.size(); ++i)
        if (coverage[i] > 0.0 && solidAngles[i] > 0.0)
            image.pixels[i] += Vec3f(flux * (coverage[i] / total / solidAngles[i]));
}

Image reconstructLatLong(const Lighting& lighting, int width) {
    PRT_ASSERT(width >= 2 && width % 2 == 0, "the width of a lat-long image is twice its height");
    // About +y as the pole a row is a Fourier series in azimuth, of 2n − 1 terms, not n².
    const Lighting aboutY = rotate(lighting, rotationX(0.5 * std::numbers::pi));
    const auto bandCount = static_cast<std::size_t>(lighting.bandCount);
    std::vector<double> polar(aboutY.coefficients.size());
    std::vector<Vec3d> cosines(bandCount), sines(bandCount);
    Image image(width, width / 2);
    for (int y = 0; y < image.height; ++y) {
        const double theta = std::numbers::pi * (y + 0.5) / image.height;
        evaluateSh(Vec3d(std::sin(theta), 0.0, std::cos(theta)), lighting.bandCount, polar);
        sumDegrees(aboutY, polar, cosines, sines);
        for (int x = 0; x < width; ++x)
            image.at(x, y) = Vec3f(sumOrders(
                cosines, sines, std::numbers::pi - 2.0 * std::numbers::pi * (x + 0.5) / width));
    }
    return image;
}

}  // namespace prt
