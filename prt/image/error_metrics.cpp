#include "prt/image/error_metrics.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "prt/base/assert.h"

namespace prt {

ImageError measureError(const Image& image, const Image& reference) {
    PRT_ASSERT(image.width == reference.width && image.height == reference.height,
               "the pictures have the same size");
    double squares = 0.0, referenceSquares = 0.0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        squares += (Vec3d(image.pixels[i]) - Vec3d(reference.pixels[i])).length2();
        referenceSquares += Vec3d(reference.pixels[i]).length2();
    }
    if (squares == 0.0) return {};
    const double valueCount = 3.0 * static_cast<double>(image.pixels.size());
    return {std::sqrt(squares / valueCount), std::sqrt(squares / referenceSquares)};
}

double measurePsnr(const Rgba8Image& image, const Rgba8Image& reference) {
    PRT_ASSERT(image.width == reference.width && image.height == reference.height,
               "the pictures have the same size");
    double squares = 0.0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const Rgba8& a = image.pixels[i];
        const Rgba8& b = reference.pixels[i];
        for (const int difference : {a.red - b.red, a.green - b.green, a.blue - b.blue})
            squares += difference * difference;
    }
    if (squares == 0.0) return std::numeric_limits<double>::infinity();
    const double meanSquare = squares / (3.0 * static_cast<double>(image.pixels.size()));
    constexpr double kPeak = 255.0;
    return 10.0 * std::log10(kPeak * kPeak / meanSquare);
}

}  // namespace prt
