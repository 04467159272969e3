// Bibliography
//   [Khronos24]    Khronos PBR Neutral tone mapper
//   [Narkowicz15]  ACES filmic tone mapping curve
#include "prt/image/tone_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace prt {
namespace {

constexpr std::array<std::string_view, 3> kToneCurveNames = {"none", "aces", "neutral"};

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

/// [Khronos24]: takes away what a shiny dielectric reflects of white light, scales what is brighter
/// than K_s to less than 1, and mixes white in, the more the brighter it was.
Vec3f applyNeutral(const Vec3f& radiance) {
    constexpr float kFresnel = 0.04f;
    constexpr float kCompressionStart = 0.8f - kFresnel;  // K_s
    constexpr float kDesaturation = 0.15f;                // K_d
    static constexpr float kSaturated = 1e6f;             // keeps quotients from ∞/∞
    const auto bound = [](float x) { return x > 0.0f ? std::min(x, kSaturated) : 0.0f; };
    const Vec3f color(bound(radiance.x), bound(radiance.y), bound(radiance.z));

    const float least = std::min({color.x, color.y, color.z});
    const float offset =
        least > 2.0f * kFresnel ? kFresnel : least - least * least / (4.0f * kFresnel);
    const Vec3f matte = color - Vec3f(offset);
    const float peak = std::max({matte.x, matte.y, matte.z});
    if (peak <= kCompressionStart) return matte;

    constexpr float kRest = 1.0f - kCompressionStart;
    const float compressed = 1.0f - kRest * kRest / (peak + kRest - kCompressionStart);
    const float saturation = 1.0f / (kDesaturation * (peak - compressed) + 1.0f);
    return matte * (compressed / peak * saturation) + Vec3f(compressed * (1.0f - saturation));
}

Vec3f applyCurve(const Vec3f& x, ToneCurve curve) {
    switch (curve) {
        case ToneCurve::aces:
            return {applyAces(x.x), applyAces(x.y), applyAces(x.z)};
        case ToneCurve::neutral:
            return applyNeutral(x);
        case ToneCurve::none:
            break;
    }
    return x;
}

std::uint8_t encodeChannel(float display) {
    return static_cast<std::uint8_t>(encodeSrgb(display) * 255.0f + 0.5f);
}

}  // namespace

std::string_view toneCurveName(ToneCurve curve) {
    return kToneCurveNames[static_cast<std::size_t>(curve)];
}

std::optional<ToneCurve> parseToneCurve(std::string_view name) {
    const auto found = std::ranges::find(kToneCurveNames, name);
    if (found == kToneCurveNames.end()) return std::nullopt;
    return static_cast<ToneCurve>(found - kToneCurveNames.begin());
}

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

Vec3f exposeForDisplay(const Vec3f& radiance, const DisplayOptions& options) {
    const Vec3f shown = applyCurve(radiance * std::exp2(options.exposureStops), options.toneCurve);
    return {clampToUnit(shown.x), clampToUnit(shown.y), clampToUnit(shown.z)};
}

Rgba8Image encodeForDisplay(const Image& radiance, const DisplayOptions& options) {
    Rgba8Image display(radiance.width, radiance.height);
    for (std::size_t i = 0; i < radiance.pixels.size(); ++i) {
        const Vec3f shown = exposeForDisplay(radiance.pixels[i], options);
        display.pixels[i] = {.red = encodeChannel(shown.x),
                             .green = encodeChannel(shown.y),
                             .blue = encodeChannel(shown.z)};
    }
    return display;
}

}  // namespace prt
