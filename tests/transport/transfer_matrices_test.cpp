#include "prt/transport/transfer_matrices.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "prt/base/error.h"
#include "prt/base/random.h"
#include "prt/basis/zonal.h"
#include "prt/math/quadrature.h"
#include "prt/transport/bake.h"
#include "tests/support/scenes.h"
#include "tests/support/transfer_matrix_checks.h"

namespace prt {
namespace {

using test::assembleScene;
using test::BandCounts;
using test::intoLocalFrame;
using test::makePatch;
using test::makeQuad;
using test::makeRoomScene;
using test::transformScene;

// Products of two functions of up to √(9/4π), over visibility edges that 4096 scrambled net points
// tell to about N^(−3/4).
constexpr double kQmcTolerance = 2e-2;
// The same without an edge.
constexpr double kSmoothTolerance = 2e-3;
// Sums of a thousand numbers of about 1, in float.
constexpr double kFloatTolerance = 2e-5;

std::vector<float> matrixOfVertex(const TransferMatrices& baked, std::size_t vertex) {
    std::vector<float> matrix(baked.matrices.columnCount());
    baked.matrices.readRow(baked.receiverOfVertex[vertex], std::span(matrix));
    return matrix;
}

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
    const GatherKernels kernels = selectGatherKernels(detectIsa());
    const SamplePattern pattern(1024);
    for (const BandCounts& bands : {BandCounts{5, 5}, BandCounts{3, 6}}) {
        const TransferMatrices baked = bakeTransferMatrices(
            scene, {.incidentBandCount = bands.incident, .bandCount = bands.light, .seed = 3});
        ASSERT_EQ(baked.matrices.rowCount(), receivers.fronts.size());
        for (std::size_t receiver = 0; receiver < receivers.fronts.size(); receiver += 23) {
            const Receiver& site = receivers.fronts[receiver];
            RandomStream random(3, site.randomStream);
            const std::uint32_t seedX = random.nextBits();
            RayStream stream(1024);
            kernels.sampleUniformDirections(pattern, {seedX, random.nextBits(), site.normal},
                                            stream);
            stream.restart(site.origin);
            rays.findOccluded(stream);
            std::vector<SphereNode> visible;
            for (std::size_t i = 0; i < stream.size(); ++i)
                if (stream.tFar[i] > 0.0f)
                    visible.push_back({Vec3d(Vec3f(stream.directionX[i], stream.directionY[i],
                                                   stream.directionZ[i])),
                                       2.0 * std::numbers::pi / 1024.0});
            const std::vector<double> expected = test::sumMatrix(visible, bands, site.normal);
            std::vector<float> matrix(expected.size());
            baked.matrices.readRow(receiver, std::span(matrix));
            for (std::size_t e = 0; e < expected.size(); ++e)
                ASSERT_NEAR(matrix[e], expected[e], kFloatTolerance)
                    << "receiver " << receiver << ", element " << e;
        }
    }
}

/// The L2 norm over the hemisphere of what bands lose of cos θ / π.
double lostCosine(const std::vector<double>& lobe) {
    double square = 0.0;
    std::vector<double> basis(lobe.size() * lobe.size());
    for (const QuadratureNode& node : gaussLegendre(32)) {
        const double z = 0.5 * (node.position + 1.0);
        evaluateSh(Vec3d(std::sqrt(1.0 - z * z), 0.0, z), static_cast<int>(lobe.size()), basis);
        double rest = z * std::numbers::inv_pi;
        for (std::size_t l = 0; l < lobe.size(); ++l)
            rest -= lobe[l] * basis[l * (l + 1)];
        square += std::numbers::pi * node.weight * rest * rest;
    }
    return std::sqrt(square);
}

TEST(TransferMatrices, SeenByTheCosineAreTheDiffuseTransfer) {
    const Scene scene = makeRoomScene();
    constexpr BandCounts kBands = {7, 4};
    const TransferMatrices baked =
        bakeTransferMatrices(scene, {.incidentBandCount = 7, .bandCount = 4, .sampleCount = 4096});
    const TransferField field = bakeTransfer(
        scene, {.transport = Transport::shadowed, .bandCount = 4, .sampleCount = 4096});
    ASSERT_EQ(field.receiverOfVertex, baked.receiverOfVertex);

    std::vector<double> lobe = clampedCosineZonal(kBands.incident);
    for (double& coefficient : lobe)
        coefficient *= std::numbers::inv_pi;
    // By Cauchy and Schwarz, a coefficient differs by no more than what is lost, times ‖y_j‖ over
    // the hemisphere: √½, for y_j² is the same on both.
    const double tolerance = lostCosine(lobe) * std::sqrt(0.5) + 4e-3;
    EXPECT_LT(tolerance, 0.015);
    for (std::size_t vertex = 0; vertex < baked.receiverOfVertex.size(); vertex += 5) {
        const std::vector<float> matrix = matrixOfVertex(baked, vertex);
        const std::vector<float> transfer =
            transferVector(field, field.layers[0], field.receiverOfVertex[vertex], 0);
        for (std::size_t j = 0; j < kBands.columnCount(); ++j) {
            double sum = 0.0;
            for (std::size_t l = 0; l < lobe.size(); ++l)
                sum +=
                    lobe[l] * static_cast<double>(matrix[l * (l + 1) * kBands.columnCount() + j]);
            EXPECT_NEAR(sum, transfer[j], tolerance) << "vertex " << vertex << ", column " << j;
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
