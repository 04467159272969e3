#include "prt/gltf/buffers.h"

#include <string>

#include "prt/base/error.h"
#include "prt/gltf/meshopt.h"

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

std::optional<JsonCursor> findMeshopt(const JsonCursor& object) {
    const std::optional<JsonCursor> extensions = object.find("extensions");
    return extensions ? extensions->find(kMeshoptExtension) : std::nullopt;
}

/// Whether a buffer is there for readers that do not know the encoding.
bool isFallback(const JsonCursor& buffer) {
    const std::optional<JsonCursor> meshopt = findMeshopt(buffer);
    return meshopt && meshopt->boolOr("fallback", false);
}

/// @param loaded  takes the bytes unless they are the file's own
Buffer loadBuffer(const JsonCursor& buffer, bool isFirst, const GltfFile& file,
                  ResourceLoader& loader, std::vector<std::byte>& loaded) {
    const std::size_t byteLength = buffer.at("byteLength").toCount();
    std::span<const std::byte> bytes;
    if (isFallback(buffer)) return {bytes, byteLength};
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

/// Where a view, or the encoded bytes of one, lies.
struct BufferRange {
    const Buffer* buffer = nullptr;
    std::size_t byteOffset = 0;
    std::size_t byteLength = 0;

    /// None in a placeholder.
    std::span<const std::byte> bytes() const {
        return buffer->bytes.empty() ? buffer->bytes
                                     : buffer->bytes.subspan(byteOffset, byteLength);
    }
};

BufferRange parseRange(const JsonCursor& view, const std::vector<Buffer>& buffers) {
    const Buffer& buffer = buffers[view.at("buffer").toIndex(buffers.size(), "buffers")];
    const std::size_t byteOffset = view.countOr("byteOffset", 0);
    const std::size_t byteLength = view.at("byteLength").toCount();
    if (byteLength == 0 || byteOffset > buffer.byteLength ||
        byteLength > buffer.byteLength - byteOffset)
        view.reject("does not lie inside its buffer");
    return {&buffer, byteOffset, byteLength};
}

BufferView parseView(const JsonCursor& view, const std::vector<Buffer>& buffers) {
    const BufferRange range = parseRange(view, buffers);
    const std::size_t byteLength = range.byteLength;

    std::size_t byteStride = 0;
    if (const std::optional<JsonCursor> stride = view.find("byteStride")) {
        byteStride = stride->toCount();
        if (byteStride < kMinStrideBytes || byteStride > kMaxStrideBytes ||
            byteStride % kStrideAlignmentBytes != 0)
            stride->reject("must be a multiple of 4 from 4 to 252");
        if (byteStride > byteLength) stride->reject("is larger than its buffer view");
        if (view.countOr("target", 0) == kIndexTarget) stride->reject("is set for indices");
    }
    return {range.bytes(), range.bytes(), byteLength, range.byteOffset, byteStride};
}

/// Decodes views while the bytes that they ask for can be there.
class MeshoptDecoder {
  public:
    explicit MeshoptDecoder(const std::vector<Buffer>& buffers) : buffers_(buffers) {
        for (const Buffer& buffer : buffers)
            bytesLeft_ += buffer.bytes.size() * kMaxMeshoptRatio;
    }

    /// @param decoded  takes the bytes
    void decode(const JsonCursor& object, BufferView& view, std::vector<std::byte>& decoded) {
        const MeshoptView encoding = parseMeshoptView(object, view.byteLength);
        if (view.byteStride != 0 && view.byteStride != encoding.byteStride)
            object.at("byteStride").reject("is another than that of its buffer view");
        const BufferRange range = parseRange(object, buffers_);
        if (range.bytes().empty()) object.reject("lies in a buffer without bytes");
        if (view.byteLength > bytesLeft_)
            throw Error(ErrorCode::limitExceeded,
                        object.place() + " asks for more bytes than the buffers can hold");
        bytesLeft_ -= view.byteLength;
        try {
            decoded = decodeMeshopt(encoding, range.bytes());
        } catch (const Error& error) {
            object.reject(error.what());
        }
        view.bytes = decoded;
        view.storedBytes = range.bytes();
    }

  private:
    const std::vector<Buffer>& buffers_;
    std::size_t bytesLeft_ = 0;
};

}  // namespace

Buffers loadBuffers(const JsonCursor& root, const GltfFile& file, ResourceLoader& loader) {
    Buffers buffers;
    const std::vector<Buffer> parsed = parseEach(root, "buffers", [&](const JsonCursor& buffer) {
        std::vector<std::byte>& loaded = buffers.loaded.emplace_back();
        return loadBuffer(buffer, buffers.loaded.size() == 1, file, loader, loaded);
    });
    MeshoptDecoder decoder(parsed);
    buffers.views = parseEach(root, "bufferViews", [&](const JsonCursor& view) {
        BufferView result = parseView(view, parsed);
        if (const std::optional<JsonCursor> meshopt = findMeshopt(view))
            decoder.decode(*meshopt, result, buffers.decoded.emplace_back());
        return result;
    });
    return buffers;
}

}  // namespace prt::gltf
