#include "prt/scene/normals.h"

#include <gtest/gtest.h>

#include <cmath>

#include "prt/scene/procedural.h"
#include "tests/support/mesh_measures.h"

namespace prt {
namespace {

constexpr float kRounding = 1.2e-7f;  // one unit in the last place of a coordinate near 1

// The cube [-1, 1]³ with eight vertices; bit i of `diagonals` says
// along which diagonal face i is cut.
Mesh makeCube(unsigned diagonals) {
    constexpr std::uint32_t kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                            {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    Mesh mesh;
    for (int i = 0; i < 8; ++i) {
        mesh.positions.emplace_back((i & 1) ? 1.0f : -1.0f, (i & 2) ? 1.0f : -1.0f,
                                    (i & 4) ? 1.0f : -1.0f);
    }
    for (unsigned face = 0; face < 6; ++face) {
        const unsigned turn = (diagonals >> face) & 1u;
        const auto corner = [&](unsigned i) { return kFaces[face][(i + turn) % 4]; };
        mesh.indices.insert(mesh.indices.end(),
                            {corner(0), corner(1), corner(2), corner(0), corner(2), corner(3)});
    }
    return mesh;
}

TEST(Normals, AtACubesCornersPointAlongTheDiagonalsHoweverFacesAreCut) {
    for (unsigned diagonals = 0; diagonals < 64; ++diagonals) {
        Mesh mesh = makeCube(diagonals);
        ASSERT_DOUBLE_EQ(enclosedVolume(sceneOf({mesh})), 8.0);
        computeMissingNormals(mesh);
        for (std::size_t i = 0; i < 8; ++i) {
            const Vec3f expected = mesh.positions[i] / std::sqrt(3.0f);
            EXPECT_LE((mesh.normals[i] - expected).length(), kRounding) << diagonals;
        }
    }
}

TEST(Normals, OfASphereConvergeToItsOwn) {
    double previousError = 1.0;
    for (const int segmentCount : {16, 32, 64}) {
        Mesh mesh = makeSphere(Vec3f(0.0f), 1.0f, segmentCount);
        const std::vector<Vec3f> exact = mesh.normals;
        mesh.normals.clear();
        computeMissingNormals(mesh);
        double error = 0.0;
        for (std::size_t i = 0; i < exact.size(); ++i) {
            error = std::max(error, static_cast<double>((mesh.normals[i] - exact[i]).length()));
        }
        EXPECT_LT(error, 0.5 * previousError);
        previousError = error;
    }
    EXPECT_LT(previousError, 2e-3);
}

TEST(Normals, VerticesSplitByAUvSeamShareTheirNormal) {
    const Mesh cube = makeCube(0);
    Mesh split;
    for (const std::uint32_t index : cube.indices) {
        split.indices.push_back(static_cast<std::uint32_t>(split.positions.size()));
        split.positions.push_back(cube.positions[index]);
        // A zero of the other sign is the same place.
        if (split.positions.back().x == 0.0f) split.positions.back().x = -0.0f;
    }
    computeMissingNormals(split);
    for (std::size_t i = 0; i < split.vertexCount(); ++i) {
        EXPECT_LE((split.normals[i] - split.positions[i] / std::sqrt(3.0f)).length(), kRounding);
    }
}

TEST(Normals, ThatExistAreKept) {
    Mesh mesh = makeCube(0);
    mesh.normals.assign(8, Vec3f(0.0f, 0.0f, 1.0f));
    const std::vector<Vec3f> before = mesh.normals;
    computeMissingNormals(mesh);
    EXPECT_EQ(mesh.normals, before);
}

TEST(Normals, AreUpWhereNoTriangleHasAnArea) {
    Mesh mesh;
    mesh.positions = {Vec3f(0.0f), Vec3f(1.0f), Vec3f(2.0f), Vec3f(7.0f)};
    mesh.indices = {0, 1, 2, 0, 0, 1};
    computeMissingNormals(mesh);
    EXPECT_EQ(mesh.normals, std::vector<Vec3f>(4, Vec3f(0.0f, 1.0f, 0.0f)));
    EXPECT_EQ(triangleNormal(mesh.positions[0], mesh.positions[1], mesh.positions[2]), Vec3f(0.0f));
}

TEST(Normals, OfTrianglesAreUnitAtAnyScaleAndFollowTheWinding) {
    for (const float scale : {1e-30f, 1.0f, 1e30f}) {
        const Vec3f a(0.0f), b(scale, 0.0f, 0.0f), c(0.0f, scale, 0.0f);
        EXPECT_EQ(triangleNormal(a, b, c), Vec3f(0.0f, 0.0f, 1.0f));
        EXPECT_EQ(triangleNormal(a, c, b), Vec3f(0.0f, 0.0f, -1.0f));
    }
}

}  // namespace
}  // namespace prt
