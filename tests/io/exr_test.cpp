#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <half.h>
#include <sys/resource.h>

#include <bit>
#include <limits>

#include "exr_bytes.h"
#include "prt/base/file.h"
#include "prt/image/image.h"
#include "prt/io/exr.h"
#include "prt/io/image_io.h"

namespace prt {
namespace {

using test::catchError;
using test::ExrBytes;
using test::TemporaryFolder;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Values that a half cannot hold, and those that no camera saw.
Image makeExtremeImage(int width, int height) {
    const std::vector<float> values = {0.0f,     -0.0f, 1.0f / 3.0f, -2.5f,      1e-40f,  3.4e38f,
                                       65520.0f, kNan,  kInfinity,   -kInfinity, 1.7e38f, 1e-7f};
    Image image(width, height, Vec3f(0.0f));
    std::size_t next = 0;
    for (Vec3f& pixel : image.pixels)
        for (int channel = 0; channel < 3; ++channel)
            pixel[channel] = values[next++ % values.size()];
    return image;
}

void expectSameBits(const Image& a, const Image& b) {
    ASSERT_EQ(a.width, b.width);
    ASSERT_EQ(a.height, b.height);
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (int channel = 0; channel < 3; ++channel)
            ASSERT_EQ(std::bit_cast<std::uint32_t>(a.pixels[i][channel]),
                      std::bit_cast<std::uint32_t>(b.pixels[i][channel]))
                << "pixel " << i << ", channel " << channel;
}

Image readBytes(const std::string& bytes) {
    return decodeExr(test::asBytes(bytes), "image.exr", {});
}

/// Writes one constant colour with OpenEXR itself.
struct ConstantExr {
    int width = 40;
    int height = 300;
    Imf::Compression compression = Imf::NO_COMPRESSION;
    Imf::PixelType type = Imf::FLOAT;
    std::string layer = {};

    static constexpr float kColor[3] = {0.25f, 2.0f, 16.0f};
    static constexpr const char* kChannels[3] = {"R", "G", "B"};

    Imf::Header header() const {
        Imf::Header header(width, height, 1.0f, Imath::V2f(0.0f), 1.0f, Imf::INCREASING_Y,
                           compression);
        for (const char* name : kChannels)
            header.channels().insert(layer + name, Imf::Channel(type));
        return header;
    }

    /// @param samples  kept by the caller until the file is written
    Imf::FrameBuffer fill(std::string& samples) const {
        const std::size_t pixelCount = std::size_t(width) * std::size_t(height);
        samples.clear();
        for (const float value : kColor)
            for (std::size_t i = 0; i < pixelCount; ++i) {
                if (type == Imf::HALF)
                    test::append(samples, Imath::half(value).bits());
                else
                    test::append(samples, value);
            }
        Imf::FrameBuffer buffer;
        for (std::size_t i = 0; i < 3; ++i)
            buffer.insert(layer + kChannels[i],
                          Imf::Slice::Make(type, &samples[i * samples.size() / 3], Imath::V2i(0, 0),
                                           width, height));
        return buffer;
    }

    void expectReadFrom(const std::filesystem::path& path, float tolerance) const {
        const Image image = readImage(path);
        ASSERT_EQ(image.width, width);
        ASSERT_EQ(image.height, height);
        for (const Vec3f& pixel : image.pixels)
            for (int channel = 0; channel < 3; ++channel)
                ASSERT_NEAR(pixel[channel], kColor[channel], tolerance * kColor[channel]);
    }
};

TEST(Exr, HandMadeFileIsReadValueForValue) {
    const ExrBytes exr{.width = 2, .height = 2, .samples = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}};
    const Image image = readBytes(exr.file());
    ASSERT_EQ(image.width, 2);
    EXPECT_EQ(image.at(0, 0), Vec3f(5, 3, 1));
    EXPECT_EQ(image.at(1, 0), Vec3f(6, 4, 2));
    EXPECT_EQ(image.at(0, 1), Vec3f(11, 9, 7));
    EXPECT_EQ(image.at(1, 1), Vec3f(12, 10, 8));
}

TEST(Exr, DataWindowDecidesWhereverItLies) {
    for (const std::int32_t offset : {-7, 100, -1000000, 1000000}) {
        const ExrBytes exr{.minX = offset,
                           .minY = -offset,
                           .width = 1,
                           .height = 2,
                           .samples = {1, 2, 3, 4, 5, 6}};
        const Image image = readBytes(exr.file());
        ASSERT_EQ(image.height, 2);
        EXPECT_EQ(image.at(0, 1), Vec3f(6, 5, 4)) << offset;
    }
}

TEST(Exr, LuminanceBecomesGrey) {
    const ExrBytes exr{.width = 2, .channels = {"Y"}, .samples = {0.5f, 7.0f}};
    const Image image = readBytes(exr.file());
    EXPECT_EQ(image.at(0, 0), Vec3f(0.5f));
    EXPECT_EQ(image.at(1, 0), Vec3f(7.0f));
}

TEST(Exr, FirstLayerIsReadWhereThereIsNoPlainColour) {
    const ExrBytes exr{
        .channels = {"Depth.Z", "ViewLayer.Combined.A", "ViewLayer.Combined.B",
                     "ViewLayer.Combined.G", "ViewLayer.Combined.R", "ViewLayer.Diffuse.B",
                     "ViewLayer.Diffuse.G", "ViewLayer.Diffuse.R"},
        .samples = {1, 2, 3, 4, 5, 6, 7, 8}};
    EXPECT_EQ(readBytes(exr.file()).at(0, 0), Vec3f(5, 4, 3));
}

TEST(Exr, MissingColoursAreBlack) {
    const ExrBytes exr{.channels = {"A", "G"}, .samples = {1, -7}};
    EXPECT_EQ(readBytes(exr.file()).at(0, 0), Vec3f(0, -7, 0));
}

TEST(Exr, OtherChannelsAreRefusedByName) {
    const ExrBytes exr{.channels = {"Q", "Z"}, .samples = {1, 2}};
    const Error error = catchError([&] { readBytes(exr.file()); });
    EXPECT_EQ(error.code(), ErrorCode::unsupported);
    EXPECT_NE(std::string(error.what()).find("Q, Z"), std::string::npos) << error.what();
}

TEST(Exr, FloatsComeBackBitForBit) {  // F10
    const TemporaryFolder folder;
    for (const int height : {1, 16, 37}) {
        const Image image = makeExtremeImage(29, height);
        writeExr(folder.path() / "out.exr", image);
        expectSameBits(readImage(folder.path() / "out.exr"), image);
    }
}

TEST(Exr, EveryCompressionIsRead) {
    // PXR24 keeps 24 bits of a float, B44 a sixth significant bit fewer than a
    // half, DWA what the eye sees of one.
    const std::vector<std::pair<Imf::Compression, float>> compressions = {
        {Imf::NO_COMPRESSION, 0.0f},    {Imf::RLE_COMPRESSION, 0.0f},
        {Imf::ZIPS_COMPRESSION, 0.0f},  {Imf::ZIP_COMPRESSION, 0.0f},
        {Imf::PIZ_COMPRESSION, 0.0f},   {Imf::PXR24_COMPRESSION, 1e-4f},
        {Imf::B44_COMPRESSION, 0.02f},  {Imf::B44A_COMPRESSION, 0.02f},
        {Imf::DWAA_COMPRESSION, 0.02f}, {Imf::DWAB_COMPRESSION, 0.02f}};
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "image.exr";
    for (const Imf::PixelType type : {Imf::FLOAT, Imf::HALF})
        for (const auto& [compression, tolerance] : compressions) {
            SCOPED_TRACE(compression);
            const ConstantExr exr{.compression = compression, .type = type};
            {
                Imf::OutputFile file(path.c_str(), exr.header());
                std::string samples;
                file.setFrameBuffer(exr.fill(samples));
                file.writePixels(exr.height);
            }
            exr.expectReadFrom(path, tolerance);
        }
}

TEST(Exr, TilesAreReadAtTheFinestLevel) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "image.exr";
    for (const Imf::LevelMode mode : {Imf::ONE_LEVEL, Imf::MIPMAP_LEVELS}) {
        const ConstantExr exr{.compression = Imf::ZIP_COMPRESSION};
        Imf::Header header = exr.header();
        header.setTileDescription(Imf::TileDescription(32, 16, mode));
        {
            Imf::TiledOutputFile file(path.c_str(), header);
            std::string samples;
            file.setFrameBuffer(exr.fill(samples));
            for (int level = 0; level < file.numLevels(); ++level)
                file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
        }
        exr.expectReadFrom(path, 0.0f);
    }
}

TEST(Exr, FirstPartOfSeveralIsRead) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "image.exr";
    const ConstantExr first{.layer = "Layer.Combined."};
    const ConstantExr second{.width = 3, .height = 5};
    std::vector<Imf::Header> headers = {first.header(), second.header()};
    headers[0].setName("first"), headers[1].setName("second");
    for (Imf::Header& header : headers) {
        header.setType(Imf::SCANLINEIMAGE);
        header.displayWindow() = headers[0].displayWindow();  // parts share it
    }
    {
        Imf::MultiPartOutputFile file(path.c_str(), headers.data(), 2);
        std::string samples;
        for (int i = 0; i < 2; ++i) {
            Imf::OutputPart part(file, i);
            part.setFrameBuffer((i == 0 ? first : second).fill(samples));
            part.writePixels((i == 0 ? first : second).height);
        }
    }
    first.expectReadFrom(path, 0.0f);
}

TEST(Exr, SubsampledColourIsRefused) {
    std::string file = ExrBytes{.width = 2, .height = 2, .samples = std::vector<float>(12)}.file();
    const std::size_t sampling = file.find(std::string("R\0\2", 3)) + 2 + 8;
    file[sampling] = 2, file[sampling + 4] = 2;
    EXPECT_EQ(catchError([&] { readBytes(file); }).code(), ErrorCode::unsupported);
}

TEST(Exr, EveryPrefixIsRefusedAndEveryChangeIsSurvived) {
    const ExrBytes exr{.width = 2, .height = 2, .samples = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}};
    const auto read = [](const std::string& bytes) {
        decodeExr(test::asBytes(bytes), "image.exr", {.inOwnProcess = false});
    };
    EXPECT_EQ(test::readDamaged(exr.file(), read), 0u);
}

/// Peak memory of this process so far, in bytes.
std::size_t peakBytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

TEST(Exr, HugeClaimsOfSmallFilesCostLittleMemory) {  // F9
#ifdef __SANITIZE_ADDRESS__
    constexpr std::size_t kKeptFreedBytes = std::size_t(512) << 20;  // the sanitizer's quarantine
#else
    constexpr std::size_t kKeptFreedBytes = 0;
#endif
    // The claims below are for 3 GB and more.
    constexpr std::size_t kLittleMemoryBytes = (std::size_t(256) << 20) + kKeptFreedBytes;
    const std::size_t before = peakBytes();

    const ExrBytes beyondLimit{.width = 1 << 15, .height = 1 << 15, .samples = {}};
    EXPECT_EQ(catchError([&] { readBytes(beyondLimit.file() + std::string(3000, '\1')); }).code(),
              ErrorCode::limitExceeded);
    for (const char compression : {'\0', '\3', '\11'}) {
        const ExrBytes withinLimit{
            .width = 1 << 14, .height = 1 << 14, .samples = {}, .compression = compression};
        EXPECT_EQ(
            catchError([&] { readBytes(withinLimit.file() + std::string(200000, '\1')); }).code(),
            ErrorCode::malformed);
    }
    std::string tiles(9, '\0');
    tiles[0] = tiles[4] = 1;
    const ExrBytes tiled{.width = 1 << 14,
                         .height = 1 << 14,
                         .samples = {},
                         .extraAttributes = ExrBytes::attribute("tiles", "tiledesc", tiles)};
    EXPECT_EQ(catchError([&] { readBytes(tiled.file()); }).code(), ErrorCode::malformed);
    EXPECT_LT(peakBytes() - before, kLittleMemoryBytes);
}

TEST(Exr, HugeAttributesAreRefused) {
    std::string attribute = ExrBytes::attribute("comments", "string", "");
    attribute.replace(attribute.size() - 4, 4, "\xff\xff\xff\x7f");
    const ExrBytes exr{.samples = {1, 2, 3}, .extraAttributes = attribute};
    EXPECT_EQ(catchError([&] { readBytes(exr.file()); }).code(), ErrorCode::malformed);
}

TEST(Exr, LimitIsTheCallers) {
    const TemporaryFolder folder;
    const auto path =
        folder.write("image.exr", ExrBytes{.width = 3, .samples = std::vector<float>(9)}.file());
    EXPECT_NO_THROW(readImage(path, {.maxWidth = 3, .maxHeight = 1}));
    EXPECT_EQ(catchError([&] { readImage(path, {.maxWidth = 2}); }).code(),
              ErrorCode::limitExceeded);
    EXPECT_EQ(catchError([&] { readImage(path, {.maxFileBytes = 100}); }).code(),
              ErrorCode::limitExceeded);
}

}  // namespace
}  // namespace prt
