#include "prt/gltf/glb_writer.h"

#include <limits>

#include "prt/base/assert.h"
#include "prt/base/error.h"
#include "prt/base/file.h"
#include "prt/gltf/accessor.h"
#include "prt/gltf/glb_description.h"
#include "prt/gltf/glb_layout.h"
#include "prt/gltf/glb_storage.h"

namespace prt {
namespace {

// The parts of a binary glTF [glTF 2.0, 4.4].
constexpr std::uint32_t kMagic = 0x46546C67;  // "glTF"
constexpr std::uint32_t kVersion = 2;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004E4942;  // "BIN\0"
constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;
constexpr std::size_t kMaxFileBytes = std::numeric_limits<std::uint32_t>::max();

/// Where the two chunks of a binary glTF lie.
struct GlbChunks {
    std::size_t jsonBytes = 0;    ///< padded
    std::size_t binaryBytes = 0;  ///< padded; the chunk is left out when empty

    std::size_t jsonOffset() const { return kHeaderBytes + kChunkHeaderBytes; }
    std::size_t binaryOffset() const { return jsonOffset() + jsonBytes + kChunkHeaderBytes; }
    std::size_t fileBytes() const {
        return binaryBytes > 0 ? binaryOffset() + binaryBytes : jsonOffset() + jsonBytes;
    }
};

GlbChunks layOutChunks(std::size_t jsonBytes, std::size_t binaryBytes) {
    const GlbChunks chunks{gltf::alignUp(jsonBytes), gltf::alignUp(binaryBytes)};
    if (chunks.fileBytes() > kMaxFileBytes)
        throw Error(ErrorCode::limitExceeded,
                    "needs " + std::to_string(chunks.fileBytes()) +
                        " bytes, more than the 4294967295 that a binary glTF can have",
                    {}, "use fewer bands, the encoding unorm16 or unorm8, or split the scene");
    return chunks;
}

/// Takes the next part of the file.
using PartWriter = std::function<void(std::span<const std::byte> bytes)>;

void appendWord(std::string& bytes, std::size_t word) {
    const auto narrow = static_cast<std::uint32_t>(word);
    bytes.append(reinterpret_cast<const char*>(&narrow), sizeof(narrow));
}

/// All that stands before the views: the header, the JSON, and the binary chunk's own header.
std::string makeFront(const GlbChunks& chunks, std::string json) {
    std::string front;
    appendWord(front, kMagic);
    appendWord(front, kVersion);
    appendWord(front, chunks.fileBytes());
    appendWord(front, chunks.jsonBytes);
    appendWord(front, kJsonChunk);
    json.resize(chunks.jsonBytes, ' ');
    front += json;
    if (chunks.binaryBytes > 0) {
        appendWord(front, chunks.binaryBytes);
        appendWord(front, kBinaryChunk);
    }
    return front;
}

/// Makes the file part by part, from its beginning to its end, with only the largest view in memory
/// at once. The checksums stand before the views, so each view is made twice.
void makeGlb(const Scene& scene, const GlbExtension* extension, const GlbOptions& options,
             const PartWriter& write) {
    if (extension)
        PRT_ASSERT(extension->meshJson.size() == scene.meshes.size() &&
                       extension->attributes.size() == scene.meshes.size(),
                   "the extension has an object and attributes for each mesh");

    const gltf::GlbLayout layout = gltf::layOutBinary(scene, extension);
    gltf::GlbStorage storage = gltf::planStorage(layout);
    const auto describe = [&] {
        return gltf::describeGlb(scene, extension, layout, storage, options);
    };
    // Checksums are all of one length, so a file that would be too large is known before its views
    // are made; where they are to be encoded, only then.
    if (!options.meshopt) layOutChunks(describe().size(), storage.byteLength);
    gltf::measureViews(layout, options.meshopt, storage);

    const std::string json = describe();
    const GlbChunks chunks = layOutChunks(json.size(), storage.byteLength);
    const std::string front = makeFront(chunks, json);
    write(std::as_bytes(std::span(front)));
    for (const std::size_t index : storage.order)
        write(gltf::makeStoredView(layout, storage, index));
    write(std::vector<std::byte>(chunks.binaryBytes - storage.byteLength));
}

}  // namespace

std::string formatChecksum(std::uint32_t crc32) {
    std::string digits(8, '0');
    for (std::size_t i = digits.size(); i-- > 0; crc32 >>= 4)
        digits[i] = "0123456789abcdef"[crc32 & 15];
    return digits;
}

std::vector<std::byte> encodeGlb(const Scene& scene, const GlbExtension* extension,
                                 const GlbOptions& options) {
    std::vector<std::byte> file;
    makeGlb(scene, extension, options, [&](std::span<const std::byte> bytes) {
        file.insert(file.end(), bytes.begin(), bytes.end());
    });
    return file;
}

void writeGlb(const std::filesystem::path& path, const Scene& scene, const GlbExtension* extension,
              const GlbOptions& options) {
    AtomicFile file(path);
    makeGlb(scene, extension, options,
            [&](std::span<const std::byte> bytes) { file.append(bytes); });
    file.commit();
}

}  // namespace prt
