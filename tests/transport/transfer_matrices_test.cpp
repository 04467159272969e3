#include "prt/transport/transfer_matrices.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "prt/base/error.h"
#include "tests/support/scenes.h"
#include "tests/support/transfer_matrix_checks.h"
#include "tests/transport/uniform_rays.h"

namespace prt {
namespace {

using test::assembleScene;
using test::BandCounts;
using test::intoLocalFrame;
using test::makePatch;
using test::makeQuad;
using test::makeRoomScene;
using test::matrixOfVertex;
using test::transformScene;

// Products of two functions of up to √(9/4π), over visibility edges that 4096 scrambled net points
// tell to about N^(−3/4).
constexpr double kQmcTolerance = 2e-2;
// The same without an edge.
constexpr double kSmoothTolerance = 2e-3;
// Sums of a thousand numbers of about 1, in float.
constexpr double kFloatTolerance = 2e-5;

TEST(TransferMatrices, OfAnOpenPlaneIntegrateOverTheHemisphere) {
    const Vec3f normal(0.6f, -0.64f, 0.48f);
    const Scene scene = assembleScene({{makePatch({0, 0, 0}, normal, 0.1f)}});
    const TransferMatrices baked = bakeTransferMatrices(scene, {.sampleCount = 4096});
    const std::vector<double> expected =
        test::sumMatrix(test::hemisphereQuadrature(normal, 20), {5, 5}, normal);
    const std::vector<float> matrix = matrixOfVertex(baked, 0);
    ASSERT_EQ(matrix.size(), expected.size());
    for (std::size_t e = 0; e < expected.size(); ++e)
        EXPECT_NEAR(matrix[e], expected[e], kSmoothTolerance) << "element " << e;
}

TEST(TransferMatrices, AreTheSumsOverTheirRays) {
    const Scene scene = makeRoomScene();
    const RayScene rays(scene);
    const Receivers receivers = placeReceivers(scene, rays);
    for (const BandCounts& bands : {BandCounts{5, 5}, BandCounts{3, 6}}) {
        const TransferMatrices baked = bakeTransferMatrices(
            scene, {.incidentBandCount = bands.incident, .bandCount = bands.light, .seed = 3});
        ASSERT_EQ(baked.matrices.rowCount(), receivers.fronts.size());
        for (std::size_t receiver = 0; receiver < receivers.fronts.size(); receiver += 23) {
            const Receiver& site = receivers.fronts[receiver];
            const RayStream stream = test::traceUniformRays(rays, site, 3);
            std::vector<SphereNode> visible;
            for (std::size_t i = 0; i < stream.size(); ++i)
                if (stream.tFar[i] > 0.0f)
                    visible.push_back(
                        {Vec3d(test::directionOf(stream, i)), 2.0 * std::numbers::pi / 1024.0});
            const std::vector<double> expected = test::sumMatrix(visible, bands, site.normal);
            std::vector<float> matrix(expected.size());
            baked.matrices.readRow(receiver, std::span(matrix));
            for (std::size_t e = 0; e < expected.size(); ++e)
                ASSERT_NEAR(matrix[e], expected[e], kFloatTolerance)
                    << "receiver " << receiver << ", element " << e;
        }
    }
}

TEST(TransferMatrices, TurnWithTheScene) {
    const Mat3d turn = rotationX(0.3) * rotationY(1.1) * rotationZ(-0.7);
    const Scene scene = makeRoomScene();
    const Scene turnedScene = transformScene(scene, turn, 3.0, Vec3f(10, 20, -5));
    const TransferMatrices baked = bakeTransferMatrices(scene, {.sampleCount = 4096});
    const TransferMatrices turned = bakeTransferMatrices(turnedScene, {.sampleCount = 4096});
    // Light from one direction, as far as five bands have it, scaled to an average of 1.
    std::vector<double> light(25);
    std::vector<double> turnedLight(25);
    const Vec3d source(0.48, 0.6, 0.64);
    evaluateSh(source, 5, light);
    evaluateSh(turn * source, 5, turnedLight);
    std::size_t vertex = 0;
    for (std::size_t mesh = 0; mesh < scene.meshes.size(); ++mesh)
        for (std::size_t i = 0; i < scene.meshes[mesh].normals.size(); ++i, ++vertex) {
            if (vertex % 7 != 0) continue;
            const Vec3f& normal = scene.meshes[mesh].normals[i];
            const Vec3f& turnedNormal = turnedScene.meshes[mesh].normals[i];
            const Vec3d direction = Vec3d(normal + Vec3f(0.3f, -0.2f, 0.1f)).normalized();
            EXPECT_NEAR(test::incidentRadiance(matrixOfVertex(turned, vertex), {5, 5}, turnedLight,
                                               intoLocalFrame(turn * direction, turnedNormal)),
                        test::incidentRadiance(matrixOfVertex(baked, vertex), {5, 5}, light,
                                               intoLocalFrame(direction, normal)),
                        kQmcTolerance)
                << "vertex " << vertex;
        }
}

TEST(TransferMatrices, OfAClosedBoxAreZeroHoweverNormalsLean) {  // A12, C11
    Mesh box = makeQuad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
    box.normals.assign(4, Vec3f(0.8f, 0.0f, 0.6f));
    const Scene scene = assembleScene({
        {box},
        {makeQuad({-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2})},
        {makeQuad({-1, 1, 0}, {1, 1, 0}, {1, 1, 2}, {-1, 1, 2})},
        {makeQuad({-1, -1, 0}, {-1, -1, 2}, {1, -1, 2}, {1, -1, 0})},
        {makeQuad({-1, -1, 0}, {-1, 1, 0}, {-1, 1, 2}, {-1, -1, 2})},
        {makeQuad({1, -1, 0}, {1, -1, 2}, {1, 1, 2}, {1, 1, 0})},
    });
    for (const float element : copyRows<float>(bakeTransferMatrices(scene).matrices))
        ASSERT_EQ(element, 0.0f);
}

TEST(TransferMatrices, AreTheSameForAnyNumberOfThreads) {  // C10
    const Scene scene = makeRoomScene();
    TransferMatrixStats stats;
    const TransferMatrices one =
        bakeTransferMatrices(scene, {.sampleCount = 64, .threadCount = 1}, &stats);
    const TransferMatrices three =
        bakeTransferMatrices(scene, {.sampleCount = 64, .threadCount = 3});
    EXPECT_TRUE(one.matrices == three.matrices);
    EXPECT_EQ(stats.receiverCount, one.matrices.rowCount());
    EXPECT_EQ(stats.counts.rayCount, 64 * stats.receiverCount);
    const TransferMatrices onDisk =
        bakeTransferMatrices(scene, {.sampleCount = 64, .storage = {.onDisk = true}});
    EXPECT_TRUE(one.matrices == onDisk.matrices);
    const TransferMatrices otherSeed = bakeTransferMatrices(scene, {.sampleCount = 64, .seed = 2});
    EXPECT_FALSE(one.matrices == otherSeed.matrices);
}

TEST(TransferMatrices, RefuseWhatTheyCannotHold) {
    const Scene scene = assembleScene({{makePatch({0, 0, 0}, Vec3f(0, 0, 1), 0.1f)}});
    EXPECT_EQ(
        bakeTransferMatrices(scene, {.incidentBandCount = 6, .bandCount = 5, .sampleCount = 16})
            .matrices.columnCount(),
        36u * 25u);
    for (const TransferMatrixOptions& options :
         {TransferMatrixOptions{.incidentBandCount = 6, .bandCount = 6},
          TransferMatrixOptions{.incidentBandCount = 0}, TransferMatrixOptions{.bandCount = 0},
          TransferMatrixOptions{.sampleCount = 15}}) {
        try {
            bakeTransferMatrices(scene, options);
            ADD_FAILURE() << "it was baked";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::invalidOption);
        }
    }
}

}  // namespace
}  // namespace prt
