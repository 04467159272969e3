#include "prt/io/png_jpeg.h"

#include <stb_image.h>
#include <stb_image_write.h>

#include <cstring>
#include <limits>
#include <memory>

#include "prt/base/error.h"
#include "prt/image/tone_curve.h"

namespace prt {
namespace {

// No encoding is denser: a PNG of one bit a pixel under deflate's bound of 1032 :
// 1, and a JPEG of one bit for each block of 8 × 8. A file shorter than that is
// refused before anything is allocated.
constexpr std::int64_t kMaxPngPixelsPerByte = 8 * 1032;
constexpr std::int64_t kMaxJpegPixelsPerByte = 8 * 64;

struct StbFree {
    void operator()(void* pixels) const { stbi_image_free(pixels); }
};
template <class Channel>
using StbPixels = std::unique_ptr<Channel[], StbFree>;

[[noreturn]] void throwDamaged(ImageFormat format, const std::string& name) {
    const char* reason = stbi_failure_reason();
    throw Error(ErrorCode::malformed,
                std::string("is not a valid ") + (format == ImageFormat::png ? "PNG" : "JPEG") +
                    " image: " + (reason ? reason : "it ends too early"),
                name);
}

/// An encoded image as stb wants it, its size known to be acceptable.
struct CheckedImage {
    const stbi_uc* bytes = nullptr;
    int byteCount = 0;
    int width = 0;
    int height = 0;
};

/// stb_image calls a PNG beyond its own limit an unknown type; say what it is.
void checkPngSize(std::span<const std::byte> encoded, const ImageLimits& limits,
                  const std::string& name) {
    constexpr std::size_t kWidthOffset = 16, kHeightOffset = 20, kSizeEnd = 24;
    if (encoded.size() < kSizeEnd) return;
    const auto readBigEndian = [&](std::size_t offset) {
        std::int64_t value = 0;
        for (const std::byte b : encoded.subspan(offset, 4))
            value = value * 256 + std::to_integer<int>(b);
        return value;
    };
    checkImageSize(readBigEndian(kWidthOffset), readBigEndian(kHeightOffset), limits, name);
}

CheckedImage checkEncoded(std::span<const std::byte> encoded, ImageFormat format,
                          const std::string& name, const ImageLimits& limits) {
    if (encoded.size() > std::size_t(std::numeric_limits<int>::max()))
        throw Error(ErrorCode::limitExceeded, "has more than 2 GiB", name);
    if (format == ImageFormat::png) checkPngSize(encoded, limits, name);
    CheckedImage image{reinterpret_cast<const stbi_uc*>(encoded.data()), int(encoded.size())};
    int channelCount = 0;
    if (!stbi_info_from_memory(image.bytes, image.byteCount, &image.width, &image.height,
                               &channelCount))
        throwDamaged(format, name);
    checkImageSize(image.width, image.height, limits, name);

    const std::int64_t pixelsPerByte =
        format == ImageFormat::png ? kMaxPngPixelsPerByte : kMaxJpegPixelsPerByte;
    if (std::int64_t(image.width) * image.height > pixelsPerByte * image.byteCount)
        throw Error(ErrorCode::malformed, "is too short for the size that it claims", name);
    return image;
}

Image decodeLinear8(const CheckedImage& encoded, ImageFormat format, const std::string& name) {
    int width = 0, height = 0, channelCount = 0;
    const StbPixels<stbi_uc> codes(
        stbi_load_from_memory(encoded.bytes, encoded.byteCount, &width, &height, &channelCount, 3));
    if (!codes) throwDamaged(format, name);
    Image image(width, height, Vec3f(0.0f));
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = {decodeSrgb8(codes[3 * i]), decodeSrgb8(codes[3 * i + 1]),
                           decodeSrgb8(codes[3 * i + 2])};
    return image;
}

Image decodeLinear16(const CheckedImage& encoded, ImageFormat format, const std::string& name) {
    int width = 0, height = 0, channelCount = 0;
    const StbPixels<stbi_us> codes(stbi_load_16_from_memory(encoded.bytes, encoded.byteCount,
                                                            &width, &height, &channelCount, 3));
    if (!codes) throwDamaged(format, name);
    const auto decode = [](stbi_us code) { return decodeSrgb(float(code) / 65535.0f); };
    Image image(width, height, Vec3f(0.0f));
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = {decode(codes[3 * i]), decode(codes[3 * i + 1]),
                           decode(codes[3 * i + 2])};
    return image;
}

void appendBytes(void* destination, void* data, int byteCount) {
    auto& bytes = *static_cast<std::vector<std::byte>*>(destination);
    const auto* first = static_cast<const std::byte*>(data);
    bytes.insert(bytes.end(), first, first + byteCount);
}

}  // namespace

Rgba8Image decodePngOrJpeg(std::span<const std::byte> encoded, ImageFormat format,
                           const std::string& name, const ImageLimits& limits) {
    const CheckedImage checked = checkEncoded(encoded, format, name, limits);
    int width = 0, height = 0, channelCount = 0;
    const StbPixels<stbi_uc> codes(
        stbi_load_from_memory(checked.bytes, checked.byteCount, &width, &height, &channelCount, 4));
    if (!codes) throwDamaged(format, name);
    static_assert(sizeof(Rgba8) == 4);
    Rgba8Image image(width, height);
    std::memcpy(image.pixels.data(), codes.get(), image.pixels.size() * sizeof(Rgba8));
    return image;
}

Image decodePngOrJpegLinear(std::span<const std::byte> encoded, ImageFormat format,
                            const std::string& name, const ImageLimits& limits) {
    const CheckedImage checked = checkEncoded(encoded, format, name, limits);
    return stbi_is_16_bit_from_memory(checked.bytes, checked.byteCount)
               ? decodeLinear16(checked, format, name)
               : decodeLinear8(checked, format, name);
}

std::vector<std::byte> encodePng(const Rgba8Image& image) {
    PRT_ASSERT(!image.pixels.empty(), "a PNG has at least one pixel");
    std::vector<std::byte> encoded;
    const int written = stbi_write_png_to_func(appendBytes, &encoded, image.width, image.height, 4,
                                               image.pixels.data(), 0);
    if (!written) throw Error(ErrorCode::outOfMemory, "a PNG could not be compressed");
    return encoded;
}

}  // namespace prt
