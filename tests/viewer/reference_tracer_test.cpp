#include "apps/viewer/reference_tracer.h"

#include <chrono>
#include <cmath>
#include <numbers>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "prt/image/error_metrics.h"
#include "prt/light/analytic_lights.h"
#include "prt/render/path_traced_view.h"
#include "prt/scene/framing.h"
#include "tests/support/scenes.h"
#include "tests/viewer/small_asset.h"

namespace prt::viewer {
namespace {

std::shared_ptr<const Asset> makeAsset(Scene scene) {
    auto asset = std::make_shared<Asset>();
    asset->scene = std::move(scene);
    return asset;
}

std::shared_ptr<const Asset> makeBall(const Vec3f& albedo) {
    return makeAsset(test::assembleScene({{makeSphere(Vec3f(0.0f), 1.0f, 32), albedo}}));
}

ReferenceRequest makeRequest(std::vector<PlacedAsset> objects, int width, int height) {
    ReferenceRequest request;
    request.objects = std::move(objects);
    request.environment = std::make_shared<const Environment>(
        Environment{SphereMap::latLong, Image(4, 2, Vec3f(1.0f))});
    request.camera = lookAt({0.0f, 0.0f, 6.0f}, Vec3f(0.0f), 0.6f);
    request.width = width;
    request.height = height;
    return request;
}

/// The mean of a square around a point of the picture.
Vec3f meanAround(const Image& picture, int x, int y, int radius) {
    Vec3d sum(0.0);
    for (int row = y - radius; row <= y + radius; ++row)
        for (int column = x - radius; column <= x + radius; ++column)
            sum += Vec3d(picture.at(column, row));
    return Vec3f(sum / std::pow(2.0 * radius + 1.0, 2.0));
}

TEST(ReferenceTracer, AWhiteBallVanishesInUniformLight) {
    // A shading normal lets a path of a grazed facet meet the next one, which reflects no more.
    constexpr float kFacets = 0.01f;
    ReferenceTracer tracer;
    tracer.trace(makeRequest({{makeBall(Vec3f(1.0f))}}, 40, 30));
    const ReferencePicture furnace = tracer.finish(512);
    ASSERT_TRUE(furnace.radiance) << furnace.failure;
    EXPECT_GE(furnace.pathsPerPixel, 512);
    EXPECT_NEAR(meanAround(*furnace.radiance, 20, 15, 4).y, 1.0f, kFacets);
    EXPECT_EQ(furnace.radiance->at(0, 0), Vec3f(1.0f));
}

/// A floor under a slab, seen from the side.
ReferenceRequest makeShadowRequest() {
    const auto asset = makeAsset(test::assembleScene(
        {{makeFloor(2.0f, 0.0f, 1), Vec3f(0.5f)},
         {makeBox({-0.5f, 0.7f, -0.5f}, {0.5f, 0.8f, 0.5f}, false, 1), Vec3f(0.2f, 0.6f, 0.9f)}}));
    ReferenceRequest request = makeRequest({{asset}}, 32, 24);
    request.lighting =
        add(uniformLighting(Vec3d(0.3), 4), sunLighting(Vec3d(1.0, 1.0, 1.0).normalized(), 0.2, 4));
    request.camera = lookAt({0.0f, 3.0f, 5.0f}, Vec3f(0.0f), 0.7f);
    request.model.bounceCount = 1;
    return request;
}

TEST(ReferenceTracer, ComesToThePictureOfOtherPaths) {
    constexpr int kPaths = 512;
    const ReferenceRequest request = makeShadowRequest();
    ReferenceTracer tracer;
    tracer.trace(request);
    const Image traced = *tracer.finish(kPaths).radiance;

    const RayScene rays(request.objects[0].asset->scene);
    RenderOptions view{.width = request.width, .height = request.height, .seed = 12345};
    view.background = request.environment.get();
    PathTracerOptions options{.seed = 54321};
    options.walk.bounceCount = 1;
    const PathTracedView expected = pathTraceView(request.objects[0].asset->scene, rays,
                                                  *makeBandLimitedLight(*request.lighting),
                                                  request.camera, view, kPaths / 16, options);
    // Of the mean over all pixels: five deviations of either, by the variance of one.
    Vec3d difference(0.0);
    double variance = 0.0;
    for (std::size_t i = 0; i < traced.pixels.size(); ++i) {
        difference += Vec3d(traced.pixels[i]) - Vec3d(expected.radiance.pixels[i]);
        variance += 2.0 * static_cast<double>(expected.variance.pixels[i].y);
    }
    EXPECT_LT(std::abs(difference.y), 5.0 * std::sqrt(variance));
    // Pixel by pixel edges are what differs most.
    constexpr double kNoise = 0.03;
    EXPECT_LT(measureError(traced, expected.radiance).relativeRmse, kNoise);
}

TEST(ReferenceTracer, TheSameRequestGivesTheSameBits) {
    constexpr int kPaths = 6;
    const ReferenceRequest request = makeShadowRequest();
    ReferenceTracer one({.threadCount = 1, .mostPathsPerPixel = kPaths});
    ReferenceTracer two({.threadCount = 2, .mostPathsPerPixel = kPaths});
    one.trace(request);
    ReferenceRequest other = request;
    other.camera.eye.x += 0.5f;
    two.trace(other);
    two.finish(1);
    two.trace(request);
    const ReferencePicture first = one.finish(kPaths);
    const ReferencePicture second = two.finish(kPaths);
    EXPECT_EQ(first.pathsPerPixel, kPaths);
    EXPECT_EQ(second.pathsPerPixel, kPaths);
    EXPECT_EQ(first.radiance->pixels, second.radiance->pixels);
    EXPECT_NE(first.radiance->pixels, Image(32, 24).pixels);
}

TEST(ReferenceTracer, AnEqualRequestGoesOnAndAnotherBeginsAnew) {
    ReferenceRequest request = makeShadowRequest();
    ReferenceTracer tracer({.mostPathsPerPixel = 8});
    tracer.trace(request);
    EXPECT_EQ(tracer.finish(8).pathsPerPixel, 8);
    const auto done = tracer.picture().radiance;
    tracer.trace(request);
    EXPECT_EQ(tracer.picture().radiance, done);

    request.lighting = scale(*request.lighting, 2.0);
    tracer.trace(request);
    const Image brighter = *tracer.finish(8).radiance;
    request.showBackground = false;
    tracer.trace(request);
    const Image unseen = *tracer.finish(8).radiance;
    EXPECT_EQ(brighter.at(0, 0), Vec3f(1.0f));
    EXPECT_EQ(unseen.at(0, 0), Vec3f(0.0f));
    EXPECT_NEAR(brighter.at(16, 14).x, 2.0f * done->at(16, 14).x, 1e-5f);

    tracer.stop();
    EXPECT_FALSE(tracer.picture().radiance);
    EXPECT_FALSE(tracer.finish(8).radiance);
    tracer.trace(request);
    EXPECT_EQ(tracer.finish(8).radiance->pixels, unseen.pixels);
}

TEST(ReferenceTracer, BeginsWithACoarsePicture) {
    // The first fine one takes most of a second, in which to see the coarse ones.
    const ReferenceRequest request = makeRequest({{makeBall(Vec3f(0.5f))}}, 1600, 1200);
    ReferenceTracer tracer;
    tracer.trace(request);
    ReferencePicture first;
    while (!first.radiance) {
        std::this_thread::yield();
        first = tracer.picture();
    }
    EXPECT_EQ(first.radiance->width, 1600);
    EXPECT_EQ(first.radiance->height, 1200);
    EXPECT_EQ(first.pathsPerPixel, 0);
    EXPECT_NEAR(meanAround(*first.radiance, 800, 600, 80).y, 0.5f, 0.02f);
}

TEST(ReferenceTracer, WhoTurnsTheViewWithoutAPauseSeesItToo) {
    ReferenceRequest request = makeRequest({{makeBall(Vec3f(0.5f))}}, 800, 600);
    ReferenceTracer tracer;
    // Every request is gone long before its first picture could be finished.
    for (int pictureCount = 0; pictureCount < 2;) {
        const auto before = tracer.picture().radiance;
        request.camera.eye.x += 1e-4f;
        tracer.trace(request);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        if (tracer.picture().radiance != before) ++pictureCount;
    }
    request.width = 799;
    tracer.trace(request);
    for (ReferencePicture other; other.pathsPerPixel == 0; std::this_thread::yield()) {
        other = tracer.picture();
        ASSERT_TRUE(!other.radiance || other.radiance->width == 799);
    }
}

TEST(ReferenceTracer, TurnsTheEnvironmentAndPlacesObjects) {
    // Light 1 from the half space of +x.
    Environment half{SphereMap::latLong, Image(64, 32)};
    for (int y = 0; y < 32; ++y)
        for (int x = 16; x < 48; ++x)
            half.radiance.at(x, y) = Vec3f(1.0f);
    ReferenceRequest request = makeRequest(
        {{makeBall(Vec3f(1.0f, 0.0f, 0.0f))}, {makeBall(Vec3f(0.0f, 1.0f, 0.0f))}}, 60, 10);
    request.objects[0].worldFromObject.translation = {-2.0, 0.0, 0.0};
    request.objects[1].worldFromObject = {rotationX(0.7), {2.0, 0.0, 0.0}};
    request.environment = std::make_shared<const Environment>(std::move(half));
    request.camera = lookAt({0.0f, 0.0f, 30.0f}, Vec3f(0.0f), 0.047f);  // 0.14 m to a pixel
    request.showBackground = false;
    ReferenceTracer tracer;
    const auto look = [&](int x) {
        tracer.trace(request);
        return meanAround(*tracer.finish(1024).radiance, x, 5, 2);
    };
    // In the middle of a ball, where the normal is +z, (1 + cos θ)/2 (conventions, "Known
    // answers"): 90° from the light, then 45°.
    constexpr float kNoise = 0.03f;
    EXPECT_TRUE(look(15).equalWithAbsError(Vec3f(0.5f, 0.0f, 0.0f), kNoise)) << look(15);
    EXPECT_TRUE(look(44).equalWithAbsError(Vec3f(0.0f, 0.5f, 0.0f), kNoise)) << look(44);
    request.worldFromEnvironment = rotationY(-0.25 * std::numbers::pi);  // from +x to +x+z
    const float turned = static_cast<float>(0.5 + 0.25 * std::numbers::sqrt2);
    EXPECT_TRUE(look(15).equalWithAbsError(Vec3f(turned, 0.0f, 0.0f), kNoise)) << look(15);
    EXPECT_TRUE(look(44).equalWithAbsError(Vec3f(0.0f, turned, 0.0f), kNoise)) << look(44);
}

TEST(ReferenceTracer, WithoutObjectsOnlyTheBackgroundIsSeen) {
    ReferenceTracer tracer;
    ReferenceRequest request = makeRequest({}, 8, 8);
    tracer.trace(request);
    EXPECT_EQ(tracer.finish(2).radiance->at(4, 4), Vec3f(1.0f));
    request.environment = nullptr;
    request.objects = {{makeBall(Vec3f(1.0f))}};
    tracer.trace(request);
    EXPECT_EQ(tracer.finish(2).radiance->pixels, Image(8, 8).pixels);
}

TEST(ReferenceTracer, WhatCannotBeTracedIsTold) {
    ReferenceTracer tracer;
    tracer.trace(makeRequest({{makeBall(Vec3f(1.0f))}}, 0, 10));
    const ReferencePicture none = tracer.finish(2);
    EXPECT_FALSE(none.radiance);
    EXPECT_NE(none.failure, "");
    tracer.trace(makeRequest({{makeBall(Vec3f(1.0f))}}, 4, 4));
    EXPECT_EQ(tracer.finish(2).failure, "");
}

TEST(ReferenceTracer, ClosesWhileItIsBusy) {
    // In a closed white room paths bounce on and on: the first coarse picture of this size takes
    // many minutes. It is cut off, or the test is.
    ReferenceRequest request = makeRequest(
        {{makeAsset(
            test::assembleScene({{makeBox(Vec3f(-1.0f), Vec3f(1.0f), true, 1), Vec3f(0.99f)}}))}},
        8192, 8192);
    request.camera = lookAt(Vec3f(0.0f), {0.0f, 0.0f, 1.0f}, 0.6f);
    request.model.bounceCount = kUnlimitedBounces;
    ReferenceTracer tracer;
    tracer.trace(request);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_FALSE(tracer.picture().radiance);
}

}  // namespace
}  // namespace prt::viewer
