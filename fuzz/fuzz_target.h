#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "prt/base/assert.h"
#include "prt/base/error.h"
#include "prt/image/image.h"
#include "prt/io/image_io.h"
#include "prt/scene/scene.h"

namespace prt::fuzz {

/// Pictures beyond this size only cost time: what is decoded is the same.
inline constexpr ImageLimits kImageLimits{.maxWidth = 2048, .maxHeight = 2048};

/// Runs a reader on bytes from anywhere: it returns, or throws an Error that says why. All else,
/// another exception among it, ends the program, and the fuzzer keeps the bytes.
template <class Read>
int readSafely(const Read& read) {
    try {
        read();
    } catch (const Error& error) {
        PRT_ASSERT(!std::string_view(error.what()).empty(), "a refusal says why");
    }
    return 0;
}

inline std::vector<std::byte> copyBytes(const std::uint8_t* data, std::size_t size) {
    const auto* bytes = reinterpret_cast<const std::byte*>(data);
    return {bytes, bytes + size};
}

inline std::string_view asText(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

inline bool isFinite(const Vec3f& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Ends the program unless the scene is what readers promise (prt/scene/scene.h).
inline void demandPromises(const Scene& scene) {
    constexpr float kTolerance = 1e-5f;  // of a vector normalised in double and rounded to float
    const auto isUnit = [](const Vec3f& normal) {
        return std::abs(normal.length() - 1.0f) < kTolerance;
    };
    for (const Mesh& mesh : scene.meshes) {
        const std::size_t count = mesh.vertexCount();
        PRT_ASSERT(mesh.indices.size() % 3 == 0, "triangles are whole");
        PRT_ASSERT(std::all_of(mesh.indices.begin(), mesh.indices.end(),
                               [&](std::uint32_t index) { return index < count; }),
                   "indices are vertices");
        PRT_ASSERT(std::all_of(mesh.positions.begin(), mesh.positions.end(), isFinite),
                   "positions are finite");
        PRT_ASSERT(mesh.normals.size() == count, "each vertex has a normal");
        PRT_ASSERT(std::all_of(mesh.normals.begin(), mesh.normals.end(), isUnit),
                   "normals are unit");
        PRT_ASSERT(mesh.colors.empty() || mesh.colors.size() == count, "each vertex has a colour");
        PRT_ASSERT(mesh.material < scene.materials.size(), "materials exist");
        for (const auto& uvs : mesh.uvSets)
            PRT_ASSERT(uvs.empty() || uvs.size() == count, "each vertex has a texture coordinate");
    }
}

}  // namespace prt::fuzz
