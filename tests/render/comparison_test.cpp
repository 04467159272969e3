#include "prt/render/comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "prt/base/random.h"
#include "prt/light/analytic_lights.h"
#include "prt/render/exit_shading.h"
#include "prt/scene/framing.h"
#include "prt/scene/procedural.h"
#include "tests/support/scenes.h"

namespace prt {
namespace {

constexpr int kSide = 64;

/// A ramp with normal noise (Box and Muller's) of the given deviation.
PathTracedView makeNoisyRamp(float deviation, std::uint64_t seed = 4) {
    PathTracedView view{Image(kSide, kSide), Image(kSide, kSide, Vec3f(deviation * deviation))};
    RandomStream random(seed, 0);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            for (int channel = 0; channel < 3; ++channel) {
                const double radius = std::sqrt(-2.0 * std::log(1.0 - random.nextUnitDouble()));
                const double normal =
                    radius * std::cos(2.0 * std::numbers::pi * random.nextUnitDouble());
                view.radiance.at(x, y)[channel] =
                    static_cast<float>(x) / kSide + deviation * static_cast<float>(normal);
            }
    return view;
}

Image makeRamp(float error) {
    Image ramp(kSide, kSide);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            ramp.at(x, y) = Vec3f(static_cast<float>(x) / kSide + error);
    return ramp;
}

/// The pixels as if they were the vertices of a scene.
Reference asVertices(const PathTracedView& view) {
    Reference reference;
    for (std::size_t i = 0; i < view.radiance.pixels.size(); ++i) {
        reference.vertices.push_back(i);
        reference.atVertices.mean.emplace_back(view.radiance.pixels[i]);
        reference.atVertices.variance.emplace_back(view.variance.pixels[i]);
    }
    return reference;
}

TEST(Comparison, TakesTheNoiseOfTheReferenceOut) {
    constexpr float kNoise = 0.1f;
    for (const float error : {0.05f, 0.1f, 0.3f}) {
        const NoisyError measured =
            comparePictures(makeRamp(error), makeNoisyRamp(kNoise), {}).error;
        EXPECT_NEAR(measured.error.rmse, std::hypot(error, kNoise), 0.01);
        EXPECT_NEAR(measured.noiseRmse, kNoise, 1e-6);
        EXPECT_NEAR(measured.rmseWithoutNoise(), error, 0.005);
        EXPECT_GE(measured.largestRmseWithoutNoise(), measured.rmseWithoutNoise());
        EXPECT_TRUE(measured.isSignificant());
    }
}

TEST(Comparison, ANoisyReferenceProvesNoSmallError) {
    const NoisyError none = comparePictures(makeRamp(0.0f), makeNoisyRamp(0.1f), {}).error;
    EXPECT_FALSE(none.isSignificant());
    EXPECT_LT(none.largestRmseWithoutNoise(), 0.03);
    const NoisyError little = comparePictures(makeRamp(0.002f), makeNoisyRamp(0.1f), {}).error;
    EXPECT_FALSE(little.isSignificant());
    EXPECT_GT(little.largestRmseWithoutNoise(), 0.002);
}

TEST(Comparison, KnowsHowFarChanceMovesTheErrorWithoutNoise) {
    constexpr int kRunCount = 40;
    double sum = 0.0, squareSum = 0.0, claimed = 0.0;
    for (std::uint64_t seed = 1; seed <= kRunCount; ++seed) {
        const NoisyError run =
            compareAtVertices(makeRamp(0.05f).pixels, asVertices(makeNoisyRamp(0.1f, seed)));
        const double square = run.error.rmse * run.error.rmse - run.noiseRmse * run.noiseRmse;
        sum += square / kRunCount;
        squareSum += square * square / kRunCount;
        claimed += run.squareDeviation / kRunCount;
    }
    // The deviation of a deviation from 40 runs is a ninth of it.
    EXPECT_NEAR(std::sqrt(squareSum - sum * sum) / claimed, 1.0, 0.4);
}

TEST(Comparison, EqualPicturesDifferInNothing) {
    const PathTracedView reference{makeRamp(0.0f), Image(kSide, kSide)};
    const PictureComparison comparison = comparePictures(makeRamp(0.0f), reference, {});
    EXPECT_EQ(comparison.error.error.rmse, 0.0);
    EXPECT_EQ(comparison.error.rmseWithoutNoise(), 0.0);
    EXPECT_EQ(comparison.error.relative(comparison.error.rmseWithoutNoise()), 0.0);
    EXPECT_EQ(comparison.psnr, std::numeric_limits<double>::infinity());
    EXPECT_EQ(comparison.meanFlip, 0.0);
}

TEST(Comparison, LuminanceChangeIsSigned) {
    const PathTracedView reference{makeRamp(0.0f), Image(kSide, kSide)};
    const PictureComparison comparison = comparePictures(makeRamp(-0.25f), reference, {});
    EXPECT_NEAR(comparison.luminanceChange.at(5, 5), -0.25f, 1e-6f);
}

/// An open floor under a sun, whose B is the cosine over π everywhere.
TEST(Comparison, AReferenceOfAnOpenFloorIsItsClosedForm) {
    const Scene scene = test::assembleScene({{makeFloor(1.0f, 0.0f, 40)}});
    const RayScene rays(scene);
    const double elevation = 0.8;
    const auto light = makeSunLight(Vec3d(std::cos(elevation), std::sin(elevation), 0.0), 0.1);
    ReferenceOptions options;
    options.view.width = 32;
    options.view.height = 18;
    options.samplesPerRay = 2;
    options.maxVertexCount = 100;
    const Reference reference =
        traceReference(scene, rays, *light, lookAt({0.0f, 2.0f, 2.0f}, Vec3f(0.0f), 0.7f), options);
    EXPECT_EQ(reference.vertices.size(), 100u);
    EXPECT_EQ(reference.vertices.front(), 0u);
    EXPECT_GT(reference.vertices.back(), scene.vertexCount() * 95 / 100);
    const std::vector<Vec3f> expected(
        scene.vertexCount(), Vec3f(static_cast<float>(std::sin(elevation) / std::numbers::pi)));
    const NoisyError atVertices = compareAtVertices(expected, reference);
    EXPECT_LT(atVertices.relative(atVertices.largestRmseWithoutNoise()), 0.01);
    const Image relit = renderView(scene, rays, expected,
                                   lookAt({0.0f, 2.0f, 2.0f}, Vec3f(0.0f), 0.7f), options.view);
    const NoisyError inPicture = comparePictures(relit, reference.view, {}).error;
    EXPECT_LT(inPicture.relative(inPicture.largestRmseWithoutNoise()), 0.01);
    // A wrong B is noticed.
    std::vector<Vec3f> wrong = expected;
    for (Vec3f& radiance : wrong)
        radiance *= 1.1f;
    const NoisyError noticed = compareAtVertices(wrong, reference);
    EXPECT_TRUE(noticed.isSignificant());
    EXPECT_NEAR(noticed.relative(noticed.rmseWithoutNoise()), 0.1, 0.01);
}

/// Of an open surface under white light leaves the share that it reflects.
TEST(Comparison, AReferenceOfAGlossyFloorIsItsDirectionalAlbedo) {
    Scene scene = test::assembleScene({{makeFloor(1.0f, 0.0f, 40), Vec3f(0.9f, 0.5f, 0.2f)}});
    scene.materials[0].metallicFactor = 1.0f;
    scene.materials[0].roughnessFactor = 0.4f;
    const RayScene rays(scene);
    const Camera camera = lookAt({0.0f, 1.0f, 1.5f}, Vec3f(0.0f), 0.7f);
    ReferenceOptions options;
    options.view.width = 32;
    options.view.height = 18;
    options.samplesPerRay = 32;
    options.samplesPerVertex = 2048;
    options.maxVertexCount = 100;
    options.surfaceModel = SurfaceModel::gltf;
    const auto light = makeBandLimitedLight(uniformLighting(Vec3d(1.0), 1));
    const Reference reference = traceReference(scene, rays, *light, camera, options);

    const MirrorEnvironment white = makeMirrorEnvironment(
        {SphereMap::latLong, Image(16, 8, Vec3f(1.0f))}, {}, {.faceSize = 8, .sampleCount = 16});
    const std::vector<ExitRadiance> mirrored(scene.vertexCount(), {Vec3f(0.0f), Vec3f(0.0f), 1.0f});
    std::vector<Vec3f> expected = shadeVertices(scene, mirrored, camera.eye, &white);
    const NoisyError atVertices = compareAtVertices(expected, reference);
    EXPECT_LT(atVertices.relative(atVertices.largestRmseWithoutNoise()), 0.01);
    options.view.mirrors = &white;
    const Image relit = renderView(scene, rays, mirrored, camera, options.view);
    const NoisyError inPicture = comparePictures(relit, reference.view, {}).error;
    EXPECT_LT(inPicture.relative(inPicture.largestRmseWithoutNoise()), 0.01);

    for (Vec3f& radiance : expected)
        radiance *= 1.1f;
    EXPECT_NEAR(compareAtVertices(expected, reference).error.relativeRmse, 0.1, 0.03);

    // Given BRDFs take the place of materials.
    const std::vector<Brdf> lambert = {{.lobes = {LambertLobe{Vec3d(0.5)}}}};
    options.materialBrdfs = lambert;
    const Reference matt = traceReference(scene, rays, *light, camera, options);
    const NoisyError ofHalf =
        compareAtVertices(std::vector<Vec3f>(scene.vertexCount(), Vec3f(0.5f)), matt);
    EXPECT_LT(ofHalf.relative(ofHalf.largestRmseWithoutNoise()), 0.01);
}

TEST(Comparison, GlossyReferencesLookAtVerticesThatFaceTheEye) {
    Scene scene = test::assembleScene({{makeSphere(Vec3f(0.0f), 1.0f, 24)}});
    Mesh& mesh = scene.meshes[0];
    mesh.positions.push_back(Vec3f(0.0f, 0.0f, 1.0f));  // of no triangle
    mesh.normals.push_back(Vec3f(0.0f, 0.0f, 1.0f));
    ReferenceOptions options;
    options.view.width = options.view.height = 1;
    options.samplesPerRay = options.samplesPerVertex = 2;
    options.surfaceModel = SurfaceModel::gltf;
    const Vec3f eye(0.0f, 0.0f, 4.0f);
    const Reference reference = traceReference(
        scene, RayScene(scene), *makeBandLimitedLight(uniformLighting(Vec3d(1.0), 1)),
        lookAt(eye, Vec3f(0.0f), 0.7f), options);
    std::vector<std::size_t> facing;
    for (std::size_t i = 0; i + 1 < mesh.vertexCount(); ++i)
        if (mesh.normals[i].dot(eye - mesh.positions[i]) > 0.0f) facing.push_back(i);
    EXPECT_GT(facing.size(), mesh.vertexCount() / 4);
    EXPECT_EQ(reference.vertices, facing);
    EXPECT_EQ(reference.atVertices.mean.size(), facing.size());
}

TEST(Comparison, EachMaterialHasItsOwnError) {
    const Scene scene = test::assembleScene(
        {{test::makeQuad({-3, -1, -1}, {0, -1, -1}, {0, 1, -1}, {-3, 1, -1})},
         {test::makeQuad({0, -1, -1}, {1.5f, -1, -1}, {1.5f, 1, -1}, {0, 1, -1})},
         {test::makeQuad({0, -9, 1}, {1, -9, 1}, {1, -8, 1}, {0, -8, 1})}});  // not seen
    Camera camera;
    camera.verticalFovRadians = std::numbers::pi_v<float> / 2.0f;
    const RenderOptions view{.width = 6, .height = 2};
    // The left wall fills columns 0 to 2, the right one 3 and half of 4.
    const PathTracedView reference{Image(6, 2, Vec3f(1.0f)), Image(6, 2, Vec3f(0.01f))};
    Image picture = reference.radiance;
    for (int y = 0; y < 2; ++y) {
        picture.at(0, y) = Vec3f(1.5f);
        picture.at(3, y) = Vec3f(1.25f);
        picture.at(4, y) = picture.at(5, y) = Vec3f(9.0f);  // seen together with nothing
    }
    const std::vector<MaterialError> errors =
        compareMaterials(scene, RayScene(scene), camera, view, picture, reference);
    ASSERT_EQ(errors.size(), 2u);
    EXPECT_EQ(errors[0].material, 0u);
    EXPECT_EQ(errors[0].pixelCount, 6u);
    EXPECT_NEAR(errors[0].error.error.rmse, 0.5 / std::sqrt(3.0), 1e-6);
    EXPECT_EQ(errors[1].material, 1u);
    EXPECT_EQ(errors[1].pixelCount, 2u);
    EXPECT_NEAR(errors[1].error.error.rmse, 0.25, 1e-6);
    EXPECT_NEAR(errors[1].error.noiseRmse, 0.1, 1e-6);
}

}  // namespace
}  // namespace prt
