#pragma once

#include <cstdint>
#include <vector>

#include "tests/gltf/gltf_builder.h"

namespace prt::test {

/// A small file in which every part is used: sparse and interleaved accessors, a
/// texture, a camera, a hierarchy.
inline GltfBuilder makeFullFile() {
    GltfBuilder builder;
    const std::vector<float> vertices = {0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0,
                                         0, 1, 0, 0, 0, 1, 0, 1, 1, 1, 0, 0, 0, 1, 1, 1};
    const auto view = builder.addView(vertices, 32);
    const auto slice = [&](int byteOffset, const char* type) {
        return builder.add("accessors", {{"bufferView", view},
                                         {"byteOffset", byteOffset},
                                         {"componentType", 5126},
                                         {"type", type},
                                         {"count", 4}});
    };
    const auto positions = slice(0, "VEC3");
    builder.json["accessors"][positions]["sparse"] = {
        {"count", 1},
        {"indices",
         {{"bufferView", builder.addView(std::vector<std::uint8_t>{3})}, {"componentType", 5121}}},
        {"values", {{"bufferView", builder.addView(std::vector<float>{2, 2, 0})}}}};
    const std::vector<std::uint8_t> white(16, 255);
    const auto colors = builder.addArray(white, "VEC4", 4);
    builder.json["accessors"][colors]["normalized"] = true;
    const auto indices =
        builder.addArray(std::vector<std::uint16_t>{0, 1, 2, 1, 3, 2}, "SCALAR", 6);

    const std::vector<std::uint8_t> png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    builder.add("images", {{"bufferView", builder.addView(png)}, {"mimeType", "image/png"}});
    builder.add("samplers", {{"wrapS", 33071}});
    builder.add("textures", {{"source", 0}, {"sampler", 0}});
    builder.add(
        "materials",
        {{"alphaMode", "MASK"},
         {"pbrMetallicRoughness",
          {{"baseColorTexture", {{"index", 0}}}, {"baseColorFactor", {0.5, 0.5, 0.5, 1}}}}});
    builder.add("cameras",
                {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 1}}}});
    builder.addMeshNode({{"attributes",
                          {{"POSITION", positions},
                           {"NORMAL", slice(12, "VEC3")},
                           {"TEXCOORD_0", slice(24, "VEC2")},
                           {"COLOR_0", colors}}},
                         {"indices", indices},
                         {"material", 0}},
                        {{"rotation", {0, 0.6, 0, 0.8}}, {"scale", {-1, 2, 1}}});
    builder.add("nodes", {{"camera", 0}, {"children", {0}}, {"translation", {1, 2, 3}}});
    builder.add("scenes", {{"nodes", {1}}});
    builder.json["scene"] = 0;
    return builder;
}

}  // namespace prt::test
