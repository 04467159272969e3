#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "prt/scene/normals.h"
#include "prt/scene/procedural.h"
#include "tests/support/mesh_measures.h"

namespace prt {
namespace {

constexpr float kMetresPerUnit = 0.31084499f;  // of Newell's data: it is 6.43407512 units wide
constexpr float kRounding = 5e-7f;             // of coordinates up to 1.1 m

float distanceToNearestVertex(const Mesh& mesh, const Vec3f& point) {
    float nearest = 1e9f;
    for (const Vec3f& position : mesh.positions)
        nearest = std::min(nearest, (position - point).length());
    return nearest;
}

TEST(Teapot, StandsOnTheFloorTwoMetresWide) {
    constexpr float kTessellation = 1e-4f;  // the spout's tip lies between two vertices
    const Bounds bounds = computeBounds(sceneOf({makeTeapot(32)}));
    EXPECT_NEAR(bounds.high.x - bounds.low.x, 2.0f, kTessellation);
    EXPECT_NEAR(bounds.low.x, -3.0f * kMetresPerUnit, kRounding);
    EXPECT_NEAR(bounds.low.y, 0.0f, kRounding);
    EXPECT_NEAR(bounds.high.y, 3.15f * kMetresPerUnit, kRounding);
    EXPECT_NEAR(bounds.high.z, 2.0f * kMetresPerUnit, kTessellation);
    EXPECT_NEAR(bounds.low.z, -2.0f * kMetresPerUnit, kTessellation);
}

// Corners of patches are control points, which are published: index in the 306 points of
// [Newell75], from 1.
TEST(Teapot, ThePublishedPatchCornersLieOnIt) {
    struct Corner {
        int index;
        Vec3f point;  // Newell's axes, z up
    };
    const Corner kCorners[] = {
        {1, {1.4f, 0.0f, 2.4f}},     {16, {0.0f, -1.5f, 2.4f}},    {60, {0.0f, -2.0f, 0.9f}},
        {93, {1.5f, 0.0f, 0.15f}},   {121, {-1.6f, 0.0f, 2.025f}}, {124, {-1.5f, 0.0f, 2.25f}},
        {133, {-2.7f, 0.0f, 1.8f}},  {136, {-3.0f, 0.0f, 1.8f}},   {155, {-1.9f, 0.0f, 0.6f}},
        {162, {1.7f, 0.0f, 1.425f}}, {165, {1.7f, 0.0f, 0.6f}},    {174, {2.7f, 0.0f, 2.4f}},
        {177, {3.3f, 0.0f, 2.4f}},   {194, {2.8f, 0.0f, 2.4f}},    {197, {3.2f, 0.0f, 2.4f}},
        {204, {0.0f, 0.0f, 3.15f}},  {212, {0.2f, 0.0f, 2.7f}},    {243, {1.3f, 0.0f, 2.4f}},
        {270, {0.0f, 0.0f, 0.0f}}};
    const Mesh teapot = makeTeapot(2);
    for (const auto& [index, point] : kCorners) {
        const Vec3f inMetres = Vec3f(point.x, point.z, -point.y) * kMetresPerUnit;
        EXPECT_LE(distanceToNearestVertex(teapot, inMetres), kRounding)
            << "control point " << index;
    }
}

// Control points of one patch in Newell's axes, z up.
using Patch = std::array<std::array<Vec3f, 4>, 4>;

// The middle of a patch mixes all its sixteen control points: (1, 3, 3, 1) / 8 both ways.
Vec3f middleOf(const Patch& patch) {
    constexpr float kWeights[] = {0.125f, 0.375f, 0.375f, 0.125f};
    Vec3f middle(0.0f);
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) {
            middle += patch[i][j] * (kWeights[i] * kWeights[j]);
        }
    }
    return middle;
}

// One quarter or half of each part, as published in [Newell75]; the others are its mirror images.
TEST(Teapot, TheMiddlesOfPatchesMixTheirPublishedControlPoints) {
    const std::vector<Patch> kPatches{
        // rim
        {{{{{1.4f, 0.0f, 2.4f}, {1.4f, -0.784f, 2.4f}, {0.784f, -1.4f, 2.4f}, {0.0f, -1.4f, 2.4f}}},
          {{{1.3375f, 0.0f, 2.53125f},
            {1.3375f, -0.749f, 2.53125f},
            {0.749f, -1.3375f, 2.53125f},
            {0.0f, -1.3375f, 2.53125f}}},
          {{{1.4375f, 0.0f, 2.53125f},
            {1.4375f, -0.805f, 2.53125f},
            {0.805f, -1.4375f, 2.53125f},
            {0.0f, -1.4375f, 2.53125f}}},
          {{{1.5f, 0.0f, 2.4f}, {1.5f, -0.84f, 2.4f}, {0.84f, -1.5f, 2.4f}, {0.0f, -1.5f, 2.4f}}}}},
        // upper body
        {{{{{1.5f, 0.0f, 2.4f}, {1.5f, -0.84f, 2.4f}, {0.84f, -1.5f, 2.4f}, {0.0f, -1.5f, 2.4f}}},
          {{{1.75f, 0.0f, 1.875f},
            {1.75f, -0.98f, 1.875f},
            {0.98f, -1.75f, 1.875f},
            {0.0f, -1.75f, 1.875f}}},
          {{{2.0f, 0.0f, 1.35f},
            {2.0f, -1.12f, 1.35f},
            {1.12f, -2.0f, 1.35f},
            {0.0f, -2.0f, 1.35f}}},
          {{{2.0f, 0.0f, 0.9f}, {2.0f, -1.12f, 0.9f}, {1.12f, -2.0f, 0.9f}, {0.0f, -2.0f, 0.9f}}}}},
        // lower body
        {{{{{2.0f, 0.0f, 0.9f}, {2.0f, -1.12f, 0.9f}, {1.12f, -2.0f, 0.9f}, {0.0f, -2.0f, 0.9f}}},
          {{{2.0f, 0.0f, 0.45f},
            {2.0f, -1.12f, 0.45f},
            {1.12f, -2.0f, 0.45f},
            {0.0f, -2.0f, 0.45f}}},
          {{{1.5f, 0.0f, 0.225f},
            {1.5f, -0.84f, 0.225f},
            {0.84f, -1.5f, 0.225f},
            {0.0f, -1.5f, 0.225f}}},
          {{{1.5f, 0.0f, 0.15f},
            {1.5f, -0.84f, 0.15f},
            {0.84f, -1.5f, 0.15f},
            {0.0f, -1.5f, 0.15f}}}}},
        // bottom
        {{{{{1.5f, 0.0f, 0.15f},
            {1.5f, -0.84f, 0.15f},
            {0.84f, -1.5f, 0.15f},
            {0.0f, -1.5f, 0.15f}}},
          {{{1.5f, 0.0f, 0.075f},
            {1.5f, -0.84f, 0.075f},
            {0.84f, -1.5f, 0.075f},
            {0.0f, -1.5f, 0.075f}}},
          {{{1.425f, 0.0f, 0.0f},
            {1.425f, -0.798f, 0.0f},
            {0.798f, -1.425f, 0.0f},
            {0.0f, -1.425f, 0.0f}}},
          {{{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}}}}},
        // knob
        {{{{{0.0f, 0.0f, 3.15f}, {0.0f, 0.0f, 3.15f}, {0.0f, 0.0f, 3.15f}, {0.0f, 0.0f, 3.15f}}},
          {{{0.8f, 0.0f, 3.15f},
            {0.8f, -0.45f, 3.15f},
            {0.45f, -0.8f, 3.15f},
            {0.0f, -0.8f, 3.15f}}},
          {{{0.0f, 0.0f, 2.85f}, {0.0f, 0.0f, 2.85f}, {0.0f, 0.0f, 2.85f}, {0.0f, 0.0f, 2.85f}}},
          {{{0.2f, 0.0f, 2.7f},
            {0.2f, -0.112f, 2.7f},
            {0.112f, -0.2f, 2.7f},
            {0.0f, -0.2f, 2.7f}}}}},
        // lid
        {{{{{0.2f, 0.0f, 2.7f}, {0.2f, -0.112f, 2.7f}, {0.112f, -0.2f, 2.7f}, {0.0f, -0.2f, 2.7f}}},
          {{{0.4f, 0.0f, 2.55f},
            {0.4f, -0.224f, 2.55f},
            {0.224f, -0.4f, 2.55f},
            {0.0f, -0.4f, 2.55f}}},
          {{{1.3f, 0.0f, 2.55f},
            {1.3f, -0.728f, 2.55f},
            {0.728f, -1.3f, 2.55f},
            {0.0f, -1.3f, 2.55f}}},
          {{{1.3f, 0.0f, 2.4f},
            {1.3f, -0.728f, 2.4f},
            {0.728f, -1.3f, 2.4f},
            {0.0f, -1.3f, 2.4f}}}}},
        // upper handle
        {{{{{-1.6f, 0.0f, 2.025f},
            {-1.6f, -0.3f, 2.025f},
            {-1.5f, -0.3f, 2.25f},
            {-1.5f, 0.0f, 2.25f}}},
          {{{-2.3f, 0.0f, 2.025f},
            {-2.3f, -0.3f, 2.025f},
            {-2.5f, -0.3f, 2.25f},
            {-2.5f, 0.0f, 2.25f}}},
          {{{-2.7f, 0.0f, 2.025f},
            {-2.7f, -0.3f, 2.025f},
            {-3.0f, -0.3f, 2.25f},
            {-3.0f, 0.0f, 2.25f}}},
          {{{-2.7f, 0.0f, 1.8f},
            {-2.7f, -0.3f, 1.8f},
            {-3.0f, -0.3f, 1.8f},
            {-3.0f, 0.0f, 1.8f}}}}},
        // lower handle
        {{{{{-2.7f, 0.0f, 1.8f}, {-2.7f, -0.3f, 1.8f}, {-3.0f, -0.3f, 1.8f}, {-3.0f, 0.0f, 1.8f}}},
          {{{-2.7f, 0.0f, 1.575f},
            {-2.7f, -0.3f, 1.575f},
            {-3.0f, -0.3f, 1.35f},
            {-3.0f, 0.0f, 1.35f}}},
          {{{-2.5f, 0.0f, 1.125f},
            {-2.5f, -0.3f, 1.125f},
            {-2.65f, -0.3f, 0.9375f},
            {-2.65f, 0.0f, 0.9375f}}},
          {{{-2.0f, 0.0f, 0.9f},
            {-2.0f, -0.3f, 0.9f},
            {-1.9f, -0.3f, 0.6f},
            {-1.9f, 0.0f, 0.6f}}}}},
        // spout
        {{{{{1.7f, 0.0f, 1.425f},
            {1.7f, -0.66f, 1.425f},
            {1.7f, -0.66f, 0.6f},
            {1.7f, 0.0f, 0.6f}}},
          {{{2.6f, 0.0f, 1.425f},
            {2.6f, -0.66f, 1.425f},
            {3.1f, -0.66f, 0.825f},
            {3.1f, 0.0f, 0.825f}}},
          {{{2.3f, 0.0f, 2.1f},
            {2.3f, -0.25f, 2.1f},
            {2.4f, -0.25f, 2.025f},
            {2.4f, 0.0f, 2.025f}}},
          {{{2.7f, 0.0f, 2.4f}, {2.7f, -0.25f, 2.4f}, {3.3f, -0.25f, 2.4f}, {3.3f, 0.0f, 2.4f}}}}},
        // spout tip
        {{{{{2.7f, 0.0f, 2.4f}, {2.7f, -0.25f, 2.4f}, {3.3f, -0.25f, 2.4f}, {3.3f, 0.0f, 2.4f}}},
          {{{2.8f, 0.0f, 2.475f},
            {2.8f, -0.25f, 2.475f},
            {3.525f, -0.25f, 2.49375f},
            {3.525f, 0.0f, 2.49375f}}},
          {{{2.9f, 0.0f, 2.475f},
            {2.9f, -0.15f, 2.475f},
            {3.45f, -0.15f, 2.5125f},
            {3.45f, 0.0f, 2.5125f}}},
          {{{2.8f, 0.0f, 2.4f}, {2.8f, -0.15f, 2.4f}, {3.2f, -0.15f, 2.4f}, {3.2f, 0.0f, 2.4f}}}}}};
    const Mesh teapot = makeTeapot(2);
    for (std::size_t i = 0; i < kPatches.size(); ++i) {
        const Vec3f middle = middleOf(kPatches[i]);
        for (const float side : {1.0f, -1.0f}) {
            const Vec3f inMetres = Vec3f(middle.x, middle.z, side * middle.y) * kMetresPerUnit;
            EXPECT_LE(distanceToNearestVertex(teapot, inMetres), kRounding) << "patch " << i;
        }
    }
}

TEST(Teapot, PatchesJoinWithoutACrack) {
    for (const int cellCount : {2, 3, 10}) {
        const Scene scene = sceneOf({makeTeapot(cellCount)});
        EXPECT_EQ(scene.triangleCount(),
                  static_cast<std::size_t>(64 * cellCount * cellCount - 8 * cellCount));
        // Open are only the rim and the lid's lip, four patches round, and both
        // ends of handle and spout, two.
        EXPECT_EQ(findOpenEdges(scene).size(),
                  static_cast<std::size_t>((4 + 4 + 2 * 2 + 2 * 2) * cellCount));
    }
}

TEST(Teapot, IsSymmetric) {
    const Mesh teapot = makeTeapot(5);
    for (const Vec3f& position : teapot.positions) {
        EXPECT_LE(distanceToNearestVertex(teapot, Vec3f(position.x, position.y, -position.z)),
                  kRounding);
    }
}

TEST(Teapot, NormalsAreUnitFaceOutwardsAndAreThoseOfTheFineMesh) {
    constexpr float kSmoothness =
        0.96f;  // cosine; the worst are the open rims, where the mesh has one side only
    Mesh teapot = makeTeapot(24);
    EXPECT_EQ(countFlippedTriangles(sceneOf({teapot})), 0u);
    EXPECT_GT(enclosedVolume(sceneOf({teapot})), 0.0);
    Mesh measured = teapot;
    measured.normals.clear();
    computeMissingNormals(measured);
    // The handle ends in a vertex of the body, where the mesh has no one normal.
    const Vec3f handleEnd = Vec3f(-2.0f, 0.9f, 0.0f) * kMetresPerUnit;
    for (std::size_t i = 0; i < teapot.vertexCount(); ++i) {
        EXPECT_NEAR(teapot.normals[i].length(), 1.0f, kRounding);
        if ((teapot.positions[i] - handleEnd).length() < kRounding) continue;
        EXPECT_GT(teapot.normals[i].dot(measured.normals[i]), kSmoothness) << teapot.positions[i];
    }
}

}  // namespace
}  // namespace prt
