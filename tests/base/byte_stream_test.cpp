#include "prt/base/byte_stream.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace prt {
namespace {

TEST(ByteStream, ReadsWhatWasWritten) {
    ByteWriter writer;
    writer.writeNumber(std::uint32_t{0x01020304});
    writer.write(std::vector<float>{1.0f, -2.5f});
    writer.writeNumber(std::uint8_t{9});
    ASSERT_EQ(writer.bytes().size(), 13u);
    EXPECT_EQ(writer.bytes().front(), std::byte{4}) << "the smallest digits come first";

    ByteReader reader(writer.bytes());
    EXPECT_EQ(reader.readNumber<std::uint32_t>(), 0x01020304u);
    EXPECT_EQ(reader.readVector<float>(2), (std::vector<float>{1.0f, -2.5f}));
    EXPECT_EQ(reader.remainingBytes(), 1u);
    EXPECT_THROW(reader.requireEnd(), Error);
    EXPECT_EQ(reader.readNumber<std::uint8_t>(), 9);
    reader.requireEnd();
}

TEST(ByteStream, RefusesMoreThanThereIsBeforeItAllocates) {
    const std::vector<std::byte> bytes(11);
    ByteReader reader(bytes);
    EXPECT_THROW(reader.readVector<float>(3), Error);
    // Times four, these counts are 0 and 4 in 64 bits.
    EXPECT_THROW(reader.readVector<float>(std::size_t(1) << 62), Error);
    EXPECT_THROW(reader.readVector<float>((std::size_t(1) << 62) + 1), Error);
    EXPECT_EQ(reader.readVector<float>(2).size(), 2u);
    EXPECT_THROW(reader.readNumber<std::uint32_t>(), Error);
    EXPECT_EQ(reader.readVector<std::uint8_t>(3).size(), 3u);
    EXPECT_TRUE(reader.readVector<double>(0).empty());
}

}  // namespace
}  // namespace prt
