#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "prt/base/random.h"
#include "prt/light/lighting.h"
#include "prt/relight/exit_radiance.h"
#include "prt/relight/relighter.h"
#include "tests/support/clustered_layers.h"
#include "tests/support/scenes.h"

namespace prt::test {

constexpr int kBandCount = 4;

inline Rgba8Image makeRandomTexels(int width, int height, RandomStream& random) {
    Rgba8Image image(width, height);
    for (Rgba8& texel : image.pixels) {
        const std::uint64_t bits = random.nextBits();
        texel = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8),
                 static_cast<std::uint8_t>(bits >> 16), static_cast<std::uint8_t>(bits >> 24)};
    }
    return image;
}

/// The room of other tests, with all that materials can say: textures of every wrap and filter on
/// both sets of coordinates, colours of vertices, cut-outs, emission, metal; a sheet seen from
/// behind and a wall that must not be.
inline Scene makeDecoratedRoom() {
    RandomStream random(7, 1);
    Scene scene = makeRoomAround({{makeSphere({0.3f, 0.4f, 0.4f}, 0.4f, 24), {0.9f, 0.9f, 0.5f}},
                                  {makeQuad({-0.9f, -0.4f, 1.1f}, {-0.9f, 0.3f, 1.4f},
                                            {0.1f, 0.3f, 1.5f}, {0.1f, -0.4f, 1.2f}),
                                   {1.0f, 1.0f, 1.0f},
                                   true},
                                  {makeQuad({1.0f, -1.0f, 0.0f}, {-1.0f, -1.0f, 0.0f},
                                            {-1.0f, -1.0f, 1.9f}, {1.0f, -1.0f, 1.9f})}});
    for (int i = 0; i < 3; ++i)
        scene.images.push_back(
            {"noise", "image/png", {}, makeRandomTexels(5 + 3 * i, 9 - 2 * i, random)});
    for (Mesh& mesh : scene.meshes) {
        for (const Vec3f& p : mesh.positions) {
            mesh.uvSets[0].push_back(Vec2f(p.x + 0.3f * p.z, p.y - p.z) * 0.8f);
            mesh.uvSets[1].push_back(Vec2f(p.y + p.z, p.z - p.x) * 0.7f);
            mesh.colors.push_back({random.nextUnitFloat(), random.nextUnitFloat(),
                                   random.nextUnitFloat(), 0.5f + 0.5f * random.nextUnitFloat()});
        }
    }
    scene.meshes[1].colors.clear();
    scene.meshes[2].uvSets[1].clear();  // its emissive texture is white then

    std::vector<Material>& materials = scene.materials;
    materials[0].baseColorTexture = TextureUse{0, 0};
    materials[1].baseColorTexture =
        TextureUse{1, 1, TextureWrap::mirroredRepeat, TextureWrap::clampToEdge};
    materials[2].baseColorTexture = TextureUse{2, 0, TextureWrap::clampToEdge,
                                               TextureWrap::mirroredRepeat, TextureFilter::nearest};
    materials[2].emissiveTexture = TextureUse{0, 1};
    materials[2].emissiveFactor = {0.1f, 0.2f, 0.0f};
    materials[3].baseColorFactor = {2.5f, 1.5f, 0.9f, 1.0f};  // more than 1 reflects no more
    materials[3].emissiveTexture = TextureUse{1, 1};
    materials[3].emissiveFactor = {0.5f, 0.1f, 0.3f};
    materials[4].baseColorTexture = TextureUse{0, 1};
    materials[4].alphaMode = AlphaMode::mask;
    materials[4].alphaCutoff = 0.35f;
    scene.images.push_back({"noise", "image/png", {}, makeRandomTexels(6, 5, random)});
    for (std::size_t i = 0; i < materials.size(); ++i) {
        materials[i].metallicFactor = 0.2f * static_cast<float>(i);
        materials[i].roughnessFactor = 1.1f - 0.25f * static_cast<float>(i);
    }
    materials[2].metallicRoughnessTexture = TextureUse{0, 1};  // for which there are no coordinates
    materials[3].metallicRoughnessTexture = TextureUse{3, 1, TextureWrap::mirroredRepeat};
    std::ranges::reverse(scene.meshes);  // what is behind is drawn last
    return scene;
}

/// Random numbers in every column: no vertex is like its neighbour.
inline CompressedTransfer makeRandomTransfer(const Scene& scene, CompressedLayer layer) {
    CompressedTransfer transfer;
    transfer.bandCount = kBandCount;
    transfer.receiverCount = layer.table.numbers.rowCount();
    for (std::size_t vertex = 0; vertex < scene.vertexCount(); ++vertex)
        transfer.receiverOfVertex.push_back(
            static_cast<std::uint32_t>((7 * vertex + 3) % transfer.receiverCount));
    transfer.layers.push_back(std::move(layer));
    return transfer;
}

inline Lighting makeRandomLighting(int bandCount, std::uint64_t seed) {
    RandomStream random(seed, 2);
    Lighting lighting(bandCount);
    for (Vec3d& coefficient : lighting.coefficients) {
        for (int channel = 0; channel < 3; ++channel)
            coefficient[channel] = 12.0 * random.nextUnitDouble() - 6.0;
    }
    return lighting;
}

inline std::vector<ExitRadiance> relightVertices(const CompressedTransfer& transfer,
                                                 const Lighting& lighting) {
    std::vector<Vec3f> ofReceivers(transfer.receiverCount);
    Relighter(transfer, transfer.layers.front().transport).relight(lighting, ofReceivers);
    std::vector<ExitRadiance> ofVertices;
    for (const std::uint32_t receiver : transfer.receiverOfVertex)
        ofVertices.push_back({.perBaseColor = ofReceivers[receiver]});
    return ofVertices;
}

/// From the open side of the room, down a little.
inline const Camera kCamera{.name = {},
                            .eye = {0.5f, -3.2f, 1.5f},
                            .forward = Vec3f(-0.15f, 1.0f, -0.2f).normalized(),
                            .up = Vec3f(-0.03f, 0.2f, 1.0225f).normalized(),
                            .verticalFovRadians = 0.7f};

inline CompressedTransfer makeFloatTransfer(const Scene& scene) {
    RandomStream random(3, 5);
    CompressedLayer layer = makeLayerKind(Transport::shadowed, kBandCount);
    layer.table = makeRandomTable(TransferEncoding::float32, scene.vertexCount(),
                                  coefficientsPerReceiver(kBandCount, layer), random);
    return makeRandomTransfer(scene, layer);
}

}  // namespace prt::test
