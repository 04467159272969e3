#include "prt/trace/ray_scene.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "prt/base/random.h"
#include "prt/math/sampling.h"
#include "prt/scene/procedural.h"
#include "prt/trace/ray_offset.h"
#include "tests/support/scenes.h"

namespace prt {
namespace {

using test::assembleScene;
using test::makeQuad;
using test::transformScene;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

Scene makeUnitQuadScene() {
    return assembleScene({{makeQuad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0})}});
}

Vec3f randomDirection(RandomStream& random) {
    const float u = unitFloatFromBits(random.nextBits());
    return sampleUniformSphere(u, unitFloatFromBits(random.nextBits()));
}

TEST(RayTracer, SaysItsName) {
    EXPECT_TRUE(rayTracerName().starts_with("Embree 3.")) << rayTracerName();
}

TEST(RayScene, FindsDistanceCornersAndSide) {
    const Scene scene = makeUnitQuadScene();
    const RayScene rays(scene);
    const Hit front = rays.intersect({{0.75f, 0.25f, 2.0f}, {0.0f, 0.0f, -1.0f}});
    ASSERT_FALSE(front.escaped);
    EXPECT_FLOAT_EQ(front.t, 2.0f);
    EXPECT_EQ(front.point.mesh, 0u);
    EXPECT_EQ(front.point.triangle, 0u);
    EXPECT_NEAR(front.point.u, 0.5f, 1e-6f);   // weight of corner 1, at (1, 0)
    EXPECT_NEAR(front.point.v, 0.25f, 1e-6f);  // weight of corner 2, at (1, 1)
    EXPECT_FALSE(front.backFace);
    EXPECT_TRUE(rays.intersect({{0.5f, 0.25f, -2.0f}, {0.0f, 0.0f, 1.0f}}).backFace);
}

TEST(RayScene, DistanceIsInUnitsOfTheDirection) {
    const Scene scene = transformScene(makeUnitQuadScene(), Mat3d(), 1000.0, {5e4f, 0.0f, 0.0f});
    const RayScene rays(scene);
    const Hit hit = rays.intersect({{5.05e4f, 500.0f, 100.0f}, {0.0f, 0.0f, -10.0f}});
    ASSERT_FALSE(hit.escaped);
    EXPECT_NEAR(hit.t, 10.0f, 1e-4f);
}

TEST(RayScene, RaysEndAtTheirLength) {
    const Scene scene = makeUnitQuadScene();
    const RayScene rays(scene);
    const Vec3f down(0.0f, 0.0f, -1.0f);
    EXPECT_TRUE(rays.isOccluded({{0.5f, 0.4f, 1.0f}, down, 1.01f}));
    EXPECT_FALSE(rays.isOccluded({{0.5f, 0.4f, 1.0f}, down, 0.99f}));
    EXPECT_TRUE(rays.intersect({{0.5f, 0.4f, 1.0f}, down, 0.99f}).escaped);
}

TEST(RayScene, RaysThatAreNotFiniteEscape) {  // G5, F4
    const Scene scene = makeUnitQuadScene();
    const RayScene rays(scene);
    for (const float bad : {kNan, kInfinity, -kInfinity, 1e30f})
        for (int axis = 0; axis < 3; ++axis) {
            Ray ray{{0.5f, 0.4f, 1.0f}, {0.0f, 0.0f, -1.0f}};
            ray.origin[axis] = bad;
            EXPECT_TRUE(rays.intersect(ray).escaped);
            EXPECT_FALSE(rays.isOccluded(ray));
            ray = {{0.5f, 0.4f, 1.0f}, {0.0f, 0.0f, -1.0f}};
            ray.direction[axis] = bad;
            EXPECT_TRUE(rays.intersect(ray).escaped);
            EXPECT_FALSE(rays.isOccluded(ray));
        }
}

TEST(RayScene, StreamsAgreeWithSingleRays) {
    const Scene scene = assembleScene({{makeBowl(0.2f, 24)}});
    const RayScene rays(scene);
    const Vec3f origin(0.1f, -0.2f, -0.3f);
    RayStream stream(1024);
    stream.restart(rays.tracePoint(origin));
    RandomStream random(1, 0);
    std::vector<Ray> singles;
    for (std::size_t i = 0; i < stream.size(); ++i) {
        const Vec3f direction = randomDirection(random);
        stream.directionX[i] = direction.x;
        stream.directionY[i] = direction.y;
        stream.directionZ[i] = direction.z;
        singles.push_back({origin, direction});
    }
    EXPECT_EQ(rays.findOccluded(stream), 0u);
    std::vector<std::uint32_t> blocked;
    for (std::uint32_t i = 0; i < stream.size(); ++i) {
        EXPECT_EQ(stream.tFar[i] < 0.0f, rays.isOccluded(singles[i]));
        if (stream.tFar[i] < 0.0f) blocked.push_back(i);
    }
    EXPECT_GT(blocked.size(), 300u);
    EXPECT_LT(blocked.size(), 1000u);
    std::vector<Hit> hits(blocked.size());
    rays.findClosest(stream, blocked, hits);
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const Hit single = rays.intersect(singles[blocked[i]]);
        EXPECT_FALSE(hits[i].escaped);
        EXPECT_EQ(hits[i].point.triangle, single.point.triangle);
        EXPECT_EQ(hits[i].point.u, single.point.u);
        EXPECT_EQ(hits[i].t, single.t);
    }
}

TEST(RayScene, StreamsCountRaysThatAreNotFiniteAsBlocked) {
    const Scene scene = makeUnitQuadScene();
    const RayScene rays(scene);
    RayStream stream(16);
    stream.restart({0.0f, 0.0f, 0.1f});
    std::fill(stream.directionZ.begin(), stream.directionZ.end(), 1.0f);
    stream.directionX[3] = kNan;
    stream.originY[7] = kInfinity;
    EXPECT_EQ(rays.findOccluded(stream), 2u);
    for (std::size_t i = 0; i < stream.size(); ++i)
        EXPECT_EQ(stream.tFar[i] < 0.0f, i == 3 || i == 7) << i;
}

TEST(RayScene, AlphaMasksLetRaysThrough) {
    // A texture of two texels: the left half is cut out.
    Scene scene = makeUnitQuadScene();
    scene.meshes[0].uvSets[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    scene.images.emplace_back();
    scene.images[0].pixels = Rgba8Image(2, 1);
    scene.images[0].pixels.at(0, 0).alpha = 0;
    scene.materials[0].alphaMode = AlphaMode::mask;
    TextureUse texture;
    texture.filter = TextureFilter::nearest;
    scene.materials[0].baseColorTexture = texture;

    const RayScene rays(scene);
    const Vec3f down(0.0f, 0.0f, -1.0f);
    EXPECT_FALSE(rays.isOccluded({{0.25f, 0.4f, 1.0f}, down}));
    EXPECT_TRUE(rays.isOccluded({{0.75f, 0.4f, 1.0f}, down}));
    EXPECT_TRUE(rays.intersect({{0.25f, 0.4f, 1.0f}, down}).escaped);
    EXPECT_FALSE(rays.intersect({{0.75f, 0.4f, 1.0f}, down}).escaped);
}

TEST(RayScene, ClosedMeshesAreWatertightAnywhereAtAnySize) {  // G1
    for (const double scale : {1e-3, 1.0, 1e3})
        for (const float offset : {0.0f, 148376.0f}) {
            const Vec3f center = Vec3f(1.0f, -0.3f, 0.7f) * (offset * static_cast<float>(scale));
            const Scene scene = transformScene(assembleScene({{makeSphere({0, 0, 0}, 1.0f, 48)}}),
                                               Mat3d(), scale, center);
            const RayScene rays(scene);
            RandomStream random(2, 0);
            int leaks = 0;
            for (int i = 0; i < 20000; ++i)
                leaks += rays.isOccluded({center, randomDirection(random)}) ? 0 : 1;
            EXPECT_EQ(leaks, 0) << "scale " << scale << ", offset " << offset;
        }
}

// Rays at the edges of a closed mesh pass through neither of the triangles that meet there.
TEST(RayScene, EdgesAreWatertight) {  // G1
    for (const float offset : {0.0f, 148376.0f}) {
        const Vec3f center = Vec3f(1.0f, -0.3f, 0.7f) * offset;
        const Scene scene = transformScene(assembleScene({{makeSphere({0, 0, 0}, 1.0f, 48)}}),
                                           Mat3d(), 1.0, center);
        const RayScene rays(scene);
        const Mesh& mesh = scene.meshes[0];
        RandomStream random(3, 0);
        int leaks = 0;
        for (int i = 0; i < 100000; ++i) {
            const std::size_t triangle = random.nextBits() % mesh.triangleCount();
            const std::size_t k = random.nextBits() % 3;
            const Vec3f& a = mesh.positions[mesh.indices[3 * triangle + k]];
            const Vec3f& b = mesh.positions[mesh.indices[3 * triangle + (k + 1) % 3]];
            const float t = 0.001f + 0.998f * random.nextUnitFloat();
            leaks += rays.isOccluded({center, a + (b - a) * t - center}) ? 0 : 1;
        }
        EXPECT_EQ(leaks, 0) << "offset " << offset;
    }
}

TEST(RayScene, BitsThatAreNoRayHarmNothing) {  // G5
    const Scene scene = makeUnitQuadScene();
    const RayScene rays(scene);
    RandomStream random(8, 0);
    const auto randomFloat = [&] { return std::bit_cast<float>(random.nextBits()); };
    RayStream stream(256);
    std::size_t badCount = 0;
    for (int batch = 0; batch < 1'000'000 / 256; ++batch) {
        stream.restart({randomFloat(), randomFloat(), randomFloat()});
        for (std::size_t i = 0; i < stream.size(); ++i) {
            stream.directionX[i] = randomFloat();
            stream.directionY[i] = randomFloat();
            stream.directionZ[i] = randomFloat();
        }
        badCount += rays.findOccluded(stream);
        const Ray ray{{randomFloat(), randomFloat(), randomFloat()},
                      {randomFloat(), randomFloat(), randomFloat()},
                      randomFloat()};
        const Hit hit = rays.intersect(ray);
        EXPECT_TRUE(hit.escaped || std::isfinite(hit.t));
    }
    EXPECT_GT(badCount, 0u);
}

// A wall of a ten thousandth of the room's size, whose two sides the offset must not jump between.
TEST(RayOffset, DoesNotReachThroughAThinWall) {  // G4
    constexpr float kThickness = 1e-4f;
    const Scene scene =
        assembleScene({{makeBox({-1, -1, -1}, {1, 1, 1}, true, 4)},
                       {makeBox({-1 - kThickness, -1 - kThickness, -1 - kThickness},
                                {1 + kThickness, 1 + kThickness, 1 + kThickness}, false, 4)}});
    const RayScene rays(scene);
    const Mesh& inside = scene.meshes[0];
    RandomStream random(4, 0);
    RayStream stream(1024);
    std::size_t leaks = 0;
    for (std::size_t vertex = 0; vertex < inside.vertexCount(); ++vertex) {
        const Vec3f& normal = inside.normals[vertex];
        // A little way from the corners, where the bake itself knows a better way out.
        const Vec3f point = inside.positions[vertex] * 0.999f +
                            normal * normal.dot(inside.positions[vertex]) * 0.001f;
        stream.restart(offsetRayOrigin(rays.tracePoint(point), normal));
        for (std::size_t i = 0; i < stream.size(); ++i) {
            Vec3f direction = randomDirection(random);
            if (direction.dot(normal) < 0.0f) direction = -direction;
            stream.directionX[i] = direction.x;
            stream.directionY[i] = direction.y;
            stream.directionZ[i] = direction.z;
        }
        rays.findOccluded(stream);
        for (const float tFar : stream.tFar)
            leaks += tFar < 0.0f ? 0 : 1;
    }
    EXPECT_EQ(leaks, 0u);
}

TEST(RayOffset, RaysDoNotMeetTheSurfaceTheyStartOn) {  // G3
    for (const double scale : {1e-15, 1e-3, 1.0, 1e3, 1e15})
        for (const float offset : {0.0f, 100.0f, 1e4f}) {
            const Vec3f center = Vec3f(1.0f, -0.3f, 0.7f) * (offset * static_cast<float>(scale));
            const Scene scene = transformScene(assembleScene({{makeSphere({0, 0, 0}, 1.0f, 32)}}),
                                               Mat3d(), scale, center);
            const RayScene rays(scene);
            const Mesh& mesh = scene.meshes[0];
            RandomStream random(4, 0);
            RayStream stream(64);
            int selfHits = 0;
            for (std::size_t vertex = 0; vertex < mesh.vertexCount(); ++vertex) {
                stream.restart(
                    offsetRayOrigin(rays.tracePoint(mesh.positions[vertex]), mesh.normals[vertex]));
                for (std::size_t i = 0; i < stream.size(); ++i) {
                    Vec3f direction = randomDirection(random);
                    if (direction.dot(mesh.normals[vertex]) < 0.02f)
                        direction = mesh.normals[vertex];
                    stream.directionX[i] = direction.x;
                    stream.directionY[i] = direction.y;
                    stream.directionZ[i] = direction.z;
                }
                rays.findOccluded(stream);
                for (const float tFar : stream.tFar)
                    selfHits += tFar < 0.0f ? 1 : 0;
            }
            EXPECT_EQ(selfHits, 0) << "scale " << scale << ", offset " << offset;
        }
}

}  // namespace
}  // namespace prt
