#include "prt/image/false_color.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "prt/base/assert.h"

namespace prt {
namespace {

constexpr std::array<Rgba8, 5> kSignedColors = {
    {{8, 48, 107}, {66, 146, 198}, {247, 247, 247}, {239, 101, 72}, {127, 0, 0}}};
constexpr std::array<Rgba8, 5> kUnitColors = {
    {{0, 0, 4}, {87, 16, 110}, {205, 50, 73}, {251, 165, 30}, {252, 255, 190}}};

std::uint8_t mix(std::uint8_t a, std::uint8_t b, float fraction) {
    const auto from = static_cast<float>(a), to = static_cast<float>(b);
    return static_cast<std::uint8_t>(std::lround(from + (to - from) * fraction));
}

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

}  // namespace prt
