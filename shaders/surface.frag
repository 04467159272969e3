#version 430 core
// What a surface point sends to the eye: base colour times B (or what shines beside it), and what it emits. Linear,
// unclamped.
//
// TEXTURED  defined: materials may have textures
// MIRRORED  defined: and what shines through mirrorVisibility
// LINED     defined: lines on surfaces instead of these

in vec3 radiancePerBaseColor;
in vec3 constantRadiance;
#ifdef TEXTURED
in vec4 uvs;
#endif
in vec4 vertexColor;
#ifdef MIRRORED
in float mirrorVisibility;
in vec3 surfaceNormal;
in vec3 towardsEye;
#endif

layout(location = 16) uniform vec4 baseColorFactor;
layout(location = 17) uniform vec3 emissiveFactor;
layout(location = 18) uniform ivec3 textureUvSets;  // of base colour, emission and metallic-roughness: 0 or 1
layout(location = 19) uniform float alphaCutoff;    // below it there is no surface
layout(location = 20) uniform float lineRadiance;   // brighter surfaces get dark lines, others bright ones
layout(location = 21) uniform vec2 metallicRoughnessFactors;
layout(binding = 0) uniform sampler2D baseColorTexture;
layout(binding = 1) uniform sampler2D emissiveTexture;
layout(binding = 2) uniform sampler2D metallicRoughnessTexture;

layout(location = 0) out vec4 exitRadiance;

#ifdef MIRRORED
vec3 showMirrored(vec3 normal, vec3 view, vec3 baseColor, vec2 surface);
#endif

vec4 sampleTexture(sampler2D image, int uvSet) {
#ifdef TEXTURED
    return texture(image, uvSet == 1 ? uvs.zw : uvs.xy);
#else
    return vec4(1.0);
#endif
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
    vec3 albedo = clamp(baseColor.rgb, 0.0, 1.0);
    vec3 reflected = albedo * radiancePerBaseColor + constantRadiance;
#ifdef MIRRORED
    vec2 texel = sampleTexture(metallicRoughnessTexture, textureUvSets.z).bg;
    vec2 surface = clamp(metallicRoughnessFactors * texel, 0.0, 1.0);
    vec3 normal = gl_FrontFacing ? surfaceNormal : -surfaceNormal;
    if (mirrorVisibility > 0.0) reflected += mirrorVisibility * showMirrored(normal, towardsEye, albedo, surface);
#endif
    vec3 sent = reflected + emitted;
#ifdef LINED
    sent = contrast(sent);
#endif
    exitRadiance = vec4(sent, 1.0);
}
