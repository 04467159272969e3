#version 430 core
// Turns linear radiance into sRGB code values: exposure, tone curve, encoding.
//
// TONE_CURVE  0: none, 1: ACES, 2: neutral

in vec2 place;

layout(location = 0) uniform float exposure;
layout(binding = 0) uniform sampler2D radiance;

layout(location = 0) out vec4 codeValues;

#if TONE_CURVE == 1
// Narkowicz' fit of the ACES filmic curve [Narkowicz15].
vec3 applyCurve(vec3 x) {
    vec3 bounded = clamp(x, 0.0, 100.0);
    return bounded * (2.51 * bounded + 0.03) / (bounded * (2.43 * bounded + 0.59) + 0.14);
}
#elif TONE_CURVE == 2
// Khronos PBR Neutral [Khronos24].
vec3 applyCurve(vec3 x) {
    const float kFresnel = 0.04;
    const float kCompressionStart = 0.8 - kFresnel;
    const float kDesaturation = 0.15;
    vec3 color = clamp(x, 0.0, 1e6);
    float least = min(color.r, min(color.g, color.b));
    vec3 matte = color - (least > 2.0 * kFresnel ? kFresnel : least - least * least / (4.0 * kFresnel));
    float peak = max(matte.r, max(matte.g, matte.b));
    if (peak <= kCompressionStart) return matte;
    const float kRest = 1.0 - kCompressionStart;
    float compressed = 1.0 - kRest * kRest / (peak + kRest - kCompressionStart);
    float saturation = 1.0 / (kDesaturation * (peak - compressed) + 1.0);
    return mix(vec3(compressed), matte * (compressed / peak), saturation);
}
#else
vec3 applyCurve(vec3 x) {
    return x;
}
#endif

vec3 encodeSrgb(vec3 linear) {
    vec3 powers = 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055;
    return mix(powers, 12.92 * linear, lessThanEqual(linear, vec3(0.0031308)));
}

void main() {
    vec3 exposed = texture(radiance, place).rgb * exposure;
    vec3 shown = clamp(applyCurve(exposed), 0.0, 1.0);
    codeValues = vec4(encodeSrgb(shown), 1.0);
}
