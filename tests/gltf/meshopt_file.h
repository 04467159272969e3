#pragma once

#include <cstdint>
#include <vector>

#include "prt/gltf/meshopt.h"
#include "tests/gltf/gltf_builder.h"

namespace prt::test {

/// Adds a buffer view that is encoded, and would lie in the second buffer if it were not.
template <class T>
std::size_t addEncodedView(GltfBuilder& builder, const std::vector<T>& values,
                           gltf::MeshoptMode mode, std::size_t byteStride) {
    const std::span<const std::byte> bytes = std::as_bytes(std::span(values));
    const std::vector<std::byte> encoded = gltf::encodeMeshopt(
        {.mode = mode, .count = bytes.size() / byteStride, .byteStride = byteStride}, bytes);
    const Json view = {{"buffer", 1},
                       {"byteLength", bytes.size()},
                       {"extensions",
                        {{"EXT_meshopt_compression",
                          {{"buffer", 0},
                           {"byteOffset", builder.bytes.size()},
                           {"byteLength", encoded.size()},
                           {"byteStride", byteStride},
                           {"count", bytes.size() / byteStride},
                           {"mode", gltf::meshoptModeName(mode)}}}}}};
    builder.bytes.insert(builder.bytes.end(), encoded.begin(), encoded.end());
    return builder.add("bufferViews", view);
}

/// A square of 3 × 3 vertices in the plane z = 0, all of it encoded.
inline GltfBuilder makeMeshoptFile() {
    GltfBuilder builder;
    std::vector<float> positions;
    std::vector<std::uint16_t> indices;
    for (std::uint16_t i = 0; i < 9; ++i) {
        positions.insert(positions.end(),
                         {static_cast<float>(i % 3), static_cast<float>(i / 3), 0});
        if (i % 3 == 2 || i / 3 == 2) continue;
        for (const int corner : {i + 0, i + 1, i + 3, i + 3, i + 1, i + 4})
            indices.push_back(static_cast<std::uint16_t>(corner));
    }
    const auto position = addEncodedView(builder, positions, gltf::MeshoptMode::attributes, 12);
    const auto index = addEncodedView(builder, indices, gltf::MeshoptMode::triangles, 2);
    builder.add(
        "accessors",
        {{"bufferView", position}, {"componentType", 5126}, {"type", "VEC3"}, {"count", 9}});
    builder.add("accessors", {{"bufferView", index},
                              {"componentType", 5123},
                              {"type", "SCALAR"},
                              {"count", indices.size()}});
    builder.addMeshNode({{"attributes", {{"POSITION", 0}}}, {"indices", 1}});
    builder.json["extensionsUsed"] = {"EXT_meshopt_compression"};
    builder.json["extensionsRequired"] = {"EXT_meshopt_compression"};
    builder.json["buffers"] = {
        {{"byteLength", builder.bytes.size()}},
        {{"byteLength", 1000},
         {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    return builder;
}

}  // namespace prt::test
