#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "prt/base/assert.h"
#include "prt/math/vector.h"

namespace prt {

/// A row-major array of pixels; row 0 is the top.
template <class Pixel>
struct ImageOf {
    int width = 0;
    int height = 0;
    std::vector<Pixel> pixels;

    ImageOf() = default;
    /// Every pixel holds the value: by default black, or what Pixel says itself.
    ImageOf(int imageWidth, int imageHeight, const Pixel& value = defaultPixel())
        : width(imageWidth),
          height(imageHeight),
          pixels(static_cast<std::size_t>(imageWidth) * static_cast<std::size_t>(imageHeight),
                 value) {}

    Pixel& at(int x, int y) { return pixels[indexOf(x, y)]; }
    const Pixel& at(int x, int y) const { return pixels[indexOf(x, y)]; }

  private:
    /// Imath's vectors leave themselves uninitialised.
    static Pixel defaultPixel() {
        if constexpr (std::is_aggregate_v<Pixel>) {
            return Pixel{};
        } else {
            return Pixel(0.0f);
        }
    }
    std::size_t indexOf(int x, int y) const {
        PRT_ASSERT(x >= 0 && x < width && y >= 0 && y < height, "the pixel lies in the image");
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    }
};

/// Linear Rec. 709 radiance or reflectance (C5).
using Image = ImageOf<Vec3f>;

/// An sRGB-encoded colour with linear alpha, as textures store it.
struct Rgba8 {
    std::uint8_t red = 255;
    std::uint8_t green = 255;
    std::uint8_t blue = 255;
    std::uint8_t alpha = 255;
};

using Rgba8Image = ImageOf<Rgba8>;

}  // namespace prt
