#include "prt/base/checksum.h"

#include <gtest/gtest.h>

#include <array>
#include <string_view>

namespace prt {
namespace {

std::uint32_t checksumOf(std::string_view text) {
    return computeCrc32(std::as_bytes(std::span(text.data(), text.size())));
}

// The check value of "CRC-32/ISO-HDLC" in the catalogue of parametrised CRC algorithms, and others
// that any implementation of zlib's crc32 agrees on.
TEST(Crc32, HasThePublishedCheckValue) {
    EXPECT_EQ(checksumOf("123456789"), 0xCBF43926u);
    EXPECT_EQ(checksumOf(""), 0u);
    EXPECT_EQ(checksumOf("a"), 0xE8B7BE43u);
    EXPECT_EQ(checksumOf("The quick brown fox jumps over the lazy dog"), 0x414FA339u);
}

TEST(Crc32, EverySingleByteChangeIsDetected) {
    std::array<std::byte, 64> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i)
        bytes[i] = static_cast<std::byte>(i * 37);
    const std::uint32_t intact = computeCrc32(bytes);

    for (std::byte& byte : bytes) {
        const std::byte original = byte;
        for (int change = 1; change < 256; ++change) {
            byte = original ^ static_cast<std::byte>(change);
            EXPECT_NE(computeCrc32(bytes), intact);
        }
        byte = original;
    }
}

}  // namespace
}  // namespace prt
