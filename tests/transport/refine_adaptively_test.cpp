#include "prt/transport/refine_adaptively.h"

#include <gtest/gtest.h>

#include <cmath>

#include "prt/base/error.h"
#include "prt/scene/procedural.h"
#include "prt/scene/refine.h"
#include "prt/transport/bake.h"
#include "prt/transport/interpolation_error.h"
#include "tests/support/mesh_measures.h"

namespace prt {
namespace {

/// A coarse floor and a box that stands on it.
Scene makeBoxOnFloor() {
    return sceneOf(
        {makeFloor(4.0f, 0.0f, 8), makeBox({-0.7f, 0.0f, -0.55f}, {0.8f, 1.2f, 0.6f}, false, 2)});
}

AdaptiveRefineOptions quickOptions() {
    AdaptiveRefineOptions options;
    options.bandCount = 3;
    options.sampleCount = 256;
    options.maxError = 0.1f;
    options.minEdgeLength = 0.1f;
    return options;
}

double measureError(const Scene& scene) {
    const TransferField field =
        bakeTransfer(scene, {.transport = Transport::shadowed, .bandCount = 3});
    return measureInterpolationError(scene, field, {.pointCount = 3000, .sampleCount = 1024}).rms;
}

bool haveSameMeshes(const Scene& a, const Scene& b) {
    for (std::size_t i = 0; i < a.meshes.size(); ++i)
        if (a.meshes[i].positions != b.meshes[i].positions ||
            a.meshes[i].indices != b.meshes[i].indices)
            return false;
    return a.meshes.size() == b.meshes.size();
}

TEST(RefineAdaptively, SpendsAThirdOfTheVerticesThatEqualEdgesNeed) {
    const Scene scene = makeBoxOnFloor();
    const Scene adaptive = refineAdaptively(scene, quickOptions());
    const Scene uniform = refineEdges(scene, {.maxEdgeLength = 0.2f});
    EXPECT_LT(3 * adaptive.vertexCount(), uniform.vertexCount());
    EXPECT_LT(measureError(adaptive), measureError(uniform));
    EXPECT_LT(measureError(adaptive), 0.5 * measureError(scene));
}

TEST(RefineAdaptively, LeavesAloneWhatSeesTheWholeSky) {
    const Scene open = sceneOf({makeFloor(1.0f, 0.0f, 2)});
    AdaptiveRefineStats stats;
    EXPECT_TRUE(haveSameMeshes(refineAdaptively(open, quickOptions(), &stats), open));
    EXPECT_EQ(stats.passCount, 1);
    EXPECT_EQ(stats.testedEdgeCount, 16u);
    EXPECT_FALSE(stats.ranOutOfVertices);
}

TEST(RefineAdaptively, OpensNoCracksAndKeepsTheShape) {
    const Scene scene = makeBoxOnFloor();
    const Scene refined = refineAdaptively(scene, quickOptions());
    ASSERT_GT(refined.vertexCount(), scene.vertexCount());
    EXPECT_NEAR(surfaceArea(refined), surfaceArea(scene), 1e-5 * surfaceArea(scene));
    // The box is closed, and the rim of the floor is 32 m long whatever it is cut into.
    double rimLength = 0.0;
    for (const auto& [a, b] : findOpenEdges(refined))
        rimLength += (Vec3d(a) - Vec3d(b)).length();
    EXPECT_NEAR(rimLength, 32.0, 1e-5);
}

// Longest-edge refinement of right isosceles triangles gives right isosceles triangles; those of
// the box are right-angled with legs of up to 1 : 2.2.
TEST(RefineAdaptively, KeepsAnglesFromShrinking) {
    const Scene scene = makeBoxOnFloor();
    const Scene refined = refineAdaptively(scene, quickOptions());
    EXPECT_GT(smallestAngleDegrees(refined), 0.5 * smallestAngleDegrees(scene));
}

TEST(RefineAdaptively, IsTheSameForAnyNumberOfThreads) {  // C10
    AdaptiveRefineOptions options = quickOptions();
    options.threadCount = 1;
    const Scene one = refineAdaptively(makeBoxOnFloor(), options);
    options.threadCount = 3;
    EXPECT_TRUE(haveSameMeshes(refineAdaptively(makeBoxOnFloor(), options), one));
}

TEST(RefineAdaptively, StopsBeforeTheVerticesRunOut) {
    AdaptiveRefineOptions options = quickOptions();
    const std::size_t unlimited = refineAdaptively(makeBoxOnFloor(), options).vertexCount();
    options.maxVertexCount = (makeBoxOnFloor().vertexCount() + unlimited) / 2;
    AdaptiveRefineStats stats;
    const Scene refined = refineAdaptively(makeBoxOnFloor(), options, &stats);
    EXPECT_TRUE(stats.ranOutOfVertices);
    EXPECT_LE(refined.vertexCount(), options.maxVertexCount);
    EXPECT_GT(refined.vertexCount(), makeBoxOnFloor().vertexCount());
}

TEST(RefineAdaptively, HalvesNoEdgeUnderTwiceTheSmallest) {
    AdaptiveRefineOptions options = quickOptions();
    options.minEdgeLength = 4.0f;
    EXPECT_TRUE(haveSameMeshes(refineAdaptively(makeBoxOnFloor(), options), makeBoxOnFloor()));
}

TEST(RefineAdaptively, RefusesErrorsAndLengthsThatMakeNoSense) {
    AdaptiveRefineOptions options;
    options.maxError = 0.0f;
    EXPECT_THROW(refineAdaptively(makeBoxOnFloor(), options), Error);
    options = {};
    options.minEdgeLength = -1.0f;
    EXPECT_THROW(refineAdaptively(makeBoxOnFloor(), options), Error);
    options = {};
    options.sampleCount = -1;
    EXPECT_THROW(refineAdaptively(makeBoxOnFloor(), options), Error);
}

TEST(InterpolationError, OfAnOpenPlaneIsNoise) {
    const Scene open = sceneOf({makeFloor(1.0f, 0.0f, 2)});
    const TransferField field = bakeTransfer(open, {.transport = Transport::shadowed});
    EXPECT_LT(measureInterpolationError(open, field, {.pointCount = 200}).rms, 0.005);
}

TEST(InterpolationError, OfDarkTransferUnderAnOpenSkyIsOne) {
    const Scene open = sceneOf({makeFloor(1.0f, 0.0f, 2)});
    TransferField field = bakeTransfer(open, {.transport = Transport::shadowed});
    field.layers[0].coefficients =
        CoefficientTable(field.receiverCount, coefficientsPerReceiver(5, 1), sizeof(float));
    const InterpolationError error = measureInterpolationError(open, field, {.pointCount = 200});
    EXPECT_NEAR(error.rms, 1.0, 0.005);
    EXPECT_NEAR(error.percentile99, 1.0, 0.005);
}

// The transfer of two of a square floor’s corners is halved, on one side: over the floor the
// error goes linearly from ½ to 0.
TEST(InterpolationError, IsLinearInTheTriangle) {
    const Scene open = sceneOf({makeFloor(1.0f, 0.0f, 1)});
    TransferField field = bakeTransfer(open, {.transport = Transport::shadowed});
    CoefficientTable& coefficients = field.layers[0].coefficients;
    std::vector<float> row(coefficients.columnCount());
    for (std::size_t vertex = 0; vertex < 4; ++vertex) {
        if (open.meshes[0].positions[vertex].x >= 0.0f) continue;
        coefficients.readRow(field.receiverOfVertex[vertex], std::span(row));
        for (float& value : row)
            value *= 0.5f;
        coefficients.writeRows(field.receiverOfVertex[vertex], std::span<const float>(row));
    }
    const InterpolationError error = measureInterpolationError(open, field, {.pointCount = 2000});
    EXPECT_NEAR(error.rms, 0.5 / std::sqrt(3.0), 0.005);  // of a ramp from ½ to 0
    EXPECT_NEAR(error.percentile99, 0.495, 0.005);
}

}  // namespace
}  // namespace prt
