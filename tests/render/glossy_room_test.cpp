#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "prt/render/path_tracer.h"
#include "tests/render/glossy_points.h"
#include "tests/render/same_means.h"
#include "tests/support/scenes.h"

namespace prt {
namespace {

using test::assembleScene;
using test::expectSameMeans;
using test::glossyOptions;
using test::lookAtVertices;
using test::makeGgx;
using test::makeQuad;
using test::makeRoomScene;

constexpr double kSigmas = 4.0;

class GlossyRoom : public testing::Test {
  protected:
    RadianceEstimate estimate(const DistantLight& light, PathTracerOptions options,
                              std::uint64_t seed) const {
        options.seed = seed;
        return estimateExitRadiance(scene, rays, light, points, 1000, options);
    }

    Scene scene = makeRoomScene();
    RayScene rays{scene};
    std::vector<Brdf> brdfs = {
        makeGltfBrdf(Vec3f(0.8f, 0.6f, 0.4f), {.roughness = 0.4f}),
        makeGgx(0.5),
        {.lobes = {LambertLobe{Vec3d(0.4, 0.3, 0.2)},
                   PhongLobe{.albedo = Vec3d(0.5), .exponent = 8.0}}},
        makeGltfBrdf(Vec3f(0.9f, 0.7f, 0.3f), {.metallic = 0.8f, .roughness = 0.6f})};
    std::vector<ExitPoint> points = lookAtVertices(scene, rays, brdfs);
    Vec3d toSun = Vec3d(0.4, -0.6, 0.7).normalized();
};

TEST_F(GlossyRoom, LightSamplingChangesNoMean) {
    PathTracerOptions blind = glossyOptions(brdfs);
    blind.lightSampling = false;
    Environment sky{SphereMap::latLong, Image(32, 16, Vec3f(0.2f, 0.3f, 0.5f))};
    sky.radiance.at(10, 3) = Vec3f(20.0f, 15.0f, 10.0f);
    for (const auto& light : {makeSunLight(toSun, 0.3), makeEnvironmentLight(sky),
                              makeBandLimitedLight(sunLighting(toSun, 0.2, 4))})
        expectSameMeans(estimate(*light, glossyOptions(brdfs), 1), estimate(*light, blind, 2));
}

TEST_F(GlossyRoom, RouletteChangesNoMean) {
    PathTracerOptions options = glossyOptions(brdfs);
    options.walk.bounceCount = 30;
    PathTracerOptions withoutRoulette = options;
    withoutRoulette.walk.roulette = false;
    const auto light = makeSunLight(toSun, 0.3);
    expectSameMeans(estimate(*light, options, 1), estimate(*light, withoutRoulette, 2));
}

TEST_F(GlossyRoom, LambertBrdfsAreTheDiffuseModel) {
    std::vector<Brdf> lambert;
    for (const Material& material : scene.materials) {
        const Vec4f& color = material.baseColorFactor;
        lambert.push_back({.lobes = {LambertLobe{Vec3d(Vec3f(color.x, color.y, color.z))}}});
    }
    const auto light = makeSunLight(toSun, 0.3);
    const std::vector<PathOrigin> origins = placeVertexOrigins(scene, rays);
    const RadianceEstimate diffuse = estimateRadiance(scene, rays, *light, origins, 1000);
    PathTracerOptions options = glossyOptions(lambert);
    options.seed = 2;
    expectSameMeans(diffuse, estimateRadiance(scene, rays, *light, origins, 1000, options));

    // Seen, with the albedo of the receiver.
    RadianceEstimate seen = diffuse;
    std::size_t vertex = 0;
    for (const Mesh& mesh : scene.meshes)
        for (std::size_t i = 0; i < mesh.vertexCount(); ++i, ++vertex) {
            const Vec3d albedo = std::get<LambertLobe>(lambert[mesh.material].lobes[0]).albedo;
            seen.mean[vertex] *= albedo;
            seen.variance[vertex] *= albedo * albedo;
        }
    points = lookAtVertices(scene, rays, lambert);
    expectSameMeans(seen, estimate(*light, glossyOptions(lambert), 3));
    // The diffuse model needs no BRDFs for what is met.
    expectSameMeans(seen, estimate(*light, {}, 4));
}

/// Of diffuse receivers between glossy surfaces.
TEST_F(GlossyRoom, TransferTimesLightIsTheRadianceUnderIt) {
    const Lighting lighting =
        add(uniformLighting(Vec3d(1.0, 0.8, 0.6), 3), sunLighting(Vec3d(0.0, -0.6, 0.8), 0.5, 3));
    const std::vector<PathOrigin> origins = placeVertexOrigins(scene, rays);
    PathTracerOptions options = glossyOptions(brdfs);
    options.walk.bounceCount = 2;
    const RadianceEstimate radiance =
        estimateRadiance(scene, rays, *makeBandLimitedLight(lighting), origins, 1000, options);
    options.seed = 2;
    const TransferEstimate transfer = estimateTransfer(scene, rays, 3, origins, 1000, options);
    double squares = 0.0, noise = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < origins.size(); ++i)
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const int c = static_cast<int>(channel);
            double relit = 0.0;
            for (std::size_t k = 0; k < 9; ++k)
                relit += transfer.mean[(3 * i + channel) * 9 + k] * lighting.coefficients[k][c];
            squares += std::pow(relit - radiance.mean[i][c], 2);
            noise += radiance.variance[i][c];
            sum += relit - radiance.mean[i][c];
        }
    // Both are as noisy as each other, within a factor of a few.
    EXPECT_LT(squares, 10.0 * noise);
    EXPECT_GT(squares, 0.5 * noise);
    // Three channels go together.
    EXPECT_LT(std::abs(sum), kSigmas * std::sqrt(3.0 * squares));
}

TEST_F(GlossyRoom, AnyNumberOfThreadsGivesTheSameBits) {  // C10
    const auto light = makeSunLight(toSun, 0.3);
    PathTracerOptions options = glossyOptions(brdfs);
    options.threadCount = 1;
    const RadianceEstimate one = estimateExitRadiance(scene, rays, *light, points, 50, options);
    options.threadCount = 3;
    const RadianceEstimate three = estimateExitRadiance(scene, rays, *light, points, 50, options);
    EXPECT_EQ(one.mean, three.mean);
    EXPECT_EQ(one.variance, three.variance);
    options.firstStream = 100;
    const RadianceEstimate part =
        estimateExitRadiance(scene, rays, *light, std::span(points).subspan(100, 5), 50, options);
    EXPECT_TRUE(std::equal(part.mean.begin(), part.mean.end(), one.mean.begin() + 100));
}

/// Radiant intensity that a scene sends towards `view` under a sun of no extent, per irradiance:
/// ∫ L(x, ω_o) cos θ dA over what is seen from there, with its variance.
std::pair<double, double> sumTowards(const Scene& scene, const RayScene& rays, const Vec3d& toSun,
                                     const Vec3d& view, PathTracerOptions options) {
    constexpr int kPointsPerTriangle = 2000;
    RandomStream random(options.seed, 1);
    double sum = 0.0, variance = 0.0;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const Mesh& mesh = scene.meshes[m];
        for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
            const auto corner = [&](std::size_t k) {
                return mesh.positions[mesh.indices[3 * t + k]];
            };
            const Vec3f cross = (corner(1) - corner(0)).cross(corner(2) - corner(0));
            const double projected = 0.5 * Vec3d(cross).dot(view);
            if (projected <= 0.0) continue;
            std::vector<ExitPoint> points;
            for (int i = 0; i < kPointsPerTriangle; ++i) {
                float u = random.nextUnitFloat(), v = random.nextUnitFloat();
                if (u + v > 1.0f) u = 1.0f - u, v = 1.0f - v;
                const PathOrigin origin =
                    placePathOrigin(scene, rays, {false, 0.0f, {m, t, u, v}, false});
                RayStream towards(1);
                towards.setRay(0, origin.position, Vec3f(view));
                rays.findOccluded(towards);
                if (towards.tFar[0] < 0.0f) continue;
                points.push_back({origin, makeReflection(options.walk.materialBrdfs[mesh.material],
                                                         origin.normal, Vec3f(view))});
            }
            const RadianceEstimate estimate =
                estimateExitRadiance(scene, rays, *makeSunLight(toSun, 0.0), points, 2, options);
            options.firstStream += kPointsPerTriangle;
            double mean = 0.0, square = 0.0;
            for (const Vec3d& radiance : estimate.mean) {
                mean += radiance.x / kPointsPerTriangle;
                square += radiance.x * radiance.x / kPointsPerTriangle;
            }
            sum += projected * mean;
            variance += projected * projected * (square - mean * mean) / kPointsPerTriangle;
        }
    }
    return {sum, variance};
}

// A19, of a whole scene: exchanging the sun and the eye changes nothing, bounces and all.
TEST(GlossyScene, LightTakesEveryPathBothWays) {
    const Scene scene =
        assembleScene({{makeQuad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0})},
                       {makeQuad({-1, 1, 0}, {1, 1, 0}, {1, 1, 2}, {-1, 1, 2})},
                       {makeQuad({-1, -1, 0}, {-1, 1, 0}, {-1, 1, 2}, {-1, -1, 2})},
                       {makeBox({-0.4f, -0.4f, 0.2f}, {0.4f, 0.4f, 0.8f}, false, 1)}});
    const RayScene rays(scene);
    const std::vector<Brdf> brdfs = {
        makeGltfBrdf(Vec3f(0.8f), {.roughness = 0.5f}), makeGgx(0.4), makeGgx(0.7),
        makeGltfBrdf(Vec3f(0.9f), {.metallic = 0.8f, .roughness = 0.5f})};
    const Vec3d a = Vec3d(0.3, -0.7, 0.6).normalized(), b = Vec3d(0.6, -0.2, 0.9).normalized();
    for (const int bounceCount : {0, 3}) {
        PathTracerOptions options = glossyOptions(brdfs);
        options.walk.bounceCount = bounceCount;
        const auto [there, thereVariance] = sumTowards(scene, rays, a, b, options);
        options.seed = 2;
        const auto [back, backVariance] = sumTowards(scene, rays, b, a, options);
        const double error = std::sqrt(thereVariance + backVariance);
        EXPECT_GT(there, 20.0 * error);
        EXPECT_NEAR(there, back, kSigmas * error);
    }
}

}  // namespace
}  // namespace prt
