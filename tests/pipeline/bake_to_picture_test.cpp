// Scenes with known answers, through everything: bake, compress, write, read, relight, render.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "prt/asset/asset.h"
#include "prt/compress/compress_transfer.h"
#include "prt/light/analytic_lights.h"
#include "prt/relight/relighter.h"
#include "prt/render/render_view.h"
#include "prt/scene/framing.h"
#include "prt/scene/procedural.h"
#include "prt/scene/refine.h"
#include "prt/transport/bake.h"
#include "tests/support/kept_assets.h"
#include "tests/support/scenes.h"

namespace prt {
namespace {

using test::assembleScene;
using test::makePatch;
using test::transformScene;

constexpr Vec3f kUp(0.0f, 1.0f, 0.0f);
constexpr double kAlbedo = 0.5;

/// Bakes, stores in a file, reads back, and relights.
std::vector<Vec3f> relightThroughAsset(const Scene& scene, const BakeOptions& options,
                                       TransferEncoding encoding, const Lighting& lighting) {
    // A name of its own for every test, which may run beside others.
    const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
    std::string name =
        std::string("openprt-") + test.test_suite_name() + "-" + test.name() + ".prt.glb";
    std::replace(name.begin(), name.end(), '/', '-');
    const std::filesystem::path file = std::filesystem::temp_directory_path() / name;
    writeAsset(file, scene, compressTransfer(bakeTransfer(scene, options), {encoding}), {});
    const Asset asset = readAsset(file);
    test::keepAsset(file);
    std::filesystem::remove(file);

    const Relighter relighter(asset.transfer, options.transport);
    std::vector<Vec3f> radiance(relighter.receiverCount());
    relighter.relight(lighting, radiance);
    return radiance;
}

class EveryEncoding : public testing::TestWithParam<TransferEncoding> {
  protected:
    /// Half a step of the encoding over the range of a coefficient, times the light.
    double tolerance() const { return GetParam() == TransferEncoding::unorm8 ? 6e-3 : 5e-4; }
};

TEST_P(EveryEncoding,
       AConstantSkyGivesAmbientOcclusionNotAnAmbientTerm) {  // T-1, A6: the closed form is ¾
    const Scene scene =
        assembleScene({{makePatch({0, 0, 0}, kUp, 1e-3f)}, {makeSphere({0, 2, 0}, 1.0f, 48)}});
    BakeOptions options;
    options.transport = Transport::shadowed;
    const std::vector<Vec3f> radiance =
        relightThroughAsset(scene, options, GetParam(), uniformLighting(Vec3d(1.0, 2.0, 3.0), 5));
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(static_cast<double>(radiance[0][channel]), 0.75 * (channel + 1),
                    3.0 * (6e-3 + tolerance()));
}

TEST_P(EveryEncoding,
       TheHemisphereLightFollowsItsClosedForm) {  // A5: (1 + cos θ)/2 on a convex object
    const Scene scene = assembleScene({{makeSphere({0, 0, 0}, 1.0f, 24)}});
    BakeOptions options;
    options.transport = Transport::shadowed;
    const Lighting upperHalf =
        discLighting(Vec3d(0.0, 0.0, 1.0), std::numbers::pi / 2.0, Vec3d(1.0), 5);
    const std::vector<Vec3f> radiance = relightThroughAsset(scene, options, GetParam(), upperHalf);
    for (std::size_t i = 0; i < radiance.size(); ++i)
        EXPECT_NEAR(radiance[i].x, (1.0f + scene.meshes[0].normals[i].z) / 2.0f,
                    3e-3 + 4.0 * tolerance());
}

TEST_P(EveryEncoding, ABowlUnderAWhiteSkyIsEvenlyBright) {  // A13
    const Scene scene = assembleScene({{makeBowl(0.0f, 48), Vec3f(static_cast<float>(kAlbedo))}});
    BakeOptions options;
    options.sampleCount = 256;
    options.bounceCount = kInfiniteBounces;
    const std::vector<Vec3f> radiance =
        relightThroughAsset(scene, options, GetParam(), uniformLighting(Vec3d(1.0), 5));
    double sum = 0.0;
    for (const Vec3f& value : radiance)
        sum += static_cast<double>(value.x);
    EXPECT_NEAR(sum / static_cast<double>(radiance.size()), 0.5 / (1.0 - kAlbedo / 2.0),
                5e-3 + tolerance());
}

INSTANTIATE_TEST_SUITE_P(Pipeline, EveryEncoding,
                         testing::Values(TransferEncoding::float32, TransferEncoding::unorm16,
                                         TransferEncoding::unorm8),
                         [](const auto& parameter) {
                             return std::string(encodingName(parameter.param));
                         });

/// Vertices of a small scene that shadows itself and bounces colour.
Scene makeTestScene() {
    return assembleScene(
        {{makeFloor(2.0f, 0.0f, 12), {0.8f, 0.2f, 0.2f}},
         {makeBox({-0.5f, 0.1f, -0.5f}, {0.5f, 0.9f, 0.5f}, false, 4), {0.7f, 0.7f, 0.9f}}});
}

TEST(Pipeline, TurningObjectAndLightTogetherChangesNothing) {  // T-15, A16
    const Mat3d rotation = rotationX(0.4) * rotationY(-1.2) * rotationZ(2.0);
    const Scene scene = makeTestScene();
    const Scene turned = transformScene(scene, rotation, 1.0, Vec3f(0.0f));
    BakeOptions options;
    options.sampleCount = 4096;
    const Lighting sun = sunLighting(Vec3d(0.5, 0.8, 0.3).normalized(), 0.3, 5);
    const std::vector<Vec3f> reference =
        relightThroughAsset(scene, options, TransferEncoding::float32, sun);
    const std::vector<Vec3f> result =
        relightThroughAsset(turned, options, TransferEncoding::float32, rotate(sun, rotation));
    double squares = 0.0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
        // Two estimates of 4096 rays each; the sharpest edge of
        // visibility moves one by a hundredth.
        EXPECT_NEAR(reference[i].x, result[i].x, 2.5e-2) << "vertex " << i;
        squares += static_cast<double>((reference[i] - result[i]).length2());
    }
    EXPECT_LT(std::sqrt(squares / static_cast<double>(reference.size())), 4e-3);
}

TEST(Pipeline, RotatingTheObjectIsRotatingTheLightBack) {  // T-15
    const Scene scene = makeTestScene();
    BakeOptions options;
    options.sampleCount = 256;
    const Mat3d rotation = rotationY(0.7);
    const CompressedTransfer transfer =
        compressTransfer(bakeTransfer(scene, options), {TransferEncoding::float32});
    const Relighter relighter(transfer, Transport::interreflected);
    const Vec3d sunDirection = Vec3d(0.5, 0.8, 0.3).normalized();
    std::vector<Vec3f> rotatedLight(relighter.receiverCount());
    relighter.relight(rotate(sunLighting(sunDirection, 0.3, 5), rotation.transposed()),
                      rotatedLight);
    std::vector<Vec3f> rotatedSun(relighter.receiverCount());
    relighter.relight(sunLighting(rotation.transposed() * sunDirection, 0.3, 5), rotatedSun);
    for (std::size_t i = 0; i < rotatedLight.size(); ++i)
        EXPECT_NEAR(rotatedLight[i].y, rotatedSun[i].y, 1e-5f);
}

TEST(Pipeline, AFloorOfTwoTrianglesHoldsAShadow) {
    // A ball over a floor of one cell: after refinement the middle is dark and the rim is bright,
    // and so is the picture.
    const Scene coarse =
        assembleScene({{makeFloor(4.0f, 0.0f, 1), {1, 1, 1}}, {makeSphere({0, 1, 0}, 0.8f, 24)}});
    const Scene scene = refineEdges(coarse);
    BakeOptions options;
    options.transport = Transport::shadowed;
    options.sampleCount = 256;
    const TransferField field = bakeTransfer(scene, options);
    const Relighter relighter(compressTransfer(field), Transport::shadowed);
    std::vector<Vec3f> receiverRadiance(relighter.receiverCount());
    relighter.relight(uniformLighting(Vec3d(1.0), 5), receiverRadiance);
    std::vector<Vec3f> radiance;
    for (const std::uint32_t receiver : field.receiverOfVertex)
        radiance.push_back(receiverRadiance[receiver]);

    const RayScene rays(scene);
    const Camera fromBelow = lookAt({0, -6, 0}, {0, 0, 0}, 1.0f);
    Scene twoSided = scene;
    twoSided.materials[0].doubleSided = true;
    const Image picture =
        renderView(twoSided, rays, radiance, fromBelow, {.width = 64, .height = 64});
    EXPECT_LT(picture.at(32, 32).x, 0.45f);  // 1 − (0.8/1)² = 0.36 below the ball
    EXPECT_GT(picture.at(8, 8).x, 0.9f);
}

TEST(Conventions, C1_UpIsPlusYAndThePoleOfTheBasisIsPlusZ) {
    // A floor looks up along +y: a light from +y reaches it, one from −y does not.
    const Scene scene = assembleScene({{makeFloor(1.0f, 0.0f, 1)}});
    const Camera camera = frameScene(scene, 1.0f);
    EXPECT_GT(camera.eye.y, 0.0f);
    BakeOptions options;
    options.transport = Transport::shadowed;
    const auto radianceUnder = [&](const Vec3d& direction) {
        return relightThroughAsset(scene, options, TransferEncoding::float32,
                                   discLighting(direction, 0.5, Vec3d(1.0), 5))[0]
            .x;
    };
    EXPECT_GT(radianceUnder(Vec3d(0.0, 1.0, 0.0)), 0.2f);
    EXPECT_LT(std::abs(radianceUnder(Vec3d(0.0, -1.0, 0.0))), 0.02f);
    // Light about +z is zonal: only orders m = 0.
    const Lighting aboutZ = discLighting(Vec3d(0.0, 0.0, 1.0), 0.5, Vec3d(1.0), 5);
    for (int i = 0; i < 25; ++i) {
        const int l = shDegree(i);
        const double coefficient = aboutZ.coefficients[static_cast<std::size_t>(i)].x;
        EXPECT_EQ(std::abs(coefficient) > 1e-12, i == shIndex(l, 0)) << "coefficient " << i;
    }
}

TEST(Conventions, C7_OutgoingRadianceIsAlbedoTimesTransferTimesLight) {
    const Scene scene = assembleScene({{makeFloor(1.0f, 0.0f, 1), {0.2f, 0.4f, 0.6f}}});
    BakeOptions options;
    options.transport = Transport::shadowed;
    const std::vector<Vec3f> radiance = relightThroughAsset(
        scene, options, TransferEncoding::float32, uniformLighting(Vec3d(3.0), 5));
    EXPECT_NEAR(radiance[0].x, 3.0f, 1e-4f);
    const RayScene rays(scene);
    const Image picture = renderView(scene, rays, radiance, lookAt({0, 2, 0}, {0, 0, 0}, 0.5f),
                                     {.width = 4, .height = 4});
    EXPECT_NEAR(picture.at(1, 2).x, 0.6f, 1e-4f);
    EXPECT_NEAR(picture.at(1, 2).y, 1.2f, 1e-4f);
    EXPECT_NEAR(picture.at(1, 2).z, 1.8f, 1e-4f);
}

TEST(Conventions, C8_ZeroBouncesIsShadowedDirectLight) {
    const Scene scene = makeTestScene();
    BakeOptions options;
    options.sampleCount = 64;
    options.bounceCount = 0;
    const Lighting sun = sunLighting(Vec3d(0.0, 1.0, 0.0), 0.2, 5);
    const std::vector<Vec3f> noBounce =
        relightThroughAsset(scene, options, TransferEncoding::float32, sun);
    options.transport = Transport::shadowed;
    EXPECT_EQ(noBounce, relightThroughAsset(scene, options, TransferEncoding::float32, sun));
}

}  // namespace
}  // namespace prt
