#include "prt/gltf/meshopt.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>

#include "prt/base/assert.h"
#include "prt/base/error.h"

namespace prt::gltf {
namespace {

constexpr std::size_t kMaxStrideBytes = 256;

/// In the order of the enumerations.
constexpr std::array<const char*, 3> kModeNames = {"ATTRIBUTES", "TRIANGLES", "INDICES"};
constexpr std::array<const char*, 4> kFilterNames = {"NONE", "OCTAHEDRAL", "QUATERNION",
                                                     "EXPONENTIAL"};

template <class Enumeration, std::size_t N>
Enumeration parseName(const JsonCursor& value, const std::array<const char*, N>& names) {
    const auto found = std::find(names.begin(), names.end(), value.toString());
    if (found == names.end())
        value.reject("is none that " + std::string(kMeshoptExtension) + " has");
    return static_cast<Enumeration>(found - names.begin());
}

bool hasFittingStride(const MeshoptView& view) {
    if (view.mode != MeshoptMode::attributes) return view.byteStride == 2 || view.byteStride == 4;
    if (view.byteStride == 0 || view.byteStride % 4 != 0 || view.byteStride > kMaxStrideBytes)
        return false;
    switch (view.filter) {
        case MeshoptFilter::octahedral:
            return view.byteStride == 4 || view.byteStride == 8;
        case MeshoptFilter::quaternion:
            return view.byteStride == 8;
        default:
            return true;
    }
}

void applyFilter(const MeshoptView& view, std::span<std::byte> bytes) {
    switch (view.filter) {
        case MeshoptFilter::none:
            return;
        case MeshoptFilter::octahedral:
            return meshopt_decodeFilterOct(bytes.data(), view.count, view.byteStride);
        case MeshoptFilter::quaternion:
            return meshopt_decodeFilterQuat(bytes.data(), view.count, view.byteStride);
        case MeshoptFilter::exponential:
            return meshopt_decodeFilterExp(bytes.data(), view.count, view.byteStride);
    }
}

std::vector<std::byte> encodeTriangles(const MeshoptView& view, std::span<const std::byte> bytes) {
    // The extension has version 1; the library, whose version is one for the whole process, begins
    // with 0.
    static const bool isVersionSet = (meshopt_encodeIndexVersion(1), true);
    PRT_ASSERT(isVersionSet && view.count % 3 == 0, "indices are those of whole triangles");
    std::vector<unsigned int> indices(view.count);
    for (std::size_t i = 0; i < view.count; ++i)
        std::memcpy(&indices[i], bytes.data() + i * view.byteStride, view.byteStride);
    const std::size_t vertexCount = *std::max_element(indices.begin(), indices.end()) + 1ul;
    std::vector<std::byte> encoded(meshopt_encodeIndexBufferBound(view.count, vertexCount));
    encoded.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(encoded.data()),
                                             encoded.size(), indices.data(), indices.size()));
    return encoded;
}

}  // namespace

MeshoptView parseMeshoptView(const JsonCursor& object, std::size_t byteLength) {
    MeshoptView view;
    view.mode = parseName<MeshoptMode>(object.at("mode"), kModeNames);
    if (const std::optional<JsonCursor> filter = object.find("filter"))
        view.filter = parseName<MeshoptFilter>(*filter, kFilterNames);
    view.count = object.at("count").toCount();
    view.byteStride = object.at("byteStride").toCount();
    if (!hasFittingStride(view)) object.at("byteStride").reject("does not fit the mode and filter");
    if (view.mode != MeshoptMode::attributes && view.filter != MeshoptFilter::none)
        object.at("filter").reject("is for attributes");
    if (view.mode == MeshoptMode::triangles && view.count % 3 != 0)
        object.at("count").reject("is not that of whole triangles");
    if (byteLength % view.byteStride != 0 || byteLength / view.byteStride != view.count)
        object.reject("has another length than its buffer view");
    return view;
}

std::vector<std::byte> decodeMeshopt(const MeshoptView& view, std::span<const std::byte> encoded) {
    const auto reject = [] {
        throw Error(ErrorCode::malformed,
                    std::string("is not encoded as ") + kMeshoptExtension + " says");
    };
    if (view.decodedBytes() / kMaxMeshoptRatio > encoded.size()) reject();
    std::vector<std::byte> bytes(view.decodedBytes());
    const auto* source = reinterpret_cast<const unsigned char*>(encoded.data());
    const auto decode = [&] {
        switch (view.mode) {
            case MeshoptMode::triangles:
                return meshopt_decodeIndexBuffer(bytes.data(), view.count, view.byteStride, source,
                                                 encoded.size());
            case MeshoptMode::indices:
                return meshopt_decodeIndexSequence(bytes.data(), view.count, view.byteStride,
                                                   source, encoded.size());
            case MeshoptMode::attributes:
                break;
        }
        return meshopt_decodeVertexBuffer(bytes.data(), view.count, view.byteStride, source,
                                          encoded.size());
    };
    if (decode() != 0) reject();
    applyFilter(view, bytes);
    return bytes;
}

std::vector<std::byte> encodeMeshopt(const MeshoptView& view, std::span<const std::byte> bytes) {
    PRT_ASSERT(view.filter == MeshoptFilter::none && view.mode != MeshoptMode::indices &&
                   hasFittingStride(view) && view.count > 0 && bytes.size() == view.decodedBytes(),
               "the bytes are those of attributes or triangles");
    if (view.mode == MeshoptMode::triangles) return encodeTriangles(view, bytes);
    std::vector<std::byte> encoded(meshopt_encodeVertexBufferBound(view.count, view.byteStride));
    encoded.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(encoded.data()),
                                              encoded.size(), bytes.data(), view.count,
                                              view.byteStride));
    return encoded;
}

const char* meshoptModeName(MeshoptMode mode) {
    return kModeNames[static_cast<std::size_t>(mode)];
}

}  // namespace prt::gltf
