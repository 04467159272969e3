#include "prt/scene/refine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "prt/base/error.h"
#include "prt/base/random.h"
#include "prt/scene/procedural.h"
#include "tests/support/mesh_measures.h"

namespace prt {
namespace {

constexpr double kShapeTolerance = 2e-6;  // relative: midpoints are rounded to floats

// A closed mesh whose vertices lie at random distances from the centre: edges of all lengths.
Mesh makeSpikyBall(std::uint64_t seed) {
    RandomStream random(seed, 0);
    Mesh mesh = makeSphere(Vec3f(0.0f), 1.0f, 12);
    for (Vec3f& position : mesh.positions)
        position *= 1.0f + 2.0f * random.nextUnitFloat();
    return mesh;
}

// The same triangles, each with vertices of its own, dealt out to three meshes.
std::vector<Mesh> splitApart(const Mesh& mesh) {
    std::vector<Mesh> parts(3);
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        Mesh& part = parts[i / 3 % 3];
        part.indices.push_back(static_cast<std::uint32_t>(part.positions.size()));
        part.positions.push_back(mesh.positions[mesh.indices[i]]);
        part.normals.push_back(mesh.normals[mesh.indices[i]]);
    }
    return parts;
}

double distanceToSegment(const Vec3d& point, const Vec3d& a, const Vec3d& b) {
    const double t = (point - a).dot(b - a) / (b - a).length2();
    return (point - (a + (b - a) * std::min(1.0, std::max(0.0, t)))).length();
}

TEST(Refine, NoEdgeIsLongerThanTheLimit) {
    for (const float limit : {3.0f, 0.7f, 0.21f}) {
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
            const Scene refined = refineEdges(
                sceneOf({makeSpikyBall(seed), makeFloor(2.0f, 0.0f, 1)}), {.maxEdgeLength = limit});
            EXPECT_LE(longestEdge(refined), static_cast<double>(limit) * (1.0 + kShapeTolerance));
        }
    }
}

TEST(Refine, KeepsAreaAndVolume) {
    const Scene scene =
        sceneOf({makeSpikyBall(4), makeBox(Vec3f(5.0f), Vec3f(6.0f, 8.0f, 7.0f), false, 1)});
    const Scene refined = refineEdges(scene, {.maxEdgeLength = 0.3f});
    EXPECT_GT(refined.triangleCount(), 4 * scene.triangleCount());
    EXPECT_NEAR(surfaceArea(refined) / surfaceArea(scene), 1.0, kShapeTolerance);
    EXPECT_NEAR(enclosedVolume(refined) / enclosedVolume(scene), 1.0, kShapeTolerance);
}

TEST(Refine, WhatIsClosedStaysClosedAcrossSeamsAndMeshes) {
    const Mesh ball = makeSpikyBall(5);
    const Scene refined = refineEdges(sceneOf(splitApart(ball)), {.maxEdgeLength = 0.3f});
    EXPECT_TRUE(findOpenEdges(refined).empty());
    EXPECT_TRUE(findOpenEdges(
                    refineEdges(sceneOf({makeBox(Vec3f(0.1f), Vec3f(0.7f, 3.0f, 2.0f), false, 1)}),
                                {.maxEdgeLength = 0.13f}))
                    .empty());
    // Cut together or apart, the same places are vertices.
    EXPECT_EQ(weldPositions(refined).vertexOfGroup.size(),
              refineEdges(sceneOf({ball}), {.maxEdgeLength = 0.3f}).vertexCount());
}

TEST(Refine, OpensNothingButTheRimThatWasOpen) {
    Mesh ball = makeSpikyBall(6);
    ball.indices.resize(ball.indices.size() / 6 * 3);
    const Scene scene = sceneOf(splitApart(ball));
    const auto rim = findOpenEdges(scene);
    const auto refinedRim = findOpenEdges(refineEdges(scene, {.maxEdgeLength = 0.4f}));
    ASSERT_GT(refinedRim.size(), rim.size());
    double rimLength = 0.0, refinedRimLength = 0.0;
    for (const auto& edge : rim)
        rimLength += Vec3d(edge[1] - edge[0]).length();
    for (const auto& edge : refinedRim) {
        refinedRimLength += Vec3d(edge[1] - edge[0]).length();
        double nearest = 1.0;
        for (const auto& [a, b] : rim) {
            nearest =
                std::min(nearest, std::max(distanceToSegment(Vec3d(edge[0]), Vec3d(a), Vec3d(b)),
                                           distanceToSegment(Vec3d(edge[1]), Vec3d(a), Vec3d(b))));
        }
        EXPECT_LT(nearest, kShapeTolerance);
    }
    EXPECT_NEAR(refinedRimLength / rimLength, 1.0, kShapeTolerance);
}

TEST(Refine, InterpolatesUvsAndColoursLinearlyAndKeepsNormalsUnit) {
    Mesh mesh = makeSpikyBall(7);
    const auto linear = [](const Vec3f& p) {
        return Vec2f(0.3f * p.x - 0.2f * p.y + 0.1f, 0.5f * p.z + 0.25f * p.x);
    };
    for (const Vec3f& p : mesh.positions) {
        mesh.uvSets[0].push_back(linear(p));
        mesh.uvSets[1].push_back(linear(p) * 2.0f);
        mesh.colors.emplace_back(p.x, p.y, p.z, 1.0f);
    }
    const Scene refined = refineEdges(sceneOf({mesh}), {.maxEdgeLength = 0.3f});
    const Mesh& result = refined.meshes[0];
    ASSERT_GT(result.vertexCount(), mesh.vertexCount());
    ASSERT_EQ(result.normals.size(), result.vertexCount());
    ASSERT_EQ(result.uvSets[0].size(), result.vertexCount());
    ASSERT_EQ(result.uvSets[1].size(), result.vertexCount());
    ASSERT_EQ(result.colors.size(), result.vertexCount());
    constexpr float kRounding = 2e-6f;  // some halvings of values up to 3
    for (std::size_t i = 0; i < result.vertexCount(); ++i) {
        const Vec3f& p = result.positions[i];
        EXPECT_LE((result.uvSets[0][i] - linear(p)).length(), kRounding);
        EXPECT_LE((result.uvSets[1][i] - linear(p) * 2.0f).length(), kRounding);
        EXPECT_LE((result.colors[i] - Vec4f(p.x, p.y, p.z, 1.0f)).length(), kRounding);
        EXPECT_NEAR(result.normals[i].length(), 1.0f, kRounding);
    }
}

TEST(Refine, LeavesMeshesWithShortEdgesAlone) {
    const Mesh fine = makeSphere(Vec3f(0.0f), 1.0f, 32);
    const Scene refined =
        refineEdges(sceneOf({fine, makeFloor(3.0f, 0.0f, 1)}), {.maxEdgeLength = 0.5f});
    EXPECT_EQ(refined.meshes[0].positions, fine.positions);
    EXPECT_EQ(refined.meshes[0].normals, fine.normals);
    EXPECT_EQ(refined.meshes[0].indices, fine.indices);
    EXPECT_GT(refined.meshes[1].vertexCount(), 4u);
}

TEST(Refine, MakesNoSlivers) {
    constexpr double kRoundingDegrees = 1e-3;
    const Scene box = sceneOf({makeBox(Vec3f(0.0f), Vec3f(2.0f, 3.0f, 1.0f), false, 1)});
    for (const float limit : {2.5f, 1.9f, 1.2f, 0.9f, 0.55f, 0.3f}) {
        const Scene refined = refineEdges(box, {.maxEdgeLength = limit});
        EXPECT_GT(smallestAngleDegrees(refined), smallestAngleDegrees(box) - kRoundingDegrees)
            << limit;
    }
}

TEST(Refine, ByDefaultAFloorGetsSomeThirtyCellsASide) {
    const Scene scene = sceneOf({makeFloor(8.0f, 0.0f, 1)});
    EXPECT_FLOAT_EQ(defaultMaxEdgeLength(scene), 8.0f * std::sqrt(2.0f) / 16.0f);
    const Scene refined = refineEdges(scene);
    EXPECT_LE(longestEdge(refined),
              static_cast<double>(defaultMaxEdgeLength(scene)) * (1.0 + kShapeTolerance));
    EXPECT_EQ(refined.vertexCount(), 33u * 33u);
}

TEST(Refine, ComesToAnEndWhereFloatsAreTooCoarse) {
    constexpr float kFar = 1e8f;  // where neighbouring floats are 8 apart
    Mesh mesh = makeFloor(8.0f, 0.0f, 1);
    for (Vec3f& position : mesh.positions)
        position.x += kFar;
    const Scene refined = refineEdges(sceneOf({mesh}), {.maxEdgeLength = 0.5f});
    EXPECT_GT(refined.vertexCount(), 4u);
    EXPECT_LT(refined.vertexCount(), 500u);
    EXPECT_NEAR(surfaceArea(refined), 256.0, 256.0 * kShapeTolerance);
}

TEST(Refine, RefusesToMakeMoreVerticesThanAllowed) {
    const Scene scene = sceneOf({makeFloor(1.0f, 0.0f, 1), makeFloor(1.0f, 1.0f, 1)});
    const Scene refined = refineEdges(scene, {.maxEdgeLength = 0.2f});
    EXPECT_NO_THROW(
        refineEdges(scene, {.maxEdgeLength = 0.2f, .maxVertexCount = refined.vertexCount()}));
    try {
        refineEdges(scene, {.maxEdgeLength = 0.2f, .maxVertexCount = refined.vertexCount() - 1});
        FAIL() << "made too many vertices";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::limitExceeded);
    }
}

TEST(Refine, RefusesALimitThatIsNoLength) {
    for (const float limit : {-1.0f, std::numeric_limits<float>::quiet_NaN()}) {
        try {
            refineEdges(sceneOf({makeFloor(1.0f, 0.0f, 1)}), {.maxEdgeLength = limit});
            FAIL() << limit;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::invalidOption);
        }
    }
}

TEST(Refine, AnEmptySceneStaysEmpty) {
    EXPECT_EQ(refineEdges(Scene{}).vertexCount(), 0u);
}

}  // namespace
}  // namespace prt
