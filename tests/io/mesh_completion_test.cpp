#include "prt/io/mesh_completion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace prt {
namespace {

// Areas of a few dozen float corners, summed.
constexpr float kAreaTolerance = 1e-5f;

Vec3f triangleArea(std::span<const Vec3f> corners, std::span<const std::uint32_t> triangle) {
    const Vec3f& a = corners[triangle[0]];
    return (corners[triangle[1]] - a).cross(corners[triangle[2]] - a) * 0.5f;
}

/// The triangles of a simple polygon in the plane z = 0, counter-clockwise, tile it: none is turned
/// over and their areas add up to the shoelace formula's.
void expectTiled(const std::vector<Vec3f>& corners) {
    std::vector<std::uint32_t> triangles;
    triangulatePolygon(corners, triangles);
    ASSERT_EQ(triangles.size(), 3 * (corners.size() - 2));
    float sum = 0.0f, shoelace = 0.0f;
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
        const float area = triangleArea(corners, std::span(triangles).subspan(i, 3)).z;
        EXPECT_GE(area, -kAreaTolerance);
        sum += area;
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3f &a = corners[i], &b = corners[(i + 1) % corners.size()];
        shoelace += 0.5f * (a.x * b.y - b.x * a.y);
    }
    EXPECT_NEAR(sum, shoelace, kAreaTolerance);
}

TEST(TriangulatePolygon, ConvexPolygonsAreFans) {
    std::vector<std::uint32_t> triangles;
    triangulatePolygon(std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, triangles);
    EXPECT_EQ(triangles, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
}

TEST(TriangulatePolygon, ConcavePolygonsAreTiled) {
    expectTiled({{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {1, 1, 0}});  // arrow head
    expectTiled({{0, 0, 0},
                 {3, 0, 0},
                 {3, 3, 0},
                 {2, 3, 0},
                 {2, 1, 0},
                 {1, 1, 0},
                 {1, 3, 0},
                 {0, 3, 0}});  // U
    std::vector<Vec3f> star;
    for (int i = 0; i < 40; ++i) {
        const float angle = float(i) * std::numbers::pi_v<float> / 20.0f,
                    radius = i % 2 ? 0.3f : 1.0f;
        star.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0f);
    }
    expectTiled(star);
    std::rotate(star.begin(), star.begin() + 1, star.end());
    expectTiled(star);
}

TEST(TriangulatePolygon, AnyCornersGiveTriangles) {
    std::mt19937 random(3);
    std::uniform_int_distribution<int> coordinate(-2, 2);
    for (int i = 0; i < 500; ++i) {
        std::vector<Vec3f> corners(std::size_t(3 + i % 20));
        for (Vec3f& corner : corners)
            corner = Vec3f(float(coordinate(random)), float(coordinate(random)),
                           float(coordinate(random)));
        std::vector<std::uint32_t> triangles;
        triangulatePolygon(corners, triangles);
        EXPECT_EQ(triangles.size(), 3 * (corners.size() - 2));
        for (const std::uint32_t corner : triangles)
            EXPECT_LT(corner, corners.size());
    }
}

TEST(TriangulatePolygon, HugeConcavePolygonsTakeNoTime) {
    std::vector<Vec3f> comb;
    for (int i = 0; i < 100000; ++i)
        comb.emplace_back(float(i), i % 2 ? 1.0f : 0.0f, 0.0f);
    comb.emplace_back(50000.0f, 100.0f, 0.0f);
    std::vector<std::uint32_t> triangles;
    triangulatePolygon(comb, triangles);
    EXPECT_EQ(triangles.size(), 3 * (comb.size() - 2));
}

TEST(CompleteNormals, BadNormalsComeFromTheTriangles) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}};
    mesh.indices = {0, 1, 2};
    const float nan = std::nanf("");
    mesh.normals = {{0, 3, 0}, {0, 0, 0}, {nan, 0, 0}, {1e-30f, 0, 0}};
    EXPECT_EQ(completeNormals(mesh), 2u);
    EXPECT_EQ(mesh.normals[0], Vec3f(0, 1, 0));
    EXPECT_EQ(mesh.normals[1], Vec3f(0, 0, 1));
    EXPECT_EQ(mesh.normals[2], Vec3f(0, 0, 1));
    EXPECT_EQ(mesh.normals[3], Vec3f(1, 0, 0));
}

TEST(CompleteNormals, AllAreComputedWhereThereAreNone) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.indices = {0, 1, 2};
    EXPECT_EQ(completeNormals(mesh), 0u);
    ASSERT_EQ(mesh.normals.size(), 3u);
    for (const Vec3f& normal : mesh.normals)
        EXPECT_EQ(normal, Vec3f(0, 0, 1));
}

}  // namespace
}  // namespace prt
