#version 430 core
// What a surface point sends to the eye: base colour times B (or what shines beside it), and what it emits. Linear,
// unclamped.

in vec3 radiancePerBaseColor;
in vec3 constantRadiance;
in vec4 uvs;
in vec4 vertexColor;

layout(location = 16) uniform vec4 baseColorFactor;
layout(location = 17) uniform vec3 emissiveFactor;
layout(location = 18) uniform ivec2 textureUvSets;  // of base colour and emission: 0 or 1
layout(location = 19) uniform float alphaCutoff;    // below it there is no surface
layout(location = 20) uniform float lineRadiance;   // brighter surfaces get dark lines, others bright ones; 0: no lines
layout(binding = 0) uniform sampler2D baseColorTexture;
layout(binding = 1) uniform sampler2D emissiveTexture;

layout(location = 0) out vec4 exitRadiance;

vec4 sampleTexture(sampler2D image, int uvSet) {
    return texture(image, uvSet == 1 ? uvs.zw : uvs.xy);
}

// Tells a line from the surface that it lies on.
vec3 contrast(vec3 surface) {
    float brightness = dot(surface, vec3(0.2126, 0.7152, 0.0722));
    return brightness > lineRadiance ? 0.25 * surface : surface + lineRadiance;
}

void main() {
    vec4 baseColor = baseColorFactor * vertexColor * sampleTexture(baseColorTexture, textureUvSets.x);
    if (baseColor.a < alphaCutoff) discard;
    vec3 emitted = emissiveFactor * sampleTexture(emissiveTexture, textureUvSets.y).rgb;
    vec3 reflected = clamp(baseColor.rgb, 0.0, 1.0) * radiancePerBaseColor + constantRadiance;
    vec3 sent = reflected + emitted;
    exitRadiance = vec4(lineRadiance > 0.0 ? contrast(sent) : sent, 1.0);
}
