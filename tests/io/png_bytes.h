#pragma once

#include <cstdint>
#include <string>

#include "prt/base/checksum.h"
#include "test_files.h"

namespace prt::test {

/// A PNG whose rows are stored, not compressed, put together from the specification [PNG].
struct PngBytes {
    std::uint32_t width = 1, height = 1;
    std::uint8_t bitDepth = 8;
    std::uint8_t colorType = 2;  ///< 0 grey, 2 RGB, 6 RGBA
    std::string rows = {};       ///< each row begins with its filter, 0

    static std::string chunk(const std::string& typeAndData) {
        std::string bytes;
        appendBigEndian(bytes, static_cast<std::uint32_t>(typeAndData.size() - 4));
        bytes += typeAndData;
        appendBigEndian(bytes, computeCrc32(asBytes(typeAndData)));
        return bytes;
    }

    std::string zlibStream() const {
        std::uint32_t a = 1, b = 0;
        for (const char c : rows) {
            a = (a + static_cast<unsigned char>(c)) % 65521;
            b = (b + a) % 65521;
        }
        std::string bytes = "\x78\x01\x01";
        append(bytes, static_cast<std::uint16_t>(rows.size()));
        append(bytes, static_cast<std::uint16_t>(~rows.size()));
        bytes += rows;
        appendBigEndian(bytes, (b << 16) | a);
        return bytes;
    }

    std::string file() const {
        std::string header = "IHDR";
        appendBigEndian(header, width);
        appendBigEndian(header, height);
        header += {static_cast<char>(bitDepth), static_cast<char>(colorType), 0, 0, 0};
        return "\x89PNG\r\n\x1a\n" + chunk(header) + chunk("IDAT" + zlibStream()) + chunk("IEND");
    }
};

/// A grey baseline JPEG of one 8 × 8 block, all of it the value 188: the DC coefficient is 8 · (188
/// − 128) = 480, of category 9, and each Huffman table has one code of one bit.
inline std::string makeGreyJpeg() {
    std::string bytes("\xff\xd8\xff\xdb\x00\x43\x00", 7);
    bytes += std::string(64, '\1');
    bytes += std::string("\xff\xc0\x00\x0b\x08\x00\x08\x00\x08\x01\x01\x11\x00", 13);
    bytes += std::string("\xff\xc4\x00\x14\x00\x01", 6) + std::string(15, '\0') + '\x09';
    bytes += std::string("\xff\xc4\x00\x14\x10\x01", 6) + std::string(16, '\0');
    bytes += std::string("\xff\xda\x00\x08\x01\x01\x00\x00\x3f\x00", 10);
    return bytes + "\x78\x1f\xff\xd9";
}

}  // namespace prt::test
