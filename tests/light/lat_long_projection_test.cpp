#include "prt/light/lat_long_projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "prt/base/random.h"
#include "prt/math/quadrature.h"
#include "tests/support/instruction_sets.h"

namespace prt {
namespace {

constexpr double kPi = std::numbers::pi;

// Sizes with an odd width, an odd half, a single row or column, and with less than a vector.
constexpr std::pair<int, int> kSizes[] = {{1, 1}, {2, 1},  {3, 1},   {4, 2},   {5, 3},
                                          {6, 3}, {14, 7}, {33, 17}, {34, 17}, {64, 32}};

/// Mostly dim, with a sun of 1e5 in some texels.
Image makeSunnyImage(int width, int height) {
    RandomStream random(31, static_cast<std::uint64_t>(width));
    Image image(width, height);
    for (Vec3f& texel : image.pixels) {
        for (int channel = 0; channel < 3; ++channel)
            texel[channel] = random.nextUnitFloat();
    }
    image.at(width / 3, height / 4) = Vec3f(1e5f, 0.9e5f, 0.7e5f);
    image.at(width - 1, height - 1) = Vec3f(10.0f, 1e5f, 0.0f);
    return image;
}

/// The oracle: each texel by a rule over its area, without use of symmetry or separation (C4).
Lighting integrateTexels(const Image& image, int bandCount, int nodeCount) {
    Lighting lighting(bandCount);
    std::vector<double> values(lighting.coefficients.size());
    const auto rule = gaussLegendre(nodeCount);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (const auto& [u, uWeight] : rule) {
                for (const auto& [v, vWeight] : rule) {
                    const double azimuth = 2 * kPi * ((x + 0.5 + 0.5 * u) / image.width - 0.5);
                    const double polar = kPi * (y + 0.5 + 0.5 * v) / image.height;
                    const double sine = std::sin(polar);
                    evaluateSh(
                        Vec3d(sine * std::cos(azimuth), std::cos(polar), sine * std::sin(azimuth)),
                        bandCount, values);
                    const double weight = 0.5 * uWeight * vWeight * kPi * kPi * sine /
                                          (double(image.width) * image.height);
                    for (std::size_t i = 0; i < values.size(); ++i)
                        lighting.coefficients[i] += Vec3d(image.at(x, y)) * (weight * values[i]);
                }
            }
        }
    }
    return lighting;
}

/// The largest difference of a coefficient, as a part of the largest coefficient.
double relativeDifference(const Lighting& a, const Lighting& b) {
    double difference = 0.0, largest = 0.0;
    for (std::size_t i = 0; i < a.coefficients.size(); ++i) {
        difference = std::max(difference, (a.coefficients[i] - b.coefficients[i]).length());
        largest = std::max(largest, b.coefficients[i].length());
    }
    return difference / largest;
}

TEST(ProjectLatLong, IsTheIntegralOverEveryTexelForAnySize) {
    constexpr double kRounding = 1e-13;
    for (const auto& [width, height] : kSizes) {
        const Image image = makeSunnyImage(width, height);
        for (const int bandCount : {1, 2, 3, 4, 5, 10}) {
            const Lighting truth = integrateTexels(image, bandCount, width > 30 ? 8 : 32);
            onEveryInstructionSet([&, columnCount = width] {
                EXPECT_LT(relativeDifference(projectLatLong(image, bandCount), truth), kRounding)
                    << "width " << columnCount << ", " << bandCount << " bands";
            });
        }
    }
}

TEST(ProjectLatLong, AConstantImageHasItsMeanAndNothingElse) {
    constexpr double kRounding = 1e-13;
    for (const auto& [width, height] : kSizes) {
        const Image image(width, height, Vec3f(1.0f, 2.0f, 0.5f));
        const Lighting lighting = projectLatLong(image, 10);
        const Vec3d mean = Vec3d(1.0, 2.0, 0.5) * (2.0 * std::sqrt(kPi));
        EXPECT_LT((lighting.coefficients[0] - mean).length(), kRounding) << width;
        for (std::size_t i = 1; i < lighting.coefficients.size(); ++i)
            EXPECT_LT(lighting.coefficients[i].length(), kRounding) << width << ", " << i;
    }
}

TEST(ProjectLatLong, TheSunOutshinesAFineSkyExactly) {
    // One texel of 1e5 among half a million of 1: nothing of the sky may drown in the sum.
    constexpr double kRounding = 1e-12;
    Image image(1024, 512, Vec3f(1.0f));
    const Lighting sky = projectLatLong(image, 5);
    image.at(700, 100) = Vec3f(1e5f);
    const Lighting sunny = projectLatLong(image, 5);
    Image sunImage(1024, 512, Vec3f(0.0f));
    sunImage.at(700, 100) = Vec3f(1e5f - 1.0f);
    const Lighting sun = projectLatLong(sunImage, 5);
    EXPECT_LT(relativeDifference(add(sky, sun), sunny), kRounding);

    const double theta = kPi * 100.5 / 512, phi = 2 * kPi * (700.5 / 1024 - 0.5);
    const double solidAngle =
        2 * kPi / 1024 * (std::cos(kPi * 100 / 512) - std::cos(kPi * 101 / 512));
    std::vector<double> values(25);
    evaluateSh(
        Vec3d(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)), 5,
        values);
    // A texel of 1/163 rad is a point but for its second moments.
    constexpr double kTexelSize = 1e-4;
    for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_NEAR(sun.coefficients[i].x / (solidAngle * (1e5f - 1.0f)), values[i], kTexelSize);
    }
}

TEST(ProjectLatLong, IntegratesShortWavesOverOneRowOfAnyHeight) {
    constexpr double kRounding = 1e-12;
    for (const int height : {1, 2, 3}) {
        const Image image = makeSunnyImage(8, height);
        EXPECT_LT(relativeDifference(projectLatLong(image, 24), integrateTexels(image, 24, 64)),
                  kRounding);
    }
}

}  // namespace
}  // namespace prt
