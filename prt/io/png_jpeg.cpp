#include "prt/io/png_jpeg.h"

#include <stb_image.h>
#include <stb_image_write.h>

#include <cstring>
#include <limits>
#include <memory>

#include "prt/base/error.h"
#include "prt/image/tone_curve.h"
#include "prt/io/confined.h"

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

/// What an encoded image says of itself.
struct Description {
    int width = 0;
    int height = 0;
    bool has16Bits = false;
};

/// An encoded image as stb wants it, its size known to be acceptable.
struct CheckedImage {
    const stbi_uc* bytes = nullptr;
    int byteCount = 0;
    Description description;

    std::size_t pixelCount() const {
        return std::size_t(description.width) * std::size_t(description.height);
    }
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

Description describe(const stbi_uc* bytes, int byteCount, ImageFormat format,
                     const std::string& name, const ImageLimits& limits) {
    const SharedMemory shared(sizeof(Description));
    const auto inspect = [&] {
        Description description;
        int channelCount = 0;
        if (!stbi_info_from_memory(bytes, byteCount, &description.width, &description.height,
                                   &channelCount))
            throwDamaged(format, name);
        description.has16Bits = stbi_is_16_bit_from_memory(bytes, byteCount) != 0;
        std::memcpy(shared.bytes().data(), &description, sizeof description);
    };
    runDecoder(inspect, 1, limits, name);
    Description description;
    std::memcpy(&description, shared.bytes().data(), sizeof description);
    return description;
}

CheckedImage checkEncoded(std::span<const std::byte> encoded, ImageFormat format,
                          const std::string& name, const ImageLimits& limits) {
    if (encoded.size() > std::size_t(std::numeric_limits<int>::max()))
        throw Error(ErrorCode::limitExceeded, "has more than 2 GiB", name);
    if (format == ImageFormat::png) checkPngSize(encoded, limits, name);
    CheckedImage image{reinterpret_cast<const stbi_uc*>(encoded.data()), int(encoded.size()), {}};
    image.description = describe(image.bytes, image.byteCount, format, name, limits);
    checkImageSize(image.description.width, image.description.height, limits, name);

    const std::int64_t pixelsPerByte =
        format == ImageFormat::png ? kMaxPngPixelsPerByte : kMaxJpegPixelsPerByte;
    if (std::int64_t(image.pixelCount()) > pixelsPerByte * image.byteCount)
        throw Error(ErrorCode::malformed, "is too short for the size that it claims", name);
    return image;
}

stbi_uc* load(const CheckedImage& image, int* width, int* height, int channelCount, stbi_uc) {
    int fileChannelCount = 0;
    return stbi_load_from_memory(image.bytes, image.byteCount, width, height, &fileChannelCount,
                                 channelCount);
}
stbi_us* load(const CheckedImage& image, int* width, int* height, int channelCount, stbi_us) {
    int fileChannelCount = 0;
    return stbi_load_16_from_memory(image.bytes, image.byteCount, width, height, &fileChannelCount,
                                    channelCount);
}

/// The channels of an image, of 8 or 16 bits each, pixel by pixel.
template <class Channel>
class Codes {
  public:
    Codes(const CheckedImage& encoded, int channelCount, ImageFormat format,
          const std::string& name, const ImageLimits& limits)
        : shared_(encoded.pixelCount() * std::size_t(channelCount) * sizeof(Channel)) {
        const auto decode = [&] {
            int width = 0, height = 0;
            const StbPixels<Channel> codes(load(encoded, &width, &height, channelCount, Channel()));
            const Description& claimed = encoded.description;
            if (!codes || width != claimed.width || height != claimed.height)
                throwDamaged(format, name);
            std::memcpy(shared_.bytes().data(), codes.get(), shared_.bytes().size());
        };
        runDecoder(decode, encoded.pixelCount(), limits, name);
    }

    const Channel* data() const { return reinterpret_cast<const Channel*>(shared_.bytes().data()); }

  private:
    SharedMemory shared_;
};

/// @param linear  of a code value
template <class Channel, class Linear>
Image decodeLinear(const CheckedImage& encoded, ImageFormat format, const std::string& name,
                   const ImageLimits& limits, Linear linear) {
    const Codes<Channel> channels(encoded, 3, format, name, limits);
    const Channel* codes = channels.data();
    Image image(encoded.description.width, encoded.description.height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = {linear(codes[3 * i]), linear(codes[3 * i + 1]),
                           linear(codes[3 * i + 2])};
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
    const Codes<stbi_uc> codes(checked, 4, format, name, limits);
    static_assert(sizeof(Rgba8) == 4);
    Rgba8Image image(checked.description.width, checked.description.height);
    std::memcpy(image.pixels.data(), codes.data(), image.pixels.size() * sizeof(Rgba8));
    return image;
}

Image decodePngOrJpegLinear(std::span<const std::byte> encoded, ImageFormat format,
                            const std::string& name, const ImageLimits& limits) {
    const CheckedImage checked = checkEncoded(encoded, format, name, limits);
    if (!checked.description.has16Bits)
        return decodeLinear<stbi_uc>(checked, format, name, limits, decodeSrgb8);
    return decodeLinear<stbi_us>(checked, format, name, limits,
                                 [](stbi_us code) { return decodeSrgb(float(code) / 65535.0f); });
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
