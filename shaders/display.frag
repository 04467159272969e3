#version 430 core
// Turns linear radiance into sRGB code values: exposure, tone curve, encoding.

in vec2 place;

layout(location = 0) uniform float exposure;
layout(location = 1) uniform bool isAces;
layout(binding = 0) uniform sampler2D radiance;

layout(location = 0) out vec4 codeValues;

// Narkowicz' fit of the ACES filmic curve [Narkowicz15].
vec3 applyAces(vec3 x) {
    vec3 bounded = clamp(x, 0.0, 100.0);
    return bounded * (2.51 * bounded + 0.03) / (bounded * (2.43 * bounded + 0.59) + 0.14);
}

vec3 encodeSrgb(vec3 linear) {
    vec3 powers = 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055;
    return mix(powers, 12.92 * linear, lessThanEqual(linear, vec3(0.0031308)));
}

void main() {
    vec3 exposed = texture(radiance, place).rgb * exposure;
    vec3 shown = clamp(isAces ? applyAces(exposed) : exposed, 0.0, 1.0);
    codeValues = vec4(encodeSrgb(shown), 1.0);
}
