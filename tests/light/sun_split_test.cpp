#include "prt/light/sun_split.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "drawn_environment.h"
#include "prt/base/random.h"
#include "prt/light/analytic_lights.h"

namespace prt {
namespace {

using test::draw;
using test::integrate;
using test::kShapes;
using test::maxDifference;
using test::Shape;

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;

/// Texels of about one degree.
int cellSizeOf(const Shape& shape) {
    if (shape.map == SphereMap::latLong) return 160;
    return shape.columnCount * shape.rowCount == 1 ? 240 : 80;
}

Vec3f skyAt(const Vec3d& direction) {
    return Vec3f(0.2f, 0.3f, 0.6f) * static_cast<float>(1.0 + 0.5 * direction.y);
}

/// Adds a disc, texels at its edge by the part that it covers.
void addDisc(Environment& environment, const DiscLight& disc) {
    constexpr int kFine = 8;
    Image& image = environment.radiance;
    const double reach = disc.halfAngleRadians + 3.0 * kDegree;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const SphereTexel texel = sphereTexel(environment.map, image.width, image.height, x, y);
            if (texel.solidAngle == 0.0 || texel.direction.dot(disc.direction) < std::cos(reach))
                continue;
            double covered = 0.0, whole = 0.0;
            for (int i = 0; i < kFine * kFine; ++i) {
                const SpherePlace place =
                    spherePlace(environment.map, image.width, image.height,
                                x + (i % kFine + 0.5) / kFine, y + (i / kFine + 0.5) / kFine);
                whole += place.solidAngleDensity;
                if (place.direction.dot(disc.direction) >= std::cos(disc.halfAngleRadians))
                    covered += place.solidAngleDensity;
            }
            image.at(x, y) += Vec3f(disc.radiance * (covered / whole));
        }
}

double angleBetween(const Vec3d& a, const Vec3d& b) {
    return std::atan2(a.cross(b).length(), a.dot(b));
}

double solidAngleOf(const DiscLight& disc) {
    return 2.0 * kPi * (1.0 - std::cos(disc.halfAngleRadians));
}

void expectFluxKept(const Environment& environment, const SunSplit& split) {
    constexpr double kRounding = 1e-6;
    const Vec3d whole = integrate(environment);
    const Vec3d parts = integrate(split.rest) + split.sun->radiance * solidAngleOf(*split.sun);
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(parts[channel] / whole[channel], 1.0, kRounding);
}

// Straight up and down, at the seam of a lat-long map, on the rim of an angular map, on the edge
// and at the corner of a cube, on the cut of an octahedron, and nowhere special.
const Vec3d kPlaces[] = {{0, 1, 0}, {0, -1, 0}, {-1, 0.1, 0.01}, {0, 0, 1},
                         {1, 1, 0}, {1, 1, 1},  {0, -1, 0.5},    {0.3, 0.5, -0.7}};

TEST(SplitSun, FindsADiscWhereverItStands) {
    constexpr double kQuarterTexel = 0.25 * kDegree;
    constexpr double kRelativeSize = 0.035;  // a seventh of a texel
    for (const Shape& shape : kShapes) {
        const Environment sky = draw(shape, cellSizeOf(shape), skyAt);
        for (const Vec3d& place : kPlaces) {
            const DiscLight truth{place.normalized(), 4.0 * kDegree, Vec3d(300.0, 200.0, 100.0)};
            Environment environment = sky;
            addDisc(environment, truth);
            const SunSplit split = splitSun(environment);
            ASSERT_TRUE(split.sun) << sphereMapName(shape.map) << " " << place;
            EXPECT_LT(angleBetween(split.sun->direction, truth.direction), kQuarterTexel)
                << sphereMapName(shape.map) << " " << place;
            EXPECT_NEAR(split.sun->halfAngleRadians / truth.halfAngleRadians, 1.0, kRelativeSize)
                << sphereMapName(shape.map) << " " << place;
            for (int channel = 0; channel < 3; ++channel)
                EXPECT_NEAR(split.sun->radiance[channel] / truth.radiance[channel], 1.0,
                            2.0 * kRelativeSize)
                    << sphereMapName(shape.map) << " " << place;
            expectFluxKept(environment, split);
            // The hole is filled with a sky like the one around.
            double worst = 0.0;
            for (std::size_t i = 0; i < sky.radiance.pixels.size(); ++i)
                if (!std::isnan(sky.radiance.pixels[i].x))
                    worst = std::max(
                        worst,
                        static_cast<double>(
                            (split.rest.radiance.pixels[i] - sky.radiance.pixels[i]).length()));
            EXPECT_LT(worst, 0.1) << sphereMapName(shape.map) << " " << place;
        }
    }
}

TEST(SplitSun, PartsLightAsTheWhole) {
    constexpr double kMovedLight = 5e-4;  // of a sun of 1.5, from texels into a round disc
    for (const Shape& shape : kShapes) {
        Environment environment = draw(shape, cellSizeOf(shape), skyAt);
        addDisc(environment, {Vec3d(0.3, 0.5, -0.7).normalized(), 4.0 * kDegree, Vec3d(100.0)});
        const SunSplit split = splitSun(environment);
        const Lighting whole = projectLighting(environment, 4);
        const Lighting parts = add(projectLighting(split.rest, 4),
                                   discLighting(split.sun->direction, split.sun->halfAngleRadians,
                                                split.sun->radiance, 4));
        EXPECT_LT((whole.coefficients[0] - parts.coefficients[0]).length(), 1e-5);
        EXPECT_LT(maxDifference(whole, parts), kMovedLight) << sphereMapName(shape.map);
    }
}

TEST(SplitSun, ASunOfOneTexelIsFound) {
    Environment environment = draw(kShapes[0], 64, skyAt);
    environment.radiance.at(127, 20) = Vec3f(1e5f);
    const SunSplit split = splitSun(environment);
    const SphereTexel texel = sphereTexel(SphereMap::latLong, 128, 64, 127, 20);
    ASSERT_TRUE(split.sun);
    EXPECT_LT(angleBetween(split.sun->direction, texel.direction), 1e-3);
    EXPECT_NEAR(solidAngleOf(*split.sun) / texel.solidAngle, 1.0, 1e-3);
    expectFluxKept(environment, split);
}

TEST(SplitSun, OfTwoSunsTheBrighterIsTaken) {
    for (const Shape& shape : kShapes) {
        Environment environment = draw(shape, cellSizeOf(shape), skyAt);
        const Vec3d first = Vec3d(1.0, 0.4, 0.2).normalized();
        const Vec3d second = Vec3d(0.9, 0.7, 0.2).normalized();  // 14° away
        addDisc(environment, {first, 3.0 * kDegree, Vec3d(200.0)});
        addDisc(environment, {second, 3.0 * kDegree, Vec3d(150.0)});
        const SunSplit split = splitSun(environment);
        ASSERT_TRUE(split.sun);
        EXPECT_LT(angleBetween(split.sun->direction, first), 0.25 * kDegree);
        const SunSplit rest = splitSun(split.rest);
        ASSERT_TRUE(rest.sun);
        EXPECT_LT(angleBetween(rest.sun->direction, second), 0.25 * kDegree);
        EXPECT_FALSE(splitSun(rest.rest).sun);
    }
}

TEST(SplitSun, SkiesWithoutASunAreLeftAlone) {
    RandomStream random(51, 0);
    for (const Shape& shape : kShapes) {
        const Environment skies[] = {
            draw(shape, 32, [](const Vec3d&) { return Vec3f(0.0f); }),
            draw(shape, 32, [](const Vec3d&) { return Vec3f(2.0f); }),
            draw(shape, 32, skyAt),
            // The overcast sky of the CIE.
            draw(shape, 32,
                 [](const Vec3d& d) {
                     return Vec3f(static_cast<float>(d.y > 0.0 ? (1.0 + 2.0 * d.y) / 3.0 : 0.1));
                 }),
            draw(shape, 32, [&](const Vec3d&) { return Vec3f(0.5f + random.nextUnitFloat()); }),
        };
        for (const Environment& sky : skies) {
            const SunSplit split = splitSun(sky);
            EXPECT_FALSE(split.sun) << sphereMapName(shape.map);
            for (std::size_t i = 0; i < sky.radiance.pixels.size(); ++i)
                EXPECT_TRUE(std::isnan(sky.radiance.pixels[i].x) ||
                            split.rest.radiance.pixels[i] == sky.radiance.pixels[i]);
        }
    }
}

TEST(SplitSun, ALightLargerThanAskedForIsNoSun) {
    Environment environment = draw(kShapes[2], 40, skyAt);
    addDisc(environment, {Vec3d(0.6, 0.8, 0.0), 20.0 * kDegree, Vec3d(30.0)});
    EXPECT_FALSE(splitSun(environment).sun);
    const SunSplit split = splitSun(environment, {.maxHalfAngleRadians = 25.0 * kDegree});
    ASSERT_TRUE(split.sun);
    EXPECT_NEAR(split.sun->halfAngleRadians, 20.0 * kDegree, 0.5 * kDegree);
}

TEST(ExtractDominantLight, FindsASunInUniformLight) {
    constexpr double kFloatRounding = 1e-6;
    const Vec3d direction = Vec3d(0.3, -0.5, 0.8).normalized();
    for (const int bandCount : {2, 3, 5}) {
        const Lighting sun = sunLighting(direction, 0.0, bandCount);
        Lighting lighting = uniformLighting(Vec3d(0.2, 0.3, 0.4), bandCount);
        for (std::size_t i = 0; i < lighting.coefficients.size(); ++i)
            lighting.coefficients[i] += Vec3d(3.0, 2.0, 1.0) * sun.coefficients[i].x;
        const std::optional<DominantLight> light = extractDominantLight(lighting);
        ASSERT_TRUE(light);
        EXPECT_NEAR(angleBetween(light->direction, direction), 0.0, kFloatRounding);
        EXPECT_NEAR((light->irradiance - Vec3d(3.0, 2.0, 1.0)).length(), 0.0, kFloatRounding);
        EXPECT_LT(maxDifference(light->rest, uniformLighting(Vec3d(0.2, 0.3, 0.4), bandCount)),
                  10.0 * kFloatRounding);
    }
}

TEST(ExtractDominantLight, FitsBetterThanAnyOtherIrradiance) {
    Lighting lighting(4);
    RandomStream random(52, 0);
    for (Vec3d& coefficient : lighting.coefficients)
        for (int channel = 0; channel < 3; ++channel)
            coefficient[channel] = random.nextUnitDouble() - 0.5;
    lighting.coefficients[0] = Vec3d(20.0);
    // Light from +x, +y and +z in every channel.
    lighting.coefficients[1] = lighting.coefficients[3] = Vec3d(-1.0);
    lighting.coefficients[2] = Vec3d(1.0);
    const std::optional<DominantLight> light = extractDominantLight(lighting);
    ASSERT_TRUE(light);
    EXPECT_NEAR(angleBetween(light->direction, Vec3d(1.0).normalized()), 0.0, 1e-6);
    const Lighting unit = sunLighting(light->direction, 0.0, 4);
    const auto errorOf = [&](int channel, double irradiance) {
        double error = 0.0;  // an ambient light takes the constant coefficient
        for (std::size_t i = 1; i < 16; ++i) {
            const double difference =
                lighting.coefficients[i][channel] - irradiance * unit.coefficients[i].x;
            error += difference * difference;
        }
        return error;
    };
    for (int channel = 0; channel < 3; ++channel) {
        const double irradiance = light->irradiance[channel];
        EXPECT_GT(irradiance, 0.0);
        EXPECT_LT(errorOf(channel, irradiance), errorOf(channel, 1.01 * irradiance));
        EXPECT_LT(errorOf(channel, irradiance), errorOf(channel, 0.99 * irradiance));
        for (std::size_t i = 0; i < 16; ++i)
            EXPECT_NEAR(light->rest.coefficients[i][channel] + irradiance * unit.coefficients[i].x,
                        lighting.coefficients[i][channel], 1e-12);
    }
}

TEST(ExtractDominantLight, NeverTakesMoreThanThereIs) {
    Lighting lighting = sunLighting(Vec3d(0.0, 1.0, 0.0), 0.0, 3);
    lighting.coefficients[0] *= 0.5;
    const std::optional<DominantLight> light = extractDominantLight(lighting);
    ASSERT_TRUE(light);
    EXPECT_NEAR(light->irradiance.x, 0.5, 1e-12);
    EXPECT_NEAR(light->rest.coefficients[0].x, 0.0, 1e-12);
}

TEST(ExtractDominantLight, LightFromEverywhereHasNone) {
    EXPECT_FALSE(extractDominantLight(uniformLighting(Vec3d(1.0), 5)));
    EXPECT_FALSE(extractDominantLight(uniformLighting(Vec3d(1.0), 1)));
    EXPECT_FALSE(extractDominantLight(Lighting(3)));
}

}  // namespace
}  // namespace prt
