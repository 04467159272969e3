#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "prt/image/image.h"

namespace prt {

/// The sRGB transfer function [IEC 61966-2-1]: code value in [0, 1] to linear, and back.
float decodeSrgb(float codeValue);
float encodeSrgb(float linear);

/// decodeSrgb(codeValue / 255), from a table.
float decodeSrgb8(std::uint8_t codeValue);

/// How bright linear Rec. 709 looks: 1 for (1, 1, 1) [IEC 61966-2-1].
inline float luminance(const Vec3f& rgb) {
    return 0.2126f * rgb.x + 0.7152f * rgb.y + 0.0722f * rgb.z;
}
inline double luminance(const Vec3d& rgb) {
    return 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z;
}

enum class ToneCurve {
    none,     ///< clamp to [0, 1]
    aces,     ///< Narkowicz' fit of the ACES filmic curve [Narkowicz15]
    neutral,  ///< hue and the colours of surfaces are kept, highlights compressed [Khronos24]
};

std::string_view toneCurveName(ToneCurve curve);
std::optional<ToneCurve> parseToneCurve(std::string_view name);

struct DisplayOptions {
    float exposureStops = 0.0f;  ///< radiance is multiplied by 2^exposureStops first
    ToneCurve toneCurve = ToneCurve::aces;
};

/// What a screen is to show of linear radiance: exposed, through the curve, clamped; linear, each
/// channel in [0, 1].
Vec3f exposeForDisplay(const Vec3f& radiance, const DisplayOptions& options = {});

/// Turns linear radiance into the 8-bit sRGB picture that a PNG holds (C5). Alpha is opaque.
Rgba8Image encodeForDisplay(const Image& radiance, const DisplayOptions& options = {});

}  // namespace prt
