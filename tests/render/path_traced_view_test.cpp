#include "prt/render/path_traced_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "prt/base/error.h"
#include "prt/light/analytic_lights.h"
#include "prt/render/camera_rays.h"
#include "prt/scene/framing.h"
#include "prt/scene/procedural.h"
#include "tests/render/same_means.h"
#include "tests/support/scenes.h"

namespace prt {
namespace {

using test::assembleScene;
using test::makeQuad;

RenderOptions makeView(int width, int height) {
    RenderOptions view;
    view.width = width;
    view.height = height;
    view.samplesPerAxis = 2;
    return view;
}

/// A convex body, seen beside a background: under a sky of radiance 1 every B is 1.
TEST(PathTracedView, LooksAlongTheRaysOfRenderView) {
    Scene scene = assembleScene({{makeSphere(Vec3f(0.0f), 1.0f, 24), Vec3f(0.7f, 0.2f, 0.4f)}});
    scene.materials[0].emissiveFactor = {0.0f, 0.0f, 0.5f};
    const RayScene rays(scene);
    const Camera camera = lookAt({0.0f, 1.0f, 4.0f}, Vec3f(0.0f), 0.7f);
    const Environment sky{SphereMap::latLong, Image(2, 1, Vec3f(1.0f))};
    RenderOptions view = makeView(40, 30);
    view.background = &sky;
    PathTracerOptions options;
    options.lightSampling = false;  // then each path brings home exactly 1
    options.walk.bounceCount = 0;
    const auto light = makeBandLimitedLight(uniformLighting(Vec3d(1.0), 1));
    const PathTracedView traced = pathTraceView(scene, rays, *light, camera, view, 4, options);
    const std::vector<Vec3f> white(scene.vertexCount(), Vec3f(1.0f));
    const Image expected = renderView(scene, rays, white, camera, view);
    double differing = 0.0;
    for (std::size_t i = 0; i < expected.pixels.size(); ++i)
        if (!traced.radiance.pixels[i].equalWithAbsError(expected.pixels[i], 1e-5f)) ++differing;
    // Shading normals let a few paths of a grazed facet meet the next facet, and end there.
    EXPECT_LT(differing / static_cast<double>(expected.pixels.size()), 0.05);
}

Scene makeBlockedFloor() {
    return assembleScene(
        {{makeFloor(2.0f, 0.0f, 1), Vec3f(0.5f)},
         {makeBox({-0.5f, 0.7f, -0.5f}, {0.5f, 0.8f, 0.5f}, false, 1), Vec3f(0.5f)}});
}

/// Under a sun of no extent a pixel of the floor is lit in full or not at all, without noise.
TEST(PathTracedView, ASunWithoutExtentCastsAHardShadow) {
    const Scene scene = makeBlockedFloor();
    const RayScene rays(scene);
    const Vec3d toSun = Vec3d(1.0, 1.0, 0.0).normalized();
    const auto light = makeSunLight(toSun, 0.0);
    PathTracerOptions options;
    options.walk.bounceCount = 0;
    const float lit = static_cast<float>(0.5 * toSun.y / std::numbers::pi);
    // Rays at 45 degrees: the slab's shadow on the floor is −1.3 < x < −0.2 at |z| < 0.5.
    for (const auto& [x, expected] :
         {std::pair(-1.35f, lit), {-1.2f, 0.0f}, {-0.6f, 0.0f}, {-0.3f, 0.0f}, {-0.15f, lit}}) {
        // Just above the floor and below the slab, looking down.
        const Camera camera = lookAt({x, 0.1f, 0.1f}, {x, 0.0f, 0.1f}, 0.1f);
        const PathTracedView view =
            pathTraceView(scene, rays, *light, camera, makeView(2, 2), 4, options);
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_NEAR(view.radiance.pixels[i].x, expected, 1e-6f) << x;
            EXPECT_LT(view.variance.pixels[i].x, 1e-12f);
        }
    }
}

TEST(PathTracedView, AMirrorShowsTheLightAroundItToEveryPixel) {
    Scene scene = assembleScene({{makeFloor(20.0f, 0.0f, 1), Vec3f(0.9f, 0.7f, 0.5f)}});
    scene.materials[0].metallicFactor = 1.0f;
    scene.materials[0].roughnessFactor = 0.0f;
    scene.materials[0].emissiveFactor = {0.0f, 0.0f, 0.5f};
    const RayScene rays(scene);
    const Camera camera = lookAt({0.3f, 1.5f, 2.0f}, Vec3f(0.0f), 0.6f);
    const RenderOptions view = makeView(16, 12);
    const Lighting lighting = sunLighting(Vec3d(0.2, 0.5, -0.7).normalized(), 0.5, 4);
    PathTracerOptions options;
    options.walk.surfaceModel = SurfaceModel::gltf;
    options.lightSampling = false;
    const PathTracedView traced =
        pathTraceView(scene, rays, *makeBandLimitedLight(lighting), camera, view, 2, options);
    const CameraRays cameraRays(scene, rays, camera, view);
    const std::vector<SeenPoint> seen = cameraRays.findSeenPoints(0, 16 * 12);
    for (std::size_t pixel = 0; pixel < traced.radiance.pixels.size(); ++pixel) {
        Vec3d expected(0.0);
        for (std::size_t i = 4 * pixel; i < 4 * pixel + 4; ++i) {
            ASSERT_FALSE(seen[i].hit.escaped);
            const Vec3d direction(seen[i].direction);
            const Vec3d color(Vec3f(0.9f, 0.7f, 0.5f));
            const Vec3d fresnel = color + (Vec3d(1.0) - color) * std::pow(1.0 + direction.y, 5);
            expected += fresnel * reconstruct(lighting, {direction.x, -direction.y, direction.z});
        }
        expected = expected / 4.0 + Vec3d(0.0, 0.0, 0.5);
        // The smoothest facets there are lean by 10⁻⁴, some of them by more.
        constexpr double kFacets = 3e-3;
        EXPECT_NEAR((Vec3d(traced.radiance.pixels[pixel]) - expected).length(), 0.0, kFacets);
    }
}

/// Smooth normals and silhouettes included.
TEST(PathTracedView, APictureOfLambertBrdfsIsThatOfTheDiffuseModel) {
    const Scene scene = assembleScene({{makeFloor(2.0f, 0.0f, 1), Vec3f(0.3f, 0.5f, 0.7f)},
                                       {makeSphere({0.0f, 0.6f, 0.0f}, 0.5f, 16), Vec3f(0.8f)}});
    const std::vector<Brdf> brdfs = {{.lobes = {LambertLobe{Vec3d(Vec3f(0.3f, 0.5f, 0.7f))}}},
                                     {.lobes = {LambertLobe{Vec3d(Vec3f(0.8f))}}}};
    const RayScene rays(scene);
    const Camera camera = lookAt({0.0f, 1.2f, 2.0f}, {0.0f, 0.5f, 0.0f}, 0.7f);
    const auto light = makeSunLight(Vec3d(1.0, 1.0, 0.3).normalized(), 0.3);
    const RenderOptions view = makeView(40, 30);
    PathTracerOptions options;
    const PathTracedView diffuse = pathTraceView(scene, rays, *light, camera, view, 100, options);
    options.walk.surfaceModel = SurfaceModel::gltf;
    options.walk.materialBrdfs = brdfs;
    options.seed = 2;
    const PathTracedView lambert = pathTraceView(scene, rays, *light, camera, view, 100, options);
    const auto estimateOf = [](const PathTracedView& picture) {
        RadianceEstimate estimate;
        for (std::size_t i = 0; i < picture.radiance.pixels.size(); ++i) {
            estimate.mean.emplace_back(picture.radiance.pixels[i]);
            estimate.variance.emplace_back(picture.variance.pixels[i]);
        }
        return estimate;
    };
    test::expectSameMeans(estimateOf(diffuse), estimateOf(lambert));
}

TEST(PathTracedView, TheVarianceIsThatOfOtherSeeds) {
    const Scene scene = makeBlockedFloor();
    const RayScene rays(scene);
    const Camera camera = lookAt({0.0f, 3.0f, 3.0f}, Vec3f(0.0f), 0.8f);
    const auto light = makeSunLight(Vec3d(1.0, 1.0, 0.0).normalized(), 0.3);
    const RenderOptions view = makeView(24, 18);
    PathTracerOptions options;
    const PathTracedView one = pathTraceView(scene, rays, *light, camera, view, 4, options);
    options.seed = 2;
    const PathTracedView two = pathTraceView(scene, rays, *light, camera, view, 4, options);
    double squares = 0.0, variance = 0.0;
    for (std::size_t i = 0; i < one.radiance.pixels.size(); ++i) {
        const Vec3f difference = one.radiance.pixels[i] - two.radiance.pixels[i];
        squares += static_cast<double>(difference.length2());
        variance += static_cast<double>((one.variance.pixels[i] + two.variance.pixels[i]).x) * 3.0;
    }
    ASSERT_GT(variance, 0.0);
    EXPECT_NEAR(squares / variance, 1.0, 0.25);  // some hundred noisy pixels
}

TEST(PathTracedView, AnyNumberOfThreadsGivesTheSameBits) {  // C10
    const Scene scene = makeBlockedFloor();
    const RayScene rays(scene);
    const Camera camera = lookAt({0.0f, 3.0f, 3.0f}, Vec3f(0.0f), 0.8f);
    const auto light = makeSunLight(Vec3d(1.0, 1.0, 0.0).normalized(), 0.3);
    PathTracerOptions options;
    options.threadCount = 1;
    const RenderOptions view = makeView(61, 47);
    const PathTracedView one = pathTraceView(scene, rays, *light, camera, view, 2, options);
    options.threadCount = 3;
    const PathTracedView three = pathTraceView(scene, rays, *light, camera, view, 2, options);
    EXPECT_EQ(one.radiance.pixels, three.radiance.pixels);
    EXPECT_EQ(one.variance.pixels, three.variance.pixels);
}

TEST(PathTracedView, ReportsEveryPixelAndCanBeCancelled) {
    const Scene scene = makeBlockedFloor();
    const RayScene rays(scene);
    const Camera camera = lookAt({0.0f, 3.0f, 3.0f}, {0.0f, 20.0f, 0.0f}, 2.0f);
    const auto light = makeSunLight(Vec3d(0.0, 1.0, 0.0), 0.0);
    PathTracerOptions options;
    Progress last;
    options.progress = [&](const Progress& progress) {
        EXPECT_GE(progress.done, last.done);
        last = progress;
        return true;
    };
    pathTraceView(scene, rays, *light, camera, makeView(70, 50), 2, options);
    EXPECT_EQ(last.unit, "pixels");
    EXPECT_EQ(last.done, 3500u);
    EXPECT_EQ(last.total, 3500u);
    options.progress = [](const Progress& progress) { return progress.done < 1000; };
    try {
        pathTraceView(scene, rays, *light, camera, makeView(70, 50), 2, options);
        FAIL() << "not cancelled";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cancelled);
    }
}

TEST(PathTracedView, AnEmptySceneShowsTheBackground) {
    const Scene scene;
    const Environment sky{SphereMap::latLong, Image(2, 1, Vec3f(3.0f))};
    RenderOptions view = makeView(3, 2);
    view.background = &sky;
    const PathTracedView traced = pathTraceView(
        scene, RayScene(scene), *makeSunLight(Vec3d(0.0, 1.0, 0.0), 0.0), {}, view, 2);
    for (const Vec3f& pixel : traced.radiance.pixels)
        EXPECT_NEAR(pixel.x, 3.0f, 1e-5f);
}

}  // namespace
}  // namespace prt
