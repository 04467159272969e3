// Bibliography
//   [Narkowicz15]  ACES filmic tone mapping curve
#include "prt/image/tone_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace prt {
namespace {

/// Clamps to [0, 1]; a NaN becomes 0.
float clampToUnit(float value) {
    return value > 0.0f ? std::min(value, 1.0f) : 0.0f;
}

/// [Narkowicz15]; reaches 1 near 7.
float applyAces(float x) {
    constexpr float kSaturated = 100.0f;  // keeps the quotient from ∞/∞
    const float bounded = std::min(std::max(x, 0.0f), kSaturated);
    return bounded * (2.51f * bounded + 0.03f) / (bounded * (2.43f * bounded + 0.59f) + 0.14f);
}

std::uint8_t encodeChannel(float radiance, float exposure, ToneCurve curve) {
    const float exposed = radiance * exposure;
    const float display = clampToUnit(curve == ToneCurve::aces ? applyAces(exposed) : exposed);
    return static_cast<std::uint8_t>(encodeSrgb(display) * 255.0f + 0.5f);
}

}  // namespace

float decodeSrgb(float codeValue) {
    return codeValue <= 0.04045f ? codeValue / 12.92f
                                 : std::pow((codeValue + 0.055f) / 1.055f, 2.4f);
}

float encodeSrgb(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

float decodeSrgb8(std::uint8_t codeValue) {
    static const std::array<float, 256> kLinear = [] {
        std::array<float, 256> linear{};
        for (std::size_t i = 0; i < linear.size(); ++i) {
            linear[i] = decodeSrgb(static_cast<float>(i) / 255.0f);
        }
        return linear;
    }();
    return kLinear[codeValue];
}

Rgba8Image encodeForDisplay(const Image& radiance, const DisplayOptions& options) {
    const float exposure = std::exp2(options.exposureStops);
    Rgba8Image display(radiance.width, radiance.height);
    for (std::size_t i = 0; i < radiance.pixels.size(); ++i) {
        const Vec3f& pixel = radiance.pixels[i];
        display.pixels[i] = {.red = encodeChannel(pixel.x, exposure, options.toneCurve),
                             .green = encodeChannel(pixel.y, exposure, options.toneCurve),
                             .blue = encodeChannel(pixel.z, exposure, options.toneCurve)};
    }
    return display;
}

}  // namespace prt
