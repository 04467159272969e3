#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "prt/scene/scene.h"

namespace prt::test {

inline bool isFinite(const Vec3f& vector) {
    return std::isfinite(vector.x) && std::isfinite(vector.y) && std::isfinite(vector.z);
}

inline bool isUnit(const Vec3f& vector) {
    constexpr float kTolerance = 1e-5f;  // of a vector normalised in double and rounded to float
    return std::abs(vector.length() - 1.0f) < kTolerance;
}

template <class Range, class Predicate>
bool allOf(const Range& range, Predicate predicate) {
    return std::all_of(range.begin(), range.end(), predicate);
}

inline void expectMeshKeepsItsPromises(const Scene& scene, const Mesh& mesh) {
    const std::size_t count = mesh.vertexCount();
    EXPECT_LT(mesh.material, scene.materials.size());
    EXPECT_EQ(mesh.indices.size() % 3, 0u);
    EXPECT_TRUE(allOf(mesh.indices, [&](std::uint32_t i) { return i < count; }));
    EXPECT_TRUE(allOf(mesh.positions, isFinite));
    EXPECT_EQ(mesh.normals.size(), count);
    EXPECT_TRUE(allOf(mesh.normals, isUnit));
    for (const auto& uvs : mesh.uvSets) {
        EXPECT_TRUE(uvs.empty() || uvs.size() == count);
        EXPECT_TRUE(
            allOf(uvs, [](const Vec2f& uv) { return std::isfinite(uv.x) && std::isfinite(uv.y); }));
    }
    EXPECT_TRUE(mesh.colors.empty() || mesh.colors.size() == count);
    EXPECT_TRUE(allOf(mesh.colors, [](const Vec4f& color) {
        return std::min({color.x, color.y, color.z, color.w}) >= 0.0f &&
               std::max({color.x, color.y, color.z, color.w}) <= 1.0f;
    }));
    if (mesh.material >= scene.materials.size()) return;
    const Material& material = scene.materials[mesh.material];
    for (const auto& texture :
         {material.baseColorTexture, material.metallicRoughnessTexture, material.emissiveTexture}) {
        if (!texture) continue;
        ASSERT_TRUE(texture->uvSet == 0 || texture->uvSet == 1);
        EXPECT_EQ(mesh.uvSets[static_cast<std::size_t>(texture->uvSet)].size(), count);
        EXPECT_LT(texture->image, scene.images.size());
    }
}

/// What a reader promises of the scene that it returns (prt/scene/scene.h).
inline void expectSceneKeepsItsPromises(const Scene& scene) {
    EXPECT_GT(scene.triangleCount(), 0u);
    for (const Mesh& mesh : scene.meshes)
        expectMeshKeepsItsPromises(scene, mesh);
    for (const Material& material : scene.materials) {
        for (int i = 0; i < 4; ++i)
            EXPECT_TRUE(material.baseColorFactor[i] >= 0.0f && material.baseColorFactor[i] <= 1.0f);
        EXPECT_TRUE(isFinite(material.emissiveFactor));
        EXPECT_TRUE(material.alphaCutoff >= 0.0f && std::isfinite(material.alphaCutoff));
    }
    for (const TextureImage& image : scene.images)
        EXPECT_TRUE(image.mimeType == "image/png" || image.mimeType == "image/jpeg");
    for (const Camera& camera : scene.cameras) {
        EXPECT_TRUE(isFinite(camera.eye) && isUnit(camera.forward) && isUnit(camera.up));
        EXPECT_NEAR(camera.forward.dot(camera.up), 0.0f, 1e-5f);
        EXPECT_TRUE(camera.verticalFovRadians > 0.0f &&
                    camera.verticalFovRadians < std::numbers::pi_v<float>);
    }
}

}  // namespace prt::test
