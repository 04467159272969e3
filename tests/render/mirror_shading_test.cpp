#include "prt/render/mirror_shading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "prt/base/random.h"
#include "prt/brdf/brdf_matrix.h"
#include "prt/math/transform.h"
#include "prt/render/path_traced_view.h"
#include "prt/scene/framing.h"
#include "tests/brdf/brdf_samples.h"
#include "tests/render/glossy_points.h"
#include "tests/render/shown_sphere.h"

namespace prt {
namespace {

using test::drawSmoothSky;
using test::drawUpward;
using test::glossyOptions;
using test::makeSphereScene;
using test::viewAt;

constexpr Vec3f kUp{0.0f, 0.0f, 1.0f};
/// Small, for a sky without edges.
constexpr MirrorOptions kSmall{.faceSize = 32, .sampleCount = 64};

/// Light from everywhere shows what share of it the specular lobe reflects.
TEST(MirrorShading, UnderWhiteLightItIsTheDirectionalAlbedoOfTheLobe) {
    constexpr float kTableError = 0.01f;
    const MirrorEnvironment white =
        makeMirrorEnvironment({SphereMap::latLong, Image(16, 8, Vec3f(1.0f))}, {}, kSmall);
    const Vec3f baseColor(0.9f, 0.5f, 0.1f);
    for (const float roughness : {0.05f, 0.25f, 0.7f, 1.0f})
        for (const float metallic : {0.0f, 0.4f, 1.0f})
            for (const double degrees : {0.0, 35.0, 60.0, 80.0}) {
                const MetallicRoughness surface{metallic, roughness};
                const Brdf specular{.lobes = {splitGltfMaterial(baseColor, surface).specular}};
                const auto response = projectBrdfView(specular, viewAt(degrees), 1);
                const Vec3f shown =
                    showMirrored(white, kUp, Vec3f(viewAt(degrees)), baseColor, surface);
                for (std::size_t channel = 0; channel < 3; ++channel)
                    EXPECT_NEAR(shown[static_cast<int>(channel)],
                                response[channel][0] * std::sqrt(4.0 * std::numbers::pi),
                                kTableError)
                        << roughness << " " << metallic << " " << degrees;
            }
}

TEST(MirrorShading, TurningAllTurnsNothing) {
    constexpr float kTolerance = 2e-5f;
    const Environment sky = drawSmoothSky();
    const Mat3d rotation = rotationX(0.7) * rotationY(-2.0) * rotationZ(0.4);
    const MirrorEnvironment still = makeMirrorEnvironment(sky, {}, kSmall);
    const MirrorEnvironment turned = makeMirrorEnvironment(sky, rotation, kSmall);
    RandomStream random(3, 0);
    for (int i = 0; i < 100; ++i) {
        const Vec3f normal(drawUpward(random));
        const Vec3f view(frameFromNormal(Vec3d(normal)).worldFromLocal(drawUpward(random)));
        const MetallicRoughness surface{1.0f, random.nextUnitFloat()};
        const Vec3f here = showMirrored(still, normal, view, Vec3f(0.8f), surface);
        const Vec3f there = showMirrored(turned, Vec3f(rotation * Vec3d(normal)),
                                         Vec3f(rotation * Vec3d(view)), Vec3f(0.8f), surface);
        EXPECT_TRUE(here.equalWithAbsError(there, kTolerance)) << here << there;
    }
}

TEST(MirrorShading, AViewBelowALeaningHorizonCountsAsAtIt) {
    const MirrorEnvironment sky = makeMirrorEnvironment(drawSmoothSky(), {}, kSmall);
    const MetallicRoughness surface{1.0f, 0.2f};
    const auto shown = [&](double degrees) {
        return showMirrored(sky, kUp, Vec3f(viewAt(degrees)), Vec3f(1.0f), surface);
    };
    EXPECT_GT(shown(90.0).x, 0.0f);
    EXPECT_TRUE(shown(100.0).equalWithAbsError(shown(90.0), 1e-3f));
}

/// How far a picture of nothing but mirrored light is from path tracing, relative.
double measureErrorOfSphere(float roughness) {
    const Scene scene = makeSphereScene(
        {.baseColor = Vec3f(0.9f, 0.6f, 0.3f), .metallic = 1.0f, .roughness = roughness});
    const RayScene rays(scene);
    const Camera camera = lookAt({0.3f, 0.8f, 3.5f}, Vec3f(0.0f), 0.6f);
    const Environment sky = drawSmoothSky();
    const Mat3d rotation = rotationY(1.0);
    const MirrorEnvironment mirrors =
        makeMirrorEnvironment(sky, rotation, {.mostRoughness = 0.3, .sampleCount = 256});
    const RenderOptions view{.width = 48, .height = 48, .mirrors = &mirrors};
    const std::vector<ExitRadiance> exit(scene.vertexCount(), {Vec3f(0.0f), Vec3f(0.0f), 1.0f});
    const Image shown = renderView(scene, rays, exit, camera, view);
    const Image truth = pathTraceView(scene, rays, *makeEnvironmentLight(sky, rotation), camera,
                                      view, 16, glossyOptions())
                            .radiance;
    double squares = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
        squares += static_cast<double>((shown.pixels[i] - truth.pixels[i]).length2());
        sum += static_cast<double>(truth.pixels[i].length2());
    }
    return std::sqrt(squares / sum);
}

/// The sphere's rim is where triangles differ from their normals.
TEST(MirrorShading, ASmoothMetalSphereMirrorsWhatAPathTracerSees) {
    EXPECT_LT(measureErrorOfSphere(0.0f), 0.01);
}

/// The lobe about r is round, and that of a rough surface is not. A good half of the bound is noise
/// of the paths.
TEST(MirrorShading, ARoughMetalSphereShowsNearlyWhatAPathTracerSees) {
    EXPECT_LT(measureErrorOfSphere(0.25f), 0.04);
}

TEST(MirrorShading, WithoutVisibilityOrWithoutAnEnvironmentNothingIsMirrored) {
    const Scene scene = makeSphereScene({.metallic = 1.0f, .roughness = 0.0f});
    const RayScene rays(scene);
    const Camera camera = lookAt({0.0f, 0.0f, 3.0f}, Vec3f(0.0f), 0.1f);
    const MirrorEnvironment mirrors = makeMirrorEnvironment(drawSmoothSky(), {}, kSmall);
    const auto centre = [&](float visibility, const MirrorEnvironment* environment) {
        const std::vector<ExitRadiance> exit(scene.vertexCount(),
                                             {Vec3f(0.0f), Vec3f(0.25f), visibility});
        const RenderOptions view{.width = 1, .height = 1, .mirrors = environment};
        return renderView(scene, rays, exit, camera, view).at(0, 0);
    };
    const Vec3f all = centre(1.0f, &mirrors) - Vec3f(0.25f);
    EXPECT_GT(all.x, 0.1f);
    EXPECT_TRUE((centre(0.5f, &mirrors) - Vec3f(0.25f)).equalWithAbsError(all * 0.5f, 1e-6f));
    EXPECT_EQ(centre(0.0f, &mirrors), Vec3f(0.25f));
    EXPECT_EQ(centre(1.0f, nullptr), Vec3f(0.25f));
}

}  // namespace
}  // namespace prt
