#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace prt::test {

/// A binary glTF taken apart, to be looked at or changed.
struct GlbFile {
    nlohmann::json json;
    std::vector<std::byte> binary;

    /// The bytes of a buffer view. @throws std::out_of_range  if there is no such view or byte
    std::span<std::byte> view(const nlohmann::json& index) {
        const nlohmann::json& object = json.at("bufferViews").at(readSize(index));
        const std::size_t offset = readSize(object.value("byteOffset", nlohmann::json(0u)));
        const std::size_t length = readSize(object.at("byteLength"));
        if (offset > binary.size() || length > binary.size() - offset)
            throw std::out_of_range("a buffer view ends beyond the binary chunk");
        return std::span(binary).subspan(offset, length);
    }

    /// A size or an index. @throws std::out_of_range  if it is none
    static std::size_t readSize(const nlohmann::json& number) {
        if (!number.is_number_unsigned()) throw std::out_of_range("this is no size");
        return number.get<std::size_t>();
    }
};

inline std::uint32_t readGlbWord(std::span<const std::byte> bytes, std::size_t offset) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.subspan(offset, sizeof(word)).data(), sizeof(word));
    return word;
}

/// Where the binary chunk's bytes begin; the file's size if it has none.
inline std::size_t findBinaryChunk(std::span<const std::byte> bytes) {
    const std::size_t jsonEnd = 20 + readGlbWord(bytes, 12);
    return jsonEnd == bytes.size() ? jsonEnd : jsonEnd + 8;
}

/// Takes a well-formed file apart by the offsets of the specification [glTF 2.0, 4.4].
inline GlbFile splitGlb(std::span<const std::byte> bytes) {
    EXPECT_EQ(readGlbWord(bytes, 0), 0x46546C67u);
    EXPECT_EQ(readGlbWord(bytes, 4), 2u);
    EXPECT_EQ(readGlbWord(bytes, 8), bytes.size());
    EXPECT_EQ(readGlbWord(bytes, 16), 0x4E4F534Au);
    const std::size_t jsonBytes = readGlbWord(bytes, 12);
    const std::size_t begin = findBinaryChunk(bytes);
    const std::span<const std::byte> binary = bytes.subspan(begin);
    if (begin < bytes.size()) {
        EXPECT_EQ(readGlbWord(bytes, begin - 8), bytes.size() - begin);
        EXPECT_EQ(readGlbWord(bytes, begin - 4), 0x004E4942u);
    }
    const auto* text = reinterpret_cast<const char*>(bytes.data()) + 20;
    return {nlohmann::json::parse(text, text + jsonBytes), {binary.begin(), binary.end()}};
}

/// Puts a file together again.
inline std::vector<std::byte> joinGlb(const GlbFile& file) {
    std::string json = file.json.dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::vector<std::byte> bytes;
    const auto append = [&bytes](const void* data, std::size_t byteCount) {
        const auto* begin = static_cast<const std::byte*>(data);
        bytes.insert(bytes.end(), begin, begin + byteCount);
    };
    const auto appendWord = [&append](std::size_t word) {
        const auto narrow = static_cast<std::uint32_t>(word);
        append(&narrow, sizeof(narrow));
    };
    appendWord(0x46546C67u);
    appendWord(2);
    appendWord(12 + 8 + json.size() + 8 + file.binary.size());
    appendWord(json.size());
    appendWord(0x4E4F534Au);
    append(json.data(), json.size());
    appendWord(file.binary.size());
    appendWord(0x004E4942u);
    append(file.binary.data(), file.binary.size());
    return bytes;
}

}  // namespace prt::test
