#version 430 core
// Lays a picture of code values times coverage over another, on a disc that dims what is behind it.

in vec2 place;

layout(location = 0) uniform ivec2 corner;   // of the viewport, in pixels of what is drawn to
layout(location = 1) uniform vec4 discColor;  // of the disc that fills the viewport, times coverage
layout(binding = 0) uniform sampler2D overlay;

layout(location = 0) out vec4 shown;

void main() {
    vec4 over = texelFetch(overlay, ivec2(gl_FragCoord.xy) - corner, 0);
    float fromMiddle = length(2.0 * place - 1.0);
    float inDisc = clamp((1.0 - fromMiddle) / max(fwidth(fromMiddle), 1e-6), 0.0, 1.0);
    shown = over + (1.0 - over.a) * inDisc * discColor;
}
