#include "prt/io/image_format.h"

#include <string_view>

#include "prt/base/error.h"
#include "prt/io/confined.h"

namespace prt {
namespace {

bool startsWith(std::span<const std::byte> bytes, std::string_view magic) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return text.starts_with(magic);
}

std::string sizeText(std::int64_t width, std::int64_t height) {
    return std::to_string(width) + " × " + std::to_string(height) + " pixels";
}

}  // namespace

std::optional<ImageFormat> recogniseImageFormat(std::span<const std::byte> encoded) {
    if (startsWith(encoded, "\x76\x2f\x31\x01")) return ImageFormat::exr;
    if (startsWith(encoded, "#?")) return ImageFormat::hdr;
    if (startsWith(encoded, "\x89PNG\r\n\x1a\n")) return ImageFormat::png;
    if (startsWith(encoded, "\xff\xd8\xff")) return ImageFormat::jpeg;
    return std::nullopt;
}

void checkImageSize(std::int64_t width, std::int64_t height, const ImageLimits& limits,
                    const std::string& name) {
    if (width <= 0 || height <= 0)
        throw Error(ErrorCode::malformed, "claims to have " + sizeText(width, height), name);
    if (width > limits.maxWidth || height > limits.maxHeight)
        throw Error(ErrorCode::limitExceeded,
                    "has " + sizeText(width, height) + ", more than the limit of " +
                        sizeText(limits.maxWidth, limits.maxHeight),
                    name, "scale it down, or allow more with --max-pixels");
}

void runDecoder(const std::function<void()>& decode, std::size_t pixelCount,
                const ImageLimits& limits, const std::string& name) {
    if (!limits.inOwnProcess) return decode();
    // No compression decodes fewer pixels a second by far.
    constexpr double kSlowestPixelsPerSecond = 1e6;
    ConfinedLimits confinement;
    confinement.seconds += static_cast<double>(pixelCount) / kSlowestPixelsPerSecond;
    runConfined(decode, confinement, name);
}

}  // namespace prt
