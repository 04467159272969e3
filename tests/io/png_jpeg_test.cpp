#include <cmath>

#include "png_bytes.h"
#include "prt/io/image_io.h"

namespace prt {
namespace {

using test::catchError;
using test::PngBytes;
using test::TemporaryFolder;

// Decoding goes through float once: a few roundings.
constexpr double kSrgbTolerance = 1e-6;
// The inverse cosine transform of a JPEG is done in integers.
constexpr int kJpegTolerance = 1;

/// IEC 61966-2-1, in double.
double srgb(double code) {
    return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

Image readBytes(const std::string& bytes) {
    const TemporaryFolder folder;
    return readImage(folder.write("image", bytes));
}

/// In this process: thousands of others would take seconds.
void decodeHere(const std::string& bytes) {
    decodeImage(test::asBytes(bytes), "image", {.inOwnProcess = false});
}

TEST(Png, CodesAreDecodedFromSrgb) {  // C5
    const Image image = readBytes(
        PngBytes{.width = 2,
                 .height = 2,
                 .rows = std::string("\0\x00\x01\x0a\x0b\x80\xff\0\x80\x80\x80\x40\xc0\x20", 14)}
            .file());
    ASSERT_EQ(image.width, 2);
    ASSERT_EQ(image.height, 2);
    const int codes[4][3] = {{0, 1, 10}, {11, 128, 255}, {128, 128, 128}, {64, 192, 32}};
    for (std::size_t i = 0; i < 4; ++i)
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(image.pixels[i][channel], srgb(codes[i][channel] / 255.0), kSrgbTolerance);
}

TEST(Png, SixteenBitsAreAllUsed) {
    const Image image = readBytes(PngBytes{.width = 1,
                                           .height = 1,
                                           .bitDepth = 16,
                                           .rows = std::string("\0\x80\x01\x12\x34\xff\xfe", 7)}
                                      .file());
    EXPECT_NEAR(image.at(0, 0).x, srgb(0x8001 / 65535.0), kSrgbTolerance);
    EXPECT_NEAR(image.at(0, 0).y, srgb(0x1234 / 65535.0), kSrgbTolerance);
    EXPECT_NEAR(image.at(0, 0).z, srgb(0xfffe / 65535.0), kSrgbTolerance);
    EXPECT_LT(image.at(0, 0).z, 1.0f);
}

TEST(Png, GreyAndAlphaBecomeRgba) {
    const std::string grey = PngBytes{.colorType = 0, .rows = std::string("\0\x7b", 2)}.file();
    const Rgba8 pixel = decodeImage(test::asBytes(grey), "grey").at(0, 0);
    EXPECT_EQ(pixel.red, 0x7b);
    EXPECT_EQ(pixel.blue, 0x7b);
    EXPECT_EQ(pixel.alpha, 255);
    const std::string clear = PngBytes{.colorType = 6, .rows = std::string("\0\1\2\3\4", 5)}.file();
    EXPECT_EQ(decodeImage(test::asBytes(clear), "clear").at(0, 0).alpha, 4);
}

TEST(Png, FormatIsToldByContent) {
    const TemporaryFolder folder;
    const auto path =
        folder.write("picture.exr", PngBytes{.rows = std::string("\0\xff\xff\xff", 4)}.file());
    EXPECT_EQ(readImage(path).at(0, 0), Vec3f(1.0f));
}

TEST(Png, EveryPrefixIsRefusedAndEveryChangeIsSurvived) {
    const std::string file =
        PngBytes{.width = 2, .height = 2, .rows = std::string(14, '\0')}.file();
    // All of the picture is there once the last chunk is named; its empty
    // data and checksum say nothing.
    constexpr std::size_t kIgnoredEndBytes = 4;
    EXPECT_LE(test::readDamaged(file, decodeHere), kIgnoredEndBytes);
}

TEST(Png, HugeClaimsAreRefused) {
    const PngBytes beyond{.width = 1u << 15, .height = 1u << 15, .rows = "\0"};
    EXPECT_EQ(catchError([&] { readBytes(beyond.file()); }).code(), ErrorCode::limitExceeded);
    const PngBytes within{.width = 1u << 14, .height = 1u << 14, .rows = "\0"};
    EXPECT_EQ(catchError([&] { readBytes(within.file()); }).code(), ErrorCode::malformed);
    const PngBytes beyondInt{.width = 0xffffffffu, .height = 1, .rows = "\0"};
    EXPECT_EQ(catchError([&] { readBytes(beyondInt.file()); }).code(), ErrorCode::limitExceeded);
}

TEST(Png, WrittenPicturesAreReadBack) {
    const TemporaryFolder folder;
    Rgba8Image image(5, 3);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = {std::uint8_t(i * 17), std::uint8_t(255 - i), std::uint8_t(i * i),
                           std::uint8_t(i)};
    writePng(folder.path() / "out.png", image);
    std::ifstream file(folder.path() / "out.png", std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
    const Rgba8Image back = decodeImage(test::asBytes(bytes), "out.png");
    ASSERT_EQ(back.width, 5);
    ASSERT_EQ(back.height, 3);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        EXPECT_EQ(back.pixels[i].red, image.pixels[i].red);
        EXPECT_EQ(back.pixels[i].green, image.pixels[i].green);
        EXPECT_EQ(back.pixels[i].blue, image.pixels[i].blue);
        EXPECT_EQ(back.pixels[i].alpha, image.pixels[i].alpha);
    }
}

TEST(Png, UnwritablePlaceIsAnError) {
    const TemporaryFolder folder;
    EXPECT_EQ(catchError([&] {
                  writePng(folder.path() / "missing" / "out.png", Rgba8Image(1, 1));
              }).code(),
              ErrorCode::writeFailed);
}

TEST(Jpeg, ConstantBlockIsItsValue) {
    const Rgba8Image image = decodeImage(test::asBytes(test::makeGreyJpeg()), "grey");
    ASSERT_EQ(image.pixels.size(), 64u);
    for (const Rgba8& pixel : image.pixels) {
        EXPECT_NEAR(pixel.red, 188, kJpegTolerance);
        EXPECT_NEAR(pixel.blue, 188, kJpegTolerance);
    }
    EXPECT_NEAR(readBytes(test::makeGreyJpeg()).at(3, 3).y, srgb(188 / 255.0), 0.01);
}

TEST(Jpeg, EveryPrefixIsRefusedAndEveryChangeIsSurvived) {
    EXPECT_EQ(test::readDamaged(test::makeGreyJpeg(), decodeHere), 0u);
}

TEST(Images, OtherFilesAreUnsupportedAndMissingOnesNotFound) {
    const TemporaryFolder folder;
    EXPECT_EQ(catchError([&] { readBytes("GIF89a"); }).code(), ErrorCode::unsupported);
    EXPECT_EQ(catchError([&] { readBytes(""); }).code(), ErrorCode::unsupported);
    EXPECT_EQ(catchError([&] { readImage(folder.path() / "none.exr"); }).code(),
              ErrorCode::notFound);
    EXPECT_EQ(catchError([&] { decodeImage(test::asBytes("#?RADIANCE\n"), "hdr"); }).code(),
              ErrorCode::unsupported);
}

TEST(Images, TexturesOfASceneAreDecodedOnce) {
    Scene scene;
    scene.images.resize(2);
    const std::string png = PngBytes{.rows = std::string("\0\1\2\3", 4)}.file();
    const auto bytes = test::asBytes(png);
    scene.images[0].encoded.assign(bytes.begin(), bytes.end());
    scene.images[1].pixels = Rgba8Image(2, 2);
    decodeTextures(scene);
    EXPECT_EQ(scene.images[0].pixels.at(0, 0).green, 2);
    EXPECT_EQ(scene.images[1].pixels.width, 2);
}

}  // namespace
}  // namespace prt
