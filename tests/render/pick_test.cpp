#include "prt/render/pick.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "prt/base/error.h"
#include "prt/base/random.h"
#include "prt/scene/framing.h"
#include "tests/support/scenes.h"

namespace prt {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 200;

/// Of places in float, beside a scene of some metres.
constexpr double kRounding = 1e-4;

struct Seen {
    double distance = std::numeric_limits<double>::infinity();
    std::size_t vertex = 0;
};

/// Where a ray meets a triangle: its distance, and the weights of the corners b and c.
struct Crossing {
    double distance, u, v;
    bool fromBehind;
};

std::optional<Crossing> crossTriangle(const Vec3d& eye, const Vec3d& direction, const Vec3d& a,
                                      const Vec3d& b, const Vec3d& c) {
    const Vec3d normal = (b - a).cross(c - a);
    const double slope = normal.dot(direction);
    const double distance = normal.dot(a - eye) / slope;
    if (!(distance > 0.0)) return std::nullopt;
    const Vec3d point = eye + direction * distance;
    const double u = normal.dot((point - a).cross(c - a)) / normal.length2();
    const double v = normal.dot((b - a).cross(point - a)) / normal.length2();
    if (u < 0.0 || v < 0.0 || u + v > 1.0) return std::nullopt;
    return Crossing{distance, u, v, slope > 0.0};
}

bool isSeen(const Scene& scene, const SurfacePoint& point, bool fromBehind) {
    const Material& material = scene.materials[scene.meshes[point.mesh].material];
    if (fromBehind && !material.doubleSided) return false;
    return material.alphaMode != AlphaMode::mask ||
           evaluateBaseColor(scene, point).w >= material.alphaCutoff;
}

/// All triangles of a scene that stands in the world.
std::optional<Seen> searchAll(const Scene& scene, const Affine3d& worldFromObject,
                              const Camera& camera, double x, double y) {
    const double pixel =
        2.0 * std::tan(0.5 * static_cast<double>(camera.verticalFovRadians)) / kHeight;
    const Vec3d eye(camera.eye), forward(camera.forward), up(camera.up);
    const Vec3d direction = (forward + forward.cross(up) * ((x - 0.5 * kWidth) * pixel) +
                             up * ((0.5 * kHeight - y) * pixel))
                                .normalized();
    Seen nearest;
    std::size_t firstVertex = 0;
    for (std::size_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
        const std::vector<std::uint32_t>& indices = scene.meshes[mesh].indices;
        const auto placeCorner = [&](std::size_t i) {
            return transformPoint(worldFromObject, Vec3d(scene.meshes[mesh].positions[indices[i]]));
        };
        for (std::size_t i = 0; i < indices.size(); i += 3) {
            const Vec3d corners[] = {placeCorner(i), placeCorner(i + 1), placeCorner(i + 2)};
            const auto met = crossTriangle(eye, direction, corners[0], corners[1], corners[2]);
            if (!met || met->distance >= nearest.distance) continue;
            const SurfacePoint point{mesh, i / 3, static_cast<float>(met->u),
                                     static_cast<float>(met->v)};
            if (!isSeen(scene, point, met->fromBehind)) continue;
            const Vec3d place = eye + direction * met->distance;
            std::size_t corner = 0;
            for (const std::size_t other : {1u, 2u})
                if ((corners[other] - place).length() < (corners[corner] - place).length())
                    corner = other;
            nearest = {met->distance, firstVertex + indices[i + corner]};
        }
        firstVertex += scene.meshes[mesh].vertexCount();
    }
    if (std::isinf(nearest.distance)) return std::nullopt;
    return nearest;
}

/// A room, its sheet cut out here and there.
Scene makePiercedRoom() {
    Scene scene = test::makeFurnishedRoom();
    Rgba8Image texels(3, 3);
    for (int i = 0; i < 9; i += 2)
        texels.pixels[static_cast<std::size_t>(i)].alpha = 0;
    scene.images.push_back({"holes", "image/png", {}, std::move(texels)});
    scene.meshes[3].uvSets[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    Material& sheet = scene.materials[3];
    sheet.baseColorTexture = TextureUse{.filter = TextureFilter::nearest};
    sheet.alphaMode = AlphaMode::mask;
    return scene;
}

TEST(PickVertex, IsTheNearestCornerOfTheFirstOfAllTrianglesThatIsSeen) {
    const Scene scene = makePiercedRoom();
    const RayScene rays(scene);
    RandomStream random(11, 2);
    int seenCount = 0, missedCount = 0;
    for (int view = 0; view < 60; ++view) {
        const auto draw = [&](double low, double high) {
            return low + (high - low) * random.nextUnitDouble();
        };
        const Affine3d worldFromObject{rotationY(draw(0, 6)) * rotationX(draw(0, 6)),
                                       {draw(-2, 2), draw(-2, 2), draw(-2, 2)}};
        const Vec3d target =
            transformPoint(worldFromObject, {draw(-1, 1), draw(-1, 1), draw(0, 2)});
        const Vec3d eye = target + Vec3d(draw(-2, 2), draw(-2, 2), draw(-2, 2));
        const Camera camera = lookAt(Vec3f(eye), Vec3f(target), 1.2f);
        for (int i = 0; i < 50; ++i) {
            const double x = draw(0, kWidth), y = draw(0, kHeight);
            const auto expected = searchAll(scene, worldFromObject, camera, x, y);
            const auto picked =
                pickVertex(scene, rays, camera, {kWidth, kHeight, x, y}, worldFromObject);
            ASSERT_EQ(picked.has_value(), expected.has_value()) << view << ": " << x << ", " << y;
            (picked ? seenCount : missedCount) += 1;
            if (!picked) continue;
            EXPECT_EQ(picked->vertex, expected->vertex) << view << ": " << x << ", " << y;
            EXPECT_NEAR(static_cast<double>(picked->distance), expected->distance, kRounding);
        }
    }
    EXPECT_GE(seenCount, 900);
    EXPECT_GE(missedCount, 1000);
}

TEST(PickVertex, OutsideThePictureThereIsNothing) {
    const Scene scene = test::makeFurnishedRoom();
    const RayScene rays(scene);
    const Camera camera = lookAt({0.0f, -4.0f, 1.0f}, {0.0f, 0.0f, 0.8f}, 0.4f);
    const auto isPicked = [&](double x, double y) {
        return pickVertex(scene, rays, camera, {kWidth, kHeight, x, y}).has_value();
    };
    EXPECT_TRUE(isPicked(160.5, 100.5));
    EXPECT_TRUE(isPicked(160.5, 0.5));
    EXPECT_FALSE(isPicked(160.5, -0.5));
    EXPECT_FALSE(isPicked(160.5, 200.5));
    EXPECT_FALSE(isPicked(-0.5, 100.5));
    EXPECT_FALSE(isPicked(320.5, 100.5));
    EXPECT_FALSE(isPicked(std::nan(""), 100.5));
    EXPECT_THROW(pickVertex(scene, rays, camera, {0, kHeight, 0.0, 0.0}), Error);
}

}  // namespace
}  // namespace prt
