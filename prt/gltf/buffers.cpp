#include "prt/gltf/buffers.h"

#include <string>

namespace prt::gltf {
namespace {

// What a vertex attribute's stride may be [glTF 2.0, 5.11.4].
constexpr std::size_t kMinStrideBytes = 4;
constexpr std::size_t kMaxStrideBytes = 252;
constexpr std::size_t kStrideAlignmentBytes = 4;
constexpr std::size_t kIndexTarget = 34963;  // ELEMENT_ARRAY_BUFFER

/// One buffer. One with neither a URI nor a binary chunk is a placeholder, which another program
/// may fill: it has a length and no bytes [glTF 2.0, 3.6.1].
struct Buffer {
    std::span<const std::byte> bytes;
    std::size_t byteLength = 0;
};

/// @param loaded  takes the bytes unless they are the file's own
Buffer loadBuffer(const JsonCursor& buffer, bool isFirst, const GltfFile& file,
                  ResourceLoader& loader, std::vector<std::byte>& loaded) {
    const std::size_t byteLength = buffer.at("byteLength").toCount();
    std::span<const std::byte> bytes;
    if (const std::optional<JsonCursor> uri = buffer.find("uri")) {
        loaded = loader.load(*uri);
        bytes = loaded;
    } else if (isFirst && file.binaryChunk) {
        bytes = *file.binaryChunk;
    } else if (isFirst && file.isBinary) {
        buffer.reject("has no URI, and the file has no binary chunk");
    } else if (byteLength > 0) {
        return {bytes, byteLength};
    }
    if (byteLength == 0 || byteLength > bytes.size())
        buffer.reject("says it has " + std::to_string(byteLength) + " bytes, but " +
                      std::to_string(bytes.size()) + " are there");
    return {bytes.first(byteLength), byteLength};
}

BufferView parseView(const JsonCursor& view, const std::vector<Buffer>& buffers) {
    const Buffer& buffer = buffers[view.at("buffer").toIndex(buffers.size(), "buffers")];
    const std::size_t byteOffset = view.countOr("byteOffset", 0);
    const std::size_t byteLength = view.at("byteLength").toCount();
    if (byteLength == 0 || byteOffset > buffer.byteLength ||
        byteLength > buffer.byteLength - byteOffset)
        view.reject("does not lie inside its buffer");

    std::size_t byteStride = 0;
    if (const std::optional<JsonCursor> stride = view.find("byteStride")) {
        byteStride = stride->toCount();
        if (byteStride < kMinStrideBytes || byteStride > kMaxStrideBytes ||
            byteStride % kStrideAlignmentBytes != 0)
            stride->reject("must be a multiple of 4 from 4 to 252");
        if (byteStride > byteLength) stride->reject("is larger than its buffer view");
        if (view.countOr("target", 0) == kIndexTarget) stride->reject("is set for indices");
    }
    const bool isPlaceholder = buffer.bytes.empty();
    return {isPlaceholder ? buffer.bytes : buffer.bytes.subspan(byteOffset, byteLength), byteLength,
            byteOffset, byteStride};
}

}  // namespace

Buffers loadBuffers(const JsonCursor& root, const GltfFile& file, ResourceLoader& loader) {
    Buffers buffers;
    const std::vector<Buffer> parsed = parseEach(root, "buffers", [&](const JsonCursor& buffer) {
        std::vector<std::byte>& loaded = buffers.loaded.emplace_back();
        return loadBuffer(buffer, buffers.loaded.size() == 1, file, loader, loaded);
    });
    buffers.views = parseEach(root, "bufferViews",
                              [&](const JsonCursor& view) { return parseView(view, parsed); });
    return buffers;
}

}  // namespace prt::gltf
