#include "prt/render/path_tracer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "prt/base/error.h"
#include "prt/basis/zonal.h"
#include "prt/light/analytic_lights.h"
#include "prt/scene/procedural.h"
#include "prt/trace/ray_offset.h"
#include "tests/render/same_means.h"
#include "tests/support/scenes.h"

namespace prt {
namespace {

using test::assembleScene;
using test::expectSameMeans;
using test::makePatch;
using test::makeQuad;
using test::makeRoomScene;

constexpr double kPi = std::numbers::pi;
constexpr double kSigmas = 4.0;
constexpr Vec3f kUp(0.0f, 0.0f, 1.0f);

/// Radiance 1 from everywhere.
std::unique_ptr<DistantLight> makeWhiteSky() {
    return makeBandLimitedLight(uniformLighting(Vec3d(1.0), 1));
}

/// Off a surface at `point` whose shading and geometric normal is `normal`.
PathOrigin makeOrigin(const RayScene& rays, const Vec3f& point, const Vec3f& normal) {
    return {offsetRayOrigin(rays.tracePoint(point), normal), normal};
}

struct Measured {
    double mean = 0.0;
    double standardError = 0.0;
};

Measured measureAt(const Scene& scene, const Vec3f& point, const DistantLight& light,
                   int sampleCount, const PathTracerOptions& options = {}) {
    const RayScene rays(scene);
    const PathOrigin origin = makeOrigin(rays, point, kUp);
    const RadianceEstimate estimate =
        estimateRadiance(scene, rays, light, {&origin, 1}, sampleCount, options);
    return {estimate.mean[0].x, std::sqrt(estimate.variance[0].x)};
}

void expectNear(const Measured& measured, double expected, double modelError = 1e-6) {
    EXPECT_NEAR(measured.mean, expected, kSigmas * measured.standardError + modelError);
}

PathTracerOptions bounces(int count) {
    PathTracerOptions options;
    options.walk.bounceCount = count;
    return options;
}

TEST(PathTracer, AnOpenPlaneReflectsTheCosineOfTheSun) {
    const Scene scene = assembleScene({{makePatch(Vec3f(0.0f), kUp, 1.0f)}});
    for (const double halfAngle : {0.0, 0.01, 0.3}) {
        for (const double elevation : {0.4, 1.2}) {  // the disc never sets
            const Vec3d direction(std::cos(elevation), 0.0, std::sin(elevation));
            expectNear(measureAt(scene, Vec3f(0.0f), *makeSunLight(direction, halfAngle), 20'000),
                       std::sin(elevation) / kPi);
        }
    }
    expectNear(measureAt(scene, Vec3f(0.0f), *makeWhiteSky(), 10'000), 1.0);
}

TEST(PathTracer, NegativeLobesOfBandLimitedLightAreKept) {
    const Scene scene = assembleScene({{makePatch(Vec3f(0.0f), kUp, 1.0f)}});
    std::vector<float> transfer(25);
    unshadowedTransfer(kUp, 5, transfer);
    int negativeCount = 0;
    for (const double theta : {0.2, 1.0, 1.9, 2.2, 3.0}) {
        const Lighting lighting = sunLighting(Vec3d(std::sin(theta), 0.0, std::cos(theta)), 0.0, 5);
        double expected = 0.0;
        for (std::size_t i = 0; i < 25; ++i)
            expected += static_cast<double>(transfer[i]) * lighting.coefficients[i].x;
        if (expected < 0.0) ++negativeCount;
        expectNear(measureAt(scene, Vec3f(0.0f), *makeBandLimitedLight(lighting), 40'000),
                   expected);
    }
    EXPECT_GT(negativeCount, 0);
}

Scene makeWallScene(float height) {
    const float halfLength = 100.0f * height;
    return assembleScene({{makeQuad({0, -halfLength, 0}, {0, halfLength, 0},
                                    {0, halfLength, height}, {0, -halfLength, height})}});
}

TEST(PathTracer, SkyViewBesideALongWall) {  // A8
    const auto skyView = [](float distance, float height) {
        return measureAt(makeWallScene(height), {distance, 0.0f, 0.0f}, *makeWhiteSky(), 100'000,
                         bounces(0));
    };
    constexpr double kWallEnds = 1e-4;
    expectNear(skyView(1, 1), .853553, kWallEnds);
    expectNear(skyView(1, 3), .658114, kWallEnds);
    expectNear(skyView(3, 1), .974342, kWallEnds);
}

TEST(PathTracer, BackFacesBlockAndReflectNothing) {  // C11
    // The wall faces +x: a point behind it sees its back.
    Scene scene = makeWallScene(1.0f);
    expectNear(measureAt(scene, {-1, 0, 0}, *makeWhiteSky(), 50'000), .853553, 1e-4);
    // Seen from its front, or with two sides, it adds what it reflects.
    const Measured front = measureAt(scene, {1, 0, 0}, *makeWhiteSky(), 50'000);
    EXPECT_GT(front.mean, .853553 + 0.02);
    scene.materials[0].doubleSided = true;
    const Measured back = measureAt(scene, {-1, 0, 0}, *makeWhiteSky(), 50'000);
    EXPECT_NEAR(back.mean, front.mean,
                kSigmas * std::hypot(back.standardError, front.standardError));
}

TEST(PathTracer, TransferBelowASphere) {  // A6
    const Scene scene = assembleScene({{makeSphere({0, 0, 2}, 1.0f, 128), Vec3f(0.0f)}});
    const RayScene rays(scene);
    const PathOrigin origin = makeOrigin(rays, Vec3f(0.0f), kUp);
    const TransferEstimate transfer = estimateTransfer(scene, rays, 5, {&origin, 1}, 100'000);
    constexpr std::array<double, 5> kZonal = {.21157109, .21157109, .02956796, -.12119257,
                                              -.13388483};
    constexpr double kSphereFacets = 1e-3;
    ASSERT_EQ(transfer.mean.size(), 75u);
    for (std::size_t channel = 0; channel < 3; ++channel)
        for (int l = 0; l < 5; ++l)
            for (int m = -l; m <= l; ++m) {
                const std::size_t i = 25 * channel + static_cast<std::size_t>(shIndex(l, m));
                EXPECT_NEAR(transfer.mean[i], m == 0 ? kZonal[static_cast<std::size_t>(l)] : 0.0,
                            kSigmas * std::sqrt(transfer.variance[i]) + kSphereFacets)
                    << "l " << l << ", m " << m;
            }
}

/// B of the bowl, as a mean over its vertices.
Measured measureBowl(float albedo, const PathTracerOptions& options) {
    const Scene scene = assembleScene({{makeBowl(0.0f, 160), Vec3f(albedo)}});
    const RayScene rays(scene);
    const RadianceEstimate estimate =
        estimateRadiance(scene, rays, *makeWhiteSky(), placeVertexOrigins(scene, rays), 8, options);
    const auto count = static_cast<double>(estimate.mean.size());
    Measured measured;
    for (std::size_t i = 0; i < estimate.mean.size(); ++i) {
        measured.mean += estimate.mean[i].x / count;
        measured.standardError += estimate.variance[i].x / (count * count);
    }
    measured.standardError = std::sqrt(measured.standardError);
    return measured;
}

constexpr double kBowlFacets = 2e-3;

TEST(PathTracer, ABowlUnderAWhiteSkyIsEvenlyBright) {  // A13
    for (const double albedo : {0.5, 0.8}) {
        constexpr double kShare = 0.5;
        double expected = 0.0;
        for (int b = 0; b <= 3; ++b) {
            expected += (1.0 - kShare) * std::pow(albedo * kShare, b);
            expectNear(measureBowl(static_cast<float>(albedo), bounces(b)), expected, kBowlFacets);
        }
        expectNear(measureBowl(static_cast<float>(albedo), {}),
                   (1.0 - kShare) / (1.0 - albedo * kShare), kBowlFacets);
    }
}

TEST(PathTracer, AWhiteFurnaceIsWhite) {
    expectNear(measureBowl(1.0f, {}), 1.0, kBowlFacets);
    const Scene room = assembleScene(
        {{makeQuad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}), Vec3f(1.0f)},
         {makeBox({-0.5f, -0.5f, 0.2f}, {0.5f, 0.5f, 0.9f}, false, 2), Vec3f(1.0f)},
         {makeQuad({-1, 1, 0}, {1, 1, 0}, {1, 1, 2}, {-1, 1, 2}), Vec3f(1.0f), true}});
    for (const Vec3f& point : {Vec3f(0.0f), Vec3f(0.3f, 0.9f, 0.0f), Vec3f(0.0f, 0.0f, 0.9f)})
        expectNear(measureAt(room, point, *makeWhiteSky(), 50'000), 1.0);
}

TEST(PathTracer, NoLightEntersAClosedBox) {
    const Scene box = assembleScene({{makeBox(Vec3f(-1.0f), Vec3f(1.0f), true, 3), Vec3f(0.9f)}});
    const RayScene rays(box);
    const std::vector<PathOrigin> origins = placeVertexOrigins(box, rays);
    for (const auto& light : {makeWhiteSky(), makeSunLight(Vec3d(0.6, 0.0, 0.8), 0.0)}) {
        const RadianceEstimate estimate = estimateRadiance(box, rays, *light, origins, 64);
        for (const Vec3d& radiance : estimate.mean)
            EXPECT_EQ(radiance, Vec3d(0.0));
    }
}

class PathTracerStrategies : public testing::Test {
  protected:
    RadianceEstimate estimate(const DistantLight& light, PathTracerOptions options,
                              std::uint64_t seed) const {
        options.seed = seed;
        return estimateRadiance(scene, rays, light, origins, 1000, options);
    }

    Scene scene = makeRoomScene();
    RayScene rays{scene};
    std::vector<PathOrigin> origins = placeVertexOrigins(scene, rays);
};

TEST_F(PathTracerStrategies, LightSamplingChangesNoMean) {
    PathTracerOptions blind;
    blind.lightSampling = false;
    Environment sky{SphereMap::latLong, Image(32, 16, Vec3f(0.2f, 0.3f, 0.5f))};
    sky.radiance.at(10, 3) = Vec3f(20.0f, 15.0f, 10.0f);
    const Vec3d direction = Vec3d(0.4, -0.6, 0.7).normalized();
    for (const auto& light : {makeSunLight(direction, 0.3), makeEnvironmentLight(sky),
                              makeBandLimitedLight(sunLighting(direction, 0.2, 4))})
        expectSameMeans(estimate(*light, {}, 1), estimate(*light, blind, 2));
}

TEST_F(PathTracerStrategies, RouletteChangesNoMean) {
    PathTracerOptions withoutRoulette = bounces(30);
    withoutRoulette.walk.roulette = false;
    const auto light = makeSunLight(Vec3d(0.4, -0.6, 0.7).normalized(), 0.3);
    expectSameMeans(estimate(*light, bounces(30), 1), estimate(*light, withoutRoulette, 2));
}

TEST_F(PathTracerStrategies, TransferTimesLightIsTheRadianceUnderIt) {
    const Lighting lighting =
        add(uniformLighting(Vec3d(1.0, 0.8, 0.6), 3), sunLighting(Vec3d(0.0, -0.6, 0.8), 0.5, 3));
    const RadianceEstimate radiance = estimate(*makeBandLimitedLight(lighting), bounces(2), 1);
    PathTracerOptions options = bounces(2);
    options.seed = 2;
    const TransferEstimate transfer = estimateTransfer(scene, rays, 3, origins, 1000, options);
    double squares = 0.0, noise = 0.0;
    for (std::size_t i = 0; i < origins.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            double relit = 0.0;
            for (std::size_t k = 0; k < 9; ++k)
                relit += transfer.mean[(3 * i + static_cast<std::size_t>(channel)) * 9 + k] *
                         lighting.coefficients[k][channel];
            squares += std::pow(relit - radiance.mean[i][channel], 2);
            noise += radiance.variance[i][channel];
        }
    }
    // Both are as noisy as each other, within a factor of a few.
    EXPECT_LT(squares, 10.0 * noise);
    EXPECT_GT(squares, 0.5 * noise);
}

TEST_F(PathTracerStrategies, TheReportedVarianceIsThatOfRepeatedRuns) {
    const auto light = makeSunLight(Vec3d(0.4, -0.6, 0.7).normalized(), 0.3);
    const std::vector<PathOrigin> sameEverywhere(4000, makeOrigin(rays, {0.7f, 0.4f, 0}, kUp));
    const RadianceEstimate repeated = estimateRadiance(scene, rays, *light, sameEverywhere, 16);
    double sum = 0.0, squareSum = 0.0, reported = 0.0;
    for (std::size_t i = 0; i < sameEverywhere.size(); ++i) {
        sum += repeated.mean[i].x / 4000.0;
        squareSum += std::pow(repeated.mean[i].x, 2) / 4000.0;
        reported += repeated.variance[i].x / 4000.0;
    }
    EXPECT_GT(reported, 0.0);
    EXPECT_NEAR((squareSum - sum * sum) / reported, 1.0, 0.1);
}

TEST_F(PathTracerStrategies, AnyNumberOfThreadsGivesTheSameBits) {  // C10
    const auto light = makeEnvironmentLight({SphereMap::latLong, Image(8, 4, Vec3f(1.0f))});
    PathTracerOptions options;
    options.threadCount = 1;
    const RadianceEstimate one = estimateRadiance(scene, rays, *light, origins, 50, options);
    const TransferEstimate oneTransfer = estimateTransfer(scene, rays, 2, origins, 50, options);
    options.threadCount = 3;
    const RadianceEstimate three = estimateRadiance(scene, rays, *light, origins, 50, options);
    EXPECT_EQ(one.mean, three.mean);
    EXPECT_EQ(one.variance, three.variance);
    EXPECT_EQ(oneTransfer.mean, estimateTransfer(scene, rays, 2, origins, 50, options).mean);
    options.seed = 2;
    EXPECT_NE(one.mean, estimateRadiance(scene, rays, *light, origins, 50, options).mean);

    // The parts of a whole are the whole.
    options.seed = 1;
    options.firstStream = 10;
    const RadianceEstimate part =
        estimateRadiance(scene, rays, *light, std::span(origins).subspan(10, 5), 50, options);
    EXPECT_TRUE(std::equal(part.mean.begin(), part.mean.end(), one.mean.begin() + 10));
}

/// Below a square that hides half of the sky: what it sends down is what its corners see.
TEST(PathTracer, PathsMayGoOnFromCornersOfTheTriangle) {
    constexpr float kAlbedo = 0.6f;
    const Scene scene =
        assembleScene({{makeQuad({-9, -9, 1}, {-9, 9, 1}, {9, 9, 1}, {9, -9, 1}), Vec3f(kAlbedo)}});
    const RayScene rays(scene);
    // Its four corners look up from elsewhere; the first two alone see all of the sky.
    const PathOrigin open = makeOrigin(rays, {0, 0, 2}, kUp);
    const PathOrigin closed = makeOrigin(rays, {0, 0, 2}, -kUp);
    const std::vector<PathOrigin> corners = {open, open, closed, closed};
    PathTracerOptions options = bounces(1);
    options.walk.vertexFronts = corners;
    const Vec3f point(0.0f);
    const double seen = measureAt(scene, point, *makeWhiteSky(), 400'000, bounces(0)).mean;
    EXPECT_LT(seen, 0.05);
    // By symmetry half of the paths go on from a corner that sees the sky.
    expectNear(measureAt(scene, point, *makeWhiteSky(), 400'000, options),
               seen + 0.5 * static_cast<double>(kAlbedo) * (1.0 - seen), 2e-3);
}

TEST(PathTracer, RefusesOptionsOutOfRange) {
    const Scene scene = assembleScene({{makePatch(Vec3f(0.0f), kUp, 1.0f)}});
    const auto expectRefused = [&](int sampleCount, const PathTracerOptions& options) {
        try {
            measureAt(scene, Vec3f(0.0f), *makeWhiteSky(), sampleCount, options);
            ADD_FAILURE() << "no error";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::invalidOption);
        }
    };
    expectRefused(1, {});
    expectRefused(-1, {});
    expectRefused(16, bounces(-2));
    PathTracerOptions endless;
    endless.walk.roulette = false;
    expectRefused(16, endless);
}

TEST(PathTracer, CanBeCancelled) {
    const Scene scene = assembleScene({{makePatch(Vec3f(0.0f), kUp, 1.0f)}});
    PathTracerOptions options;
    options.progress = [](const Progress&) { return false; };
    try {
        measureAt(scene, Vec3f(0.0f), *makeWhiteSky(), 16, options);
        FAIL() << "not cancelled";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cancelled);
    }
}

}  // namespace
}  // namespace prt
