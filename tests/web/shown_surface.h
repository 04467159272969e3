#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "prt/asset/asset.h"
#include "prt/brdf/gltf_view_table.h"
#include "prt/io/image_io.h"
#include "prt/relight/glossy_relighter.h"
#include "prt/relight/relighter.h"
#include "prt/scene/surface_color.h"
#include "tests/asset/asset_builder.h"

namespace prt::test {

// A surface with all that a base colour is made of, and its metallic and roughness from a texture;
// and what the library sees of it from straight above.

inline constexpr int kShownSize = 12;             // pixels a side
inline constexpr int kShownCellCount = 2;         // cells a side, of two triangles
inline constexpr float kShownMetres = 0.6f;       // the side of the square that is seen
inline constexpr float kShownEyeHeight = 1.0e4f;  // so far that all of it is seen from one side

inline TextureImage makeNoise(std::mt19937& random32, bool hasHoles) {
    Rgba8Image image(4, 4);
    for (Rgba8& texel : image.pixels) {
        const auto draw = [&] { return static_cast<std::uint8_t>(40 + random32() % 216); };
        texel = {draw(), draw(), draw(), 255};
        if (hasHoles && random32() % 4 == 0) texel.alpha = 100;
    }
    TextureImage texture;
    texture.mimeType = "image/png";
    texture.encoded = encodePng(image);
    return texture;
}

inline std::vector<std::byte> makeShownAsset() {
    std::mt19937 random32(12);
    Scene scene;
    scene.images = {makeNoise(random32, true), makeNoise(random32, false)};
    Material& material = scene.materials.emplace_back();
    material.baseColorFactor = Vec4f(0.9f, 0.8f, 1.0f, 0.9f);
    material.baseColorTexture = TextureUse{.image = 0, .filter = TextureFilter::nearest};
    material.metallicFactor = 0.9f;
    material.roughnessFactor = 0.95f;
    material.metallicRoughnessTexture = TextureUse{.image = 1, .uvSet = 1};
    material.alphaMode = AlphaMode::mask;
    scene.meshes = {makeGrid("square", kShownCellCount, 0.0f)};
    Mesh& mesh = scene.meshes[0];
    for (const Vec3f& position : mesh.positions) {
        const float x = position.x / kShownMetres;
        const float z = position.z / kShownMetres;
        mesh.uvSets[0].emplace_back(0.37f + 2.1f * x, 0.21f + 1.7f * z);
        mesh.uvSets[1].emplace_back(0.3f * z, 0.1f + 0.8f * x);
        mesh.colors.emplace_back(1.0f - 0.5f * x, 0.4f + 0.6f * z, 0.7f, 1.0f - 0.2f * x);
    }
    return encodeAsset(scene,
                       makeTransfer(scene, 3, TransferEncoding::unorm8,
                                    {Transport::shadowed, Transport::glossyShadowed}),
                       makeProvenance());
}

/// What the vertices of an asset send straight up, by vectors or by matrices.
inline std::vector<ExitRadiance> seeVertices(const Asset& asset, const CompressedLayer& layer,
                                             const Lighting& lighting) {
    std::vector<ExitRadiance> exits(asset.transfer.receiverCount);
    if (isGlossy(layer.transport)) {
        const GltfViewTable views({.bandCount = layer.incidentBandCount});
        GlossyRelighter(asset.transfer, layer.transport,
                        describeReceivers(asset.scene, asset.transfer), views)
            .relight(lighting, Vec3f(0.3f, kShownEyeHeight, 0.3f), 0, exits);
        return exits;
    }
    std::vector<Vec3f> radiance(exits.size());
    Relighter(asset.transfer, layer.transport).relight(lighting, radiance);
    for (std::size_t i = 0; i < exits.size(); ++i)
        exits[i].perBaseColor = radiance[i];
    return exits;
}

/// Where the centre of a pixel lies, of rows along +z and columns along +x.
inline SurfacePoint findPoint(int row, int column) {
    const auto place = [](int k) {
        return (static_cast<float>(k) + 0.5f) * static_cast<float>(kShownCellCount) /
               static_cast<float>(kShownSize);
    };
    const float x = place(column) - std::floor(place(column));
    const float z = place(row) - std::floor(place(row));
    const auto cell = static_cast<std::size_t>(static_cast<int>(place(row)) * kShownCellCount +
                                               static_cast<int>(place(column)));
    // The corners of triangles are (0, 0), (0, 1), (1, 0) and (1, 0), (0, 1), (1, 1) of (x, z).
    if (x + z < 1.0f) return {.triangle = 2 * cell, .u = z, .v = x};
    return {.triangle = 2 * cell + 1, .u = 1.0f - x, .v = x + z - 1.0f};
}

/// Pixels of red, green and blue, black where the surface has holes.
inline std::vector<Vec3f> seeSurface(const Asset& asset, const CompressedLayer& layer,
                                     const Lighting& lighting) {
    const Mesh& mesh = asset.scene.meshes[0];
    const std::vector<ExitRadiance> exits = seeVertices(asset, layer, lighting);
    std::array<std::vector<Vec3f>, 2> parts;
    for (const ExitRadiance& exit : exits) {
        parts[0].push_back(exit.perBaseColor);
        parts[1].push_back(exit.constant);
    }
    std::vector<Vec3f> pixels;
    for (int row = 0; row < kShownSize; ++row)
        for (int column = 0; column < kShownSize; ++column) {
            const SurfacePoint point = findPoint(row, column);
            const Vec4f color = evaluateBaseColor(asset.scene, point);
            const Vec3f radiance = Vec3f(color.x, color.y, color.z) *
                                       interpolateCorners<Vec3f>(mesh, point, parts[0]) +
                                   interpolateCorners<Vec3f>(mesh, point, parts[1]);
            Vec3f& pixel = pixels.emplace_back(0.0f, 0.0f, 0.0f);
            for (int channel = 0; color.w >= 0.5f && channel < 3; ++channel)
                pixel[channel] = std::max(radiance[channel], 0.0f);
        }
    return pixels;
}

}  // namespace prt::test
