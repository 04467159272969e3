// Pictures of surfaces as they are, from baked matrices: bake, relight to an eye, render.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "prt/brdf/specular_albedo.h"
#include "prt/compress/compress_transfer.h"
#include "prt/light/analytic_lights.h"
#include "prt/relight/glossy_relighter.h"
#include "prt/relight/relighter.h"
#include "prt/render/camera_rays.h"
#include "prt/render/render_view.h"
#include "prt/scene/framing.h"
#include "prt/transport/bake.h"
#include "prt/transport/unshadowed.h"
#include "tests/support/scenes.h"

namespace prt {
namespace {

constexpr int kBandCount = 5;

CompressedTransfer storeFloats(TransferField field) {
    return compressTransfer(std::move(field), {.encoding = TransferEncoding::float32});
}

template <class Value>
std::vector<Value> spreadToVertices(const CompressedTransfer& transfer,
                                    const std::vector<Value>& ofReceivers) {
    std::vector<Value> ofVertices;
    for (const std::uint32_t receiver : transfer.receiverOfVertex)
        ofVertices.push_back(ofReceivers[receiver]);
    return ofVertices;
}

/// What vertices send to an eye.
std::vector<ExitRadiance> showTo(const Vec3f& eye, const Scene& scene,
                                 const CompressedTransfer& transfer, const Lighting& lighting,
                                 const GlossyRelightOptions& options = {}) {
    const GltfViewTable views;
    const GlossyRelighter relighter(transfer, Transport::glossyShadowed,
                                    describeReceivers(scene, transfer), views, options);
    std::vector<ExitRadiance> exit(transfer.receiverCount);
    relighter.relight(lighting, eye, 0, exit);
    return spreadToVertices(transfer, exit);
}

/// White metal under white light is as bright as the share of light that its lobe reflects.
TEST(GlossyPicture, ARoughMetalSphereAloneShowsItsDirectionalAlbedo) {
    constexpr float kBandError = 0.015f;  // of a lobe held by five bands
    constexpr int kSize = 31;
    Scene scene = test::assembleScene({{makeSphere(Vec3f(0.0f), 1.0f, 64), Vec3f(1.0f)}});
    const RayScene rays(scene);
    const Camera camera = lookAt({0.0f, 0.0f, 4.0f}, Vec3f(0.0f), 0.6f);
    const Lighting white = uniformLighting(Vec3d(1.0), kBandCount);
    const CompressedTransfer transfer =
        storeFloats(makeUnshadowedMatrices(scene, kBandCount, kBandCount));
    const SpecularAlbedoTable albedo;
    for (const float roughness : {0.6f, 0.9f}) {
        scene.materials[0].metallicFactor = 1.0f;
        scene.materials[0].roughnessFactor = roughness;
        const Image picture =
            renderView(scene, rays, showTo(camera.eye, scene, transfer, white), camera,
                       {.width = kSize, .height = kSize, .samplesPerAxis = 1, .threadCount = 1});
        const CameraRays cameraRays(scene, rays, camera,
                                    {.width = kSize, .height = kSize, .samplesPerAxis = 1});
        const std::vector<SeenPoint> seen = cameraRays.findSeenPoints(0, kSize * kSize);
        int count = 0;
        for (std::size_t i = 0; i < seen.size(); ++i) {
            if (seen[i].hit.escaped) continue;
            const Vec3f normal = interpolateCorners(scene.meshes[0], seen[i].hit.point,
                                                    std::span<const Vec3f>(scene.meshes[0].normals))
                                     .normalized();
            const float cosine = -normal.dot(seen[i].direction);
            if (cosine < 0.3f) continue;  // where a triangle is wide in the angle
            ++count;
            EXPECT_NEAR(picture.pixels[i].x, albedo.evaluate(Vec3f(1.0f), roughness, cosine).x,
                        kBandError)
                << roughness << " " << cosine;
        }
        EXPECT_GT(count, 200);
    }
}

TEST(GlossyPicture, LambertBrdfsShowTheDiffusePicture) {
    constexpr float kTolerance = 0.01f;  // of the table, and of what rays of a bake leave uncertain
    const Scene scene = test::makeRoomScene();
    const RayScene rays(scene);
    const Camera camera = lookAt({2.0f, -3.0f, 2.0f}, Vec3f(0.0f, 0.0f, 0.5f), 0.7f);
    const Lighting lighting =
        add(uniformLighting(Vec3d(0.5, 0.4, 0.3), kBandCount),
            scale(sunLighting(Vec3d(0.4, -0.6, 0.7).normalized(), 0.5, kBandCount), 2.0));
    const CompressedTransfer transfer = storeFloats(bakeTransfer(
        scene,
        {.transport = Transport::glossyShadowed, .bandCount = kBandCount, .sampleCount = 4096}));

    GlossyRelightOptions options;
    for (const Material& material : scene.materials) {
        const Vec4f& color = material.baseColorFactor;
        options.materialTables.push_back(std::make_shared<BrdfViewTable>(
            Brdf{.lobes = {LambertLobe{Vec3d(Vec3f(color.x, color.y, color.z))}}}));
    }
    const RenderOptions view{.width = 64, .height = 48};
    const Image glossy = renderView(
        scene, rays, showTo(camera.eye, scene, transfer, lighting, options), camera, view);

    const Relighter relighter(transfer, Transport::shadowed);
    std::vector<Vec3f> radiance(relighter.receiverCount());
    relighter.relight(lighting, radiance);
    const Image diffuse =
        renderView(scene, rays, spreadToVertices(transfer, radiance), camera, view);
    double brightest = 0.0;
    for (std::size_t i = 0; i < diffuse.pixels.size(); ++i) {
        ASSERT_TRUE(glossy.pixels[i].equalWithAbsError(diffuse.pixels[i], kTolerance))
            << i << " " << glossy.pixels[i] << " " << diffuse.pixels[i];
        brightest = std::max(brightest, static_cast<double>(diffuse.pixels[i].x));
    }
    EXPECT_GT(brightest, 0.5);
}

}  // namespace
}  // namespace prt
