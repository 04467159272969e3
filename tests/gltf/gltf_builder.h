#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "prt/gltf/gltf_document.h"

namespace prt::test {

using Json = nlohmann::json;

/// A folder of its own for a test's files, gone when the test ends.
class ScratchFolder {
  public:
    ScratchFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "prt-gltf-XXXXXX").string();
        path_ = ::mkdtemp(name.data());
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ~ScratchFolder() { std::filesystem::remove_all(path_); }

    const std::filesystem::path& path() const { return path_; }

    std::filesystem::path write(const std::string& name, std::span<const std::byte> bytes) const {
        const std::filesystem::path file = path_ / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()),
                   static_cast<std::streamsize>(bytes.size()));
        return file;
    }
    std::filesystem::path write(const std::string& name, const std::string& text) const {
        return write(name, std::as_bytes(std::span(text)));
    }

  private:
    std::filesystem::path path_;
};

template <class T>
int componentTypeCode() {
    if (std::is_same_v<T, std::int8_t>) return 5120;
    if (std::is_same_v<T, std::uint8_t>) return 5121;
    if (std::is_same_v<T, std::int16_t>) return 5122;
    if (std::is_same_v<T, std::uint16_t>) return 5123;
    return std::is_same_v<T, std::uint32_t> ? 5125 : 5126;
}

inline std::string encodeBase64(std::span<const std::byte> bytes) {
    static constexpr char kDigits[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits =
                bits << 8 | (i + k < bytes.size() ? std::to_integer<unsigned>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

/// Puts a small glTF together. Values go into one buffer; the rest is JSON, as it will stand in the
/// file, so that a test may also write what no exporter would.
struct GltfBuilder {
    Json json = {{"asset", {{"version", "2.0"}}}};
    std::vector<std::byte> bytes;

    std::size_t add(const char* list, Json item) {
        json[list].push_back(std::move(item));
        return json[list].size() - 1;
    }

    /// Stores values from the next multiple of four bytes on.
    template <class T>
    std::size_t addView(const std::vector<T>& values, int byteStride = 0) {
        bytes.resize((bytes.size() + 3) / 4 * 4);
        const std::span<const std::byte> added = std::as_bytes(std::span(values));
        Json view = {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", added.size()}};
        if (byteStride != 0) view["byteStride"] = byteStride;
        bytes.insert(bytes.end(), added.begin(), added.end());
        return add("bufferViews", view);
    }

    /// A tightly packed accessor in a view of its own.
    template <class T>
    std::size_t addArray(const std::vector<T>& values, const char* type, std::size_t count) {
        return add("accessors", {{"bufferView", addView(values)},
                                 {"componentType", componentTypeCode<T>()},
                                 {"type", type},
                                 {"count", count}});
    }
    std::size_t addVectors(const std::vector<float>& values) {
        return addArray(values, "VEC3", values.size() / 3);
    }

    /// A mesh with one primitive, and a node that shows it.
    void addMeshNode(Json primitive, Json node = Json::object()) {
        node["mesh"] = add("meshes", {{"primitives", {std::move(primitive)}}});
        add("nodes", std::move(node));
    }

    Json finished() const {
        Json root = json;
        if (!bytes.empty() && !root.contains("buffers"))
            root["buffers"] = {{{"byteLength", bytes.size()}}};
        return root;
    }

    /// The file as text, its buffer a data URI.
    std::string gltf() const {
        Json root = finished();
        if (!bytes.empty() && !root["buffers"][0].contains("uri"))
            root["buffers"][0]["uri"] =
                "data:application/octet-stream;base64," + encodeBase64(bytes);
        return root.dump();
    }

    /// The file as a GLB, its buffer the binary chunk.
    std::vector<std::byte> glb() const {
        std::string text = finished().dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::vector<std::byte> binary = bytes;
        binary.resize((binary.size() + 3) / 4 * 4);
        std::vector<std::byte> file;
        const auto putWord = [&file](std::size_t word) {
            for (int shift = 0; shift < 32; shift += 8)
                file.push_back(static_cast<std::byte>(word >> shift & 0xff));
        };
        const auto putChunk = [&](std::size_t type, std::span<const std::byte> content) {
            putWord(content.size());
            putWord(type);
            file.insert(file.end(), content.begin(), content.end());
        };
        putWord(0x46546C67);
        putWord(2);
        putWord(12 + 8 + text.size() + (binary.empty() ? 0 : 8 + binary.size()));
        putChunk(0x4E4F534A, std::as_bytes(std::span(text)));
        if (!binary.empty()) putChunk(0x004E4942, binary);
        return file;
    }

    Scene read(const GltfLimits& limits = {}) const {
        return GltfDocument(glb(), "", limits).flatten().scene;
    }
};

/// Three vertices, no indices.
inline const std::vector<float> kTriangle = {0, 0, 0, 1, 0, 0, 0, 1, 0};

inline GltfBuilder makeTriangleFile() {
    GltfBuilder builder;
    builder.addMeshNode({{"attributes", {{"POSITION", builder.addVectors(kTriangle)}}}});
    return builder;
}

/// A closed tetrahedron of volume 1/6, its triangles counter-clockwise seen from outside.
inline GltfBuilder makeTetrahedronFile(Json node = Json::object()) {
    GltfBuilder builder;
    const auto positions = builder.addVectors({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
    const std::vector<std::uint16_t> corners = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    const auto indices = builder.addArray(corners, "SCALAR", corners.size());
    builder.addMeshNode({{"attributes", {{"POSITION", positions}}}, {"indices", indices}},
                        std::move(node));
    return builder;
}

/// The volume that a closed mesh encloses; negative if its triangles
/// are clockwise seen from outside.
inline double signedVolume(const Mesh& mesh) {
    double volume = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const Vec3d a(mesh.positions[mesh.indices[i]]);
        const Vec3d b(mesh.positions[mesh.indices[i + 1]]);
        const Vec3d c(mesh.positions[mesh.indices[i + 2]]);
        volume += a.dot(b.cross(c)) / 6.0;
    }
    return volume;
}

}  // namespace prt::test
