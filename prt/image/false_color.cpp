#include "prt/image/false_color.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "prt/base/assert.h"
#include "prt/image/tone_curve.h"

namespace prt {
namespace {

constexpr std::array<Rgba8, 5> kSignedColors = {
    {{8, 48, 107}, {66, 146, 198}, {247, 247, 247}, {239, 101, 72}, {127, 0, 0}}};
constexpr std::array<Rgba8, 9> kSignedColorsOnBlack = {{{190, 240, 255},
                                                        {91, 176, 239},
                                                        {39, 107, 204},
                                                        {16, 52, 115},
                                                        {0, 0, 0},
                                                        {106, 26, 7},
                                                        {182, 77, 20},
                                                        {226, 153, 70},
                                                        {255, 229, 181}}};
constexpr std::array<Rgba8, 5> kUnitColors = {
    {{0, 0, 4}, {87, 16, 110}, {205, 50, 73}, {251, 165, 30}, {252, 255, 190}}};

std::uint8_t mix(std::uint8_t a, std::uint8_t b, float fraction) {
    const auto from = static_cast<float>(a), to = static_cast<float>(b);
    return static_cast<std::uint8_t>(std::lround(from + (to - from) * fraction));
}

/// @param position  of the first colour 0, of the last 1
Rgba8 colorAt(float position, std::span<const Rgba8> colors) {
    const float last = static_cast<float>(colors.size() - 1);
    const float scaled = position > 0.0f ? std::min(position, 1.0f) * last : 0.0f;
    const std::size_t index = std::min(static_cast<std::size_t>(scaled), colors.size() - 2);
    const float fraction = scaled - static_cast<float>(index);
    const Rgba8& a = colors[index];
    const Rgba8& b = colors[index + 1];
    return {mix(a.red, b.red, fraction), mix(a.green, b.green, fraction),
            mix(a.blue, b.blue, fraction), 255};
}

}  // namespace

std::span<const Rgba8> signedColors() {
    return kSignedColors;
}

std::span<const Rgba8> signedColorsOnBlack() {
    return kSignedColorsOnBlack;
}

std::span<const Rgba8> unitColors() {
    return kUnitColors;
}

Rgba8Image drawFalseColors(const ImageOf<float>& values, float low, float high,
                           std::span<const Rgba8> colors) {
    PRT_ASSERT(low < high && colors.size() >= 2, "there is a range of values and of colours");
    Rgba8Image image(values.width, values.height);
    for (std::size_t i = 0; i < values.pixels.size(); ++i)
        image.pixels[i] = colorAt((values.pixels[i] - low) / (high - low), colors);
    return image;
}

Vec3f findFalseRadiance(float value, float low, float high, std::span<const Rgba8> colors) {
    PRT_ASSERT(low < high && colors.size() >= 2, "there is a range of values and of colours");
    const Rgba8 color = colorAt((value - low) / (high - low), colors);
    return {decodeSrgb8(color.red), decodeSrgb8(color.green), decodeSrgb8(color.blue)};
}

}  // namespace prt
