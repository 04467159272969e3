#include "prt/io/image_io.h"

#include "prt/base/error.h"
#include "prt/base/file.h"
#include "prt/io/exr.h"
#include "prt/io/image_format.h"
#include "prt/io/png_jpeg.h"
#include "prt/io/radiance_hdr.h"

namespace prt {

Image readImage(const std::filesystem::path& path, const ImageLimits& limits) {
    const std::string name = path.string();
    const std::vector<std::byte> encoded = readFile(path, limits.maxFileBytes);
    const std::optional<ImageFormat> format = recogniseImageFormat(encoded);
    if (!format) throw Error(ErrorCode::unsupported, "is not an EXR, HDR, PNG or JPEG image", name);
    switch (*format) {
        case ImageFormat::exr:
            return decodeExr(encoded, name, limits);
        case ImageFormat::hdr:
            return decodeRadianceHdr(encoded, name, limits);
        case ImageFormat::png:
        case ImageFormat::jpeg:
            break;
    }
    return decodePngOrJpegLinear(encoded, *format, name, limits);
}

Rgba8Image decodeImage(std::span<const std::byte> encoded, const std::string& name,
                       const ImageLimits& limits) {
    const std::optional<ImageFormat> format = recogniseImageFormat(encoded);
    if (format != ImageFormat::png && format != ImageFormat::jpeg)
        throw Error(ErrorCode::unsupported, "is not a PNG or JPEG image", name);
    return decodePngOrJpeg(encoded, *format, name, limits);
}

void decodeTextures(Scene& scene, const ImageLimits& limits) {
    for (TextureImage& image : scene.images)
        if (image.pixels.pixels.empty())
            image.pixels = decodeImage(image.encoded, "texture " + image.name, limits);
}

void writePng(const std::filesystem::path& path, const Rgba8Image& image) {
    writeFileAtomically(path, encodePng(image));
}

void writeExr(const std::filesystem::path& path, const Image& image) {
    writeFileAtomically(path, encodeExr(image));
}

}  // namespace prt
