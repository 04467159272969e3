#include "prt/gltf/glb_writer.h"

#include <cstring>
#include <limits>

#include "prt/base/assert.h"
#include "prt/base/checksum.h"
#include "prt/base/error.h"
#include "prt/base/file.h"
#include "prt/gltf/glb_description.h"
#include "prt/gltf/glb_layout.h"

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

std::size_t alignUp(std::size_t byteCount) {
    return (byteCount + 3) / 4 * 4;
}

void writeWord(std::span<std::byte> file, std::size_t offset, std::size_t word) {
    const auto narrow = static_cast<std::uint32_t>(word);
    std::memcpy(file.data() + offset, &narrow, sizeof(narrow));
}

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
    const GlbChunks chunks{alignUp(jsonBytes), alignUp(binaryBytes)};
    if (chunks.fileBytes() > kMaxFileBytes)
        throw Error(ErrorCode::limitExceeded,
                    "needs " + std::to_string(chunks.fileBytes()) +
                        " bytes, more than the 4294967295 that a binary glTF can have",
                    {}, "use fewer bands, the encoding unorm16 or unorm8, or split the scene");
    return chunks;
}

void writeContainer(const GlbChunks& chunks, const std::string& json, std::span<std::byte> file) {
    writeWord(file, 0, kMagic);
    writeWord(file, 4, kVersion);
    writeWord(file, 8, chunks.fileBytes());
    writeWord(file, chunks.jsonOffset() - 8, chunks.jsonBytes);
    writeWord(file, chunks.jsonOffset() - 4, kJsonChunk);
    std::memset(file.data() + chunks.jsonOffset(), ' ', chunks.jsonBytes);
    std::memcpy(file.data() + chunks.jsonOffset(), json.data(), json.size());
    if (chunks.binaryBytes == 0) return;
    writeWord(file, chunks.binaryOffset() - 8, chunks.binaryBytes);
    writeWord(file, chunks.binaryOffset() - 4, kBinaryChunk);
}

}  // namespace

std::string formatChecksum(std::uint32_t crc32) {
    std::string digits(8, '0');
    for (std::size_t i = digits.size(); i-- > 0; crc32 >>= 4)
        digits[i] = "0123456789abcdef"[crc32 & 15];
    return digits;
}

std::vector<std::byte> encodeGlb(const Scene& scene, const GlbExtension* extension) {
    if (extension)
        PRT_ASSERT(extension->meshJson.size() == scene.meshes.size() &&
                       extension->attributes.size() == scene.meshes.size(),
                   "the extension has an object and attributes for each mesh");

    // Checksums are all of one length, so the size of the JSON is known before its content.
    const gltf::GlbLayout layout = gltf::layOutBinary(scene, extension);
    std::vector<std::string> checksums(layout.views.size(), formatChecksum(0));
    const std::size_t jsonBytes = gltf::describeGlb(scene, extension, layout, checksums).size();
    const GlbChunks chunks = layOutChunks(jsonBytes, layout.byteLength);

    std::vector<std::byte> file(chunks.fileBytes());
    const std::span<std::byte> binary = chunks.binaryBytes > 0
                                            ? std::span(file).subspan(chunks.binaryOffset())
                                            : std::span<std::byte>();
    gltf::writeViews(layout, binary);
    for (std::size_t i = 0; i < layout.views.size(); ++i)
        checksums[i] = formatChecksum(
            computeCrc32(binary.subspan(layout.views[i].byteOffset, layout.views[i].byteLength)));
    writeContainer(chunks, gltf::describeGlb(scene, extension, layout, checksums), file);
    return file;
}

void writeScene(const std::filesystem::path& path, const Scene& scene) {
    writeFileAtomically(path, encodeGlb(scene));
}

}  // namespace prt
