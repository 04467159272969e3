#include "prt/light/environment_sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "drawn_environment.h"
#include "prt/image/tone_curve.h"
#include "prt/math/quadrature.h"

namespace prt {
namespace {

using test::draw;
using test::kShapes;
using test::Shape;

constexpr double kPi = std::numbers::pi;

/// Different radiance in every texel, some of it black, one of it bright.
Environment makeEnvironment(const Shape& shape) {
    RandomStream random(41, 0);
    Environment environment = draw(shape, 8, [&](const Vec3d&) {
        const float brightness = random.nextUnitFloat();
        return brightness < 0.3f ? Vec3f(0.0f) : Vec3f(brightness, 0.5f, 1.0f - brightness);
    });
    for (Vec3f& texel : environment.radiance.pixels)
        if (std::isnan(texel.x)) texel = Vec3f(7.0f);  // where the map shows nothing
    environment.radiance.at(environment.radiance.width / 2, environment.radiance.height / 2) *=
        50.0f;
    return environment;
}

// T-32
TEST(EnvironmentSampler, DrawsTexelsAsOftenAsTheirLightIsStrong) {
    constexpr int kSampleCount = 200'000;
    constexpr double kSigmas = 5.0;  // of χ², whose variance is twice its degrees of freedom
    for (const Shape& shape : kShapes) {
        const Environment environment = makeEnvironment(shape);
        const Image& image = environment.radiance;
        std::vector<double> expected;
        double total = 0.0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                expected.push_back(
                    static_cast<double>(luminance(image.at(x, y))) *
                    sphereTexel(shape.map, image.width, image.height, x, y).solidAngle);
                total += expected.back();
            }
        const EnvironmentSampler sampler(environment);
        std::vector<int> histogram(expected.size(), 0);
        RandomStream random(42, 0);
        for (int i = 0; i < kSampleCount; ++i)
            ++histogram[sampler.sample(random).texel];
        double chiSquare = 0.0, freedom = -1.0;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            if (expected[i] == 0.0) {
                EXPECT_EQ(histogram[i], 0);
            }
            const double count = kSampleCount * expected[i] / total;
            if (count < 5.0) continue;
            chiSquare += (histogram[i] - count) * (histogram[i] - count) / count;
            ++freedom;
        }
        EXPECT_GT(freedom, 20.0);
        EXPECT_LT(chiSquare, freedom + kSigmas * std::sqrt(2.0 * freedom))
            << sphereMapName(shape.map);
    }
}

TEST(EnvironmentSampler, FindsTheDensityThatItDrawsWith) {
    constexpr double kFloatRounding = 1e-3;
    for (const Shape& shape : kShapes) {
        const EnvironmentSampler sampler(makeEnvironment(shape));
        RandomStream random(43, 0);
        int otherTexelCount = 0;
        for (int i = 0; i < 10'000; ++i) {
            const EnvironmentPlace place = sampler.sample(random);
            if (place.density == 0.0) continue;  // outside of the disc of an angular map
            const EnvironmentPlace found = sampler.find(Vec3f(place.direction));
            if (found.texel != place.texel) {  // by rounding
                ++otherTexelCount;
                continue;
            }
            EXPECT_NEAR(found.density / place.density, 1.0, kFloatRounding)
                << sphereMapName(shape.map);
        }
        EXPECT_LT(otherTexelCount, 20);
    }
}

TEST(EnvironmentSampler, DensityIntegratesToOne) {
    // A quadrature of jumps; and the corners of texels that the rim of an angular map cuts off.
    constexpr double kJumps = 0.02;
    for (const Shape& shape : kShapes) {
        const EnvironmentSampler sampler(makeEnvironment(shape));
        double sum = 0.0;
        for (const SphereNode& node : sphereQuadrature(500))
            sum += node.weight * sampler.find(Vec3f(node.direction)).density;
        EXPECT_NEAR(sum, 1.0, kJumps) << sphereMapName(shape.map);
    }
}

// Light from a small sun beside a dim sky, on a slanted plane.
TEST(EnvironmentSampler, LowersTheVarianceOfIrradiance) {
    constexpr int kSampleCount = 20'000;
    const Vec3d toSun = Vec3d(0.3, 0.8, 0.2).normalized(), normal(0.0, 1.0, 0.0);
    const Environment sky = draw(
        kShapes[0], 64, [&](const Vec3d& d) { return Vec3f(d.dot(toSun) > 0.99 ? 100.0f : 0.5f); });
    const EnvironmentSampler sampler(sky);
    const auto varianceOf = [&](const auto& drawPlace) {
        RandomStream random(44, 0);
        double mean = 0.0, squares = 0.0;
        for (int i = 0; i < kSampleCount; ++i) {
            const EnvironmentPlace place = drawPlace(random);
            const double value = static_cast<double>(sky.radiance.pixels[place.texel].x) *
                                 std::max(normal.dot(place.direction), 0.0) / place.density;
            mean += value / kSampleCount;
            squares += value * value / kSampleCount;
        }
        return squares - mean * mean;
    };
    const double even = varianceOf([&](RandomStream& random) {
        const double z = 2.0 * random.nextUnitDouble() - 1.0;
        const double phi = 2.0 * kPi * random.nextUnitDouble(), radius = std::sqrt(1.0 - z * z);
        EnvironmentPlace place =
            sampler.find(Vec3f(Vec3d(radius * std::cos(phi), radius * std::sin(phi), z)));
        place.density = 0.25 / kPi;
        return place;
    });
    EXPECT_LT(varianceOf([&](RandomStream& random) { return sampler.sample(random); }),
              0.05 * even);
}

}  // namespace
}  // namespace prt
