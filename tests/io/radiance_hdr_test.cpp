#include "prt/io/radiance_hdr.h"
#include "prt/io/image_io.h"
#include "test_files.h"

namespace prt {
namespace {

using test::catchError;
using test::TemporaryFolder;

const std::string kHeader = "#?RADIANCE\n# a comment\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n\n";

std::string resolution(int width, int height) {
    return "-Y " + std::to_string(height) + " +X " + std::to_string(width) + "\n";
}

Image readBytes(const std::string& bytes) {
    return decodeRadianceHdr(test::asBytes(bytes), "image.hdr", {});
}

/// A row of 10 pixels: red a run of 128, green a dump of 1 … 10, blue two
/// runs, all with the exponent 129.
std::string runLengthRow() {
    std::string row("\x02\x02\x00\x0a", 4);
    row += "\x8a\x80";
    row += "\x0a\x01\x02\x03\x04\x05\x06\x07\x08\x09\x0a";
    row += "\x83\x40\x87\x20";
    row += "\x8a\x81";
    return row;
}

TEST(RadianceHdr, FlatPixelsAreMantissaTimesPowerOfTwo) {
    const std::string file = kHeader + resolution(4, 1) +
                             std::string(
                                 "\x80\x40\x20\x81"   // exponent 1: 128/256·2 …
                                 "\xff\x00\x01\x80"   // exponent 0
                                 "\x80\x80\x80\x00"   // black, whatever the mantissas
                                 "\x80\xff\x01\xff",  // the brightest exponent
                                 16);
    const Image image = readBytes(file);
    ASSERT_EQ(image.pixels.size(), 4u);
    EXPECT_EQ(image.at(0, 0), Vec3f(1.0f, 0.5f, 0.25f));
    EXPECT_EQ(image.at(1, 0), Vec3f(255.0f / 256.0f, 0.0f, 1.0f / 256.0f));
    EXPECT_EQ(image.at(2, 0), Vec3f(0.0f));
    EXPECT_EQ(image.at(3, 0), Vec3f(0x1p126f, 0x1.fep126f, 0x1p119f));
}

TEST(RadianceHdr, FilesAreReadFromTheirPath) {
    const TemporaryFolder folder;
    const auto path = folder.write("a.hdr", kHeader + resolution(1, 1) + "\x80\x40\x20\x81");
    EXPECT_EQ(readImage(path).at(0, 0), Vec3f(1.0f, 0.5f, 0.25f));
}

TEST(RadianceHdr, RunsAndDumpsAreExpandedChannelByChannel) {
    const Image image = readBytes(kHeader + resolution(10, 2) + runLengthRow() + runLengthRow());
    ASSERT_EQ(image.width, 10);
    ASSERT_EQ(image.height, 2);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 10; ++x)
            EXPECT_EQ(image.at(x, y), Vec3f(1.0f, float(x + 1) / 128.0f, x < 3 ? 0.5f : 0.25f))
                << x;
}

TEST(RadianceHdr, OlderRunsRepeatTheLastPixel) {
    // Pixel, 2 repeats, then 256 + 1 repeats as two counts.
    const std::string pixel = "\x80\x40\x20\x81", other = "\x40\x80\x20\x81";
    const Image image =
        readBytes(kHeader + resolution(261, 1) + pixel + "\1\1\1\2" + other + "\1\1\1\1\1\1\1\1");
    ASSERT_EQ(image.width, 261);
    for (int x = 0; x < 261; ++x)
        EXPECT_EQ(image.at(x, 0), x < 3 ? Vec3f(1.0f, 0.5f, 0.25f) : Vec3f(0.5f, 1.0f, 0.25f)) << x;
}

TEST(RadianceHdr, EveryPrefixIsRefusedAndEveryChangeIsSurvived) {
    EXPECT_EQ(test::readDamaged(kHeader + resolution(10, 1) + runLengthRow(), readBytes), 0u);
    EXPECT_EQ(test::readDamaged(kHeader + resolution(2, 1) + "\x80\x40\x20\x81\x80\x40\x20\x81",
                                readBytes),
              0u);
}

TEST(RadianceHdr, HugeClaimsAreRefused) {
    for (const char* size :
         {"-Y 20000 +X 20000\n", "-Y 1 +X 99999999999999999999\n", "-Y 2147483647 +X 2147483647\n"})
        EXPECT_EQ(catchError([&] { readBytes(kHeader + size + "\x80\x40\x20\x81"); }).code(),
                  ErrorCode::limitExceeded);
    for (const char* size : {"-Y 16384 +X 16384\n", "-Y 0 +X 5\n", "-Y -3 +X 5\n"})
        EXPECT_EQ(catchError([&] { readBytes(kHeader + size + "\x80\x40\x20\x81"); }).code(),
                  ErrorCode::malformed);
}

TEST(RadianceHdr, OtherFormatsAreUnsupported) {
    const std::string xyze =
        "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n" + resolution(1, 1) + "\x80\x40\x20\x81";
    EXPECT_EQ(catchError([&] { readBytes(xyze); }).code(), ErrorCode::unsupported);
    EXPECT_EQ(catchError([&] { readBytes(kHeader + "+Y 1 +X 1\n\x80\x40\x20\x81"); }).code(),
              ErrorCode::unsupported);
}

}  // namespace
}  // namespace prt
