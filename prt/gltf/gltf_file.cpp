#include "prt/gltf/gltf_file.h"

#include <bit>
#include <cstring>
#include <string>
#include <utility>

#include "prt/base/error.h"

namespace prt::gltf {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF stores little endian, as we read");

// The words of a binary glTF's header and chunks [glTF 2.0, 4.4].
constexpr std::uint32_t kMagic = 0x46546C67;        // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004E4942;  // "BIN\0"
constexpr std::uint32_t kVersion = 2;
constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;

[[noreturn]] void reject(const std::string& complaint) {
    throw Error(ErrorCode::malformed, complaint);
}

}  // namespace

GltfFile::GltfFile(std::vector<std::byte> fileBytes) : bytes(std::move(fileBytes)) {
    if (bytes.empty()) reject("is empty");
    isBinary = bytes.size() >= sizeof(kMagic) && readWord(0) == kMagic;
    if (isBinary)
        splitChunks();
    else
        json = {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::uint32_t GltfFile::readWord(std::size_t offset) const {
    std::uint32_t word;
    std::memcpy(&word, bytes.data() + offset, sizeof(word));
    return word;
}

void GltfFile::splitChunks() {
    if (bytes.size() < kHeaderBytes + kChunkHeaderBytes) reject("ends within its header");
    if (readWord(4) != kVersion)
        throw Error(ErrorCode::unsupported,
                    "is binary glTF of version " + std::to_string(readWord(4)) + ", not 2");
    const std::size_t fileBytes = readWord(8);
    if (fileBytes < kHeaderBytes + kChunkHeaderBytes || fileBytes > bytes.size())
        reject("says it has " + std::to_string(fileBytes) + " bytes but has " +
               std::to_string(bytes.size()));
    trailingByteCount = bytes.size() - fileBytes;

    // The first chunk is JSON, the second may be BIN, and all others are to be passed over.
    std::size_t offset = kHeaderBytes;
    for (int chunk = 0; offset < fileBytes; ++chunk) {
        if (fileBytes - offset < kChunkHeaderBytes) reject("ends within a chunk's header");
        const std::size_t chunkBytes = readWord(offset);
        const std::uint32_t type = readWord(offset + 4);
        offset += kChunkHeaderBytes;
        if (chunkBytes > fileBytes - offset) reject("has a chunk that ends beyond the file");
        if (chunkBytes % 4 != 0) reject("has a chunk that is not a multiple of four bytes long");
        if (chunk == 0 && type != kJsonChunk) reject("does not begin with a JSON chunk");
        const std::span<const std::byte> content = std::span(bytes).subspan(offset, chunkBytes);
        if (chunk == 0)
            json = {reinterpret_cast<const char*>(content.data()), content.size()};
        else if (chunk == 1 && type == kBinaryChunk)
            binaryChunk = content;
        else if (type == kJsonChunk || type == kBinaryChunk)
            reject("has a chunk twice or out of order");
        offset += chunkBytes;
    }
}

}  // namespace prt::gltf
