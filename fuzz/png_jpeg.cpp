// PNG and JPEG, as textures and as environments, by stb_image behind checks of our own, in a
// process of its own.

#include "prt/io/png_jpeg.h"

#include "fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::vector<std::byte> encoded = prt::fuzz::copyBytes(data, size);
    const auto format = prt::recogniseImageFormat(encoded);
    if (format != prt::ImageFormat::png && format != prt::ImageFormat::jpeg) return 0;
    prt::fuzz::readSafely(
        [&] { prt::decodePngOrJpeg(encoded, *format, "image", prt::fuzz::kImageLimits); });
    return prt::fuzz::readSafely(
        [&] { prt::decodePngOrJpegLinear(encoded, *format, "image", prt::fuzz::kImageLimits); });
}
