#version 430 core
// What a lobe looks like: its colours under a lamp that goes with the camera, as code values times coverage.

centroid in vec3 cameraNormal;    // to the right, up, and towards the eye
centroid in vec4 colorOfValue;    // linear; and the signed value
centroid in float distanceAhead;  // along the camera's axis
flat in float cornerAhead;        // of a corner of the triangle

layout(location = 16) uniform vec3 negativeColor;
layout(location = 17) uniform vec2 sceneDepths;  // nearest and farthest, in the lobe's unit; 0: there is no scene
layout(location = 18) uniform ivec2 sceneCorner;  // pixel of the scene where this picture begins
layout(location = 19) uniform float longestEdge;  // of all triangles
layout(binding = 0) uniform sampler2D sceneDepth;

layout(location = 0) out vec4 shown;

// Along the camera's axis, of a pixel in which a lobe enters a surface.
const float kWidestEntry = 0.02;

// How far the scene is behind the lobe, along the camera's axis.
float gapToScene() {
    float depth = texelFetch(sceneDepth, ivec2(gl_FragCoord.xy) + sceneCorner, 0).r;
    float range = sceneDepths.y - sceneDepths.x;
    float distanceToScene = sceneDepths.x * sceneDepths.y / (sceneDepths.y - depth * range);
    // Of triangles seen edge-on, rasterisers do not interpolate well.
    float lobeDistance = clamp(distanceAhead, cornerAhead - longestEdge, cornerAhead + longestEdge);
    return depth < 1.0 ? distanceToScene - lobeDistance : 1e6;
}

vec3 encodeSrgb(vec3 linear) {
    vec3 powers = 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055;
    return mix(powers, 12.92 * linear, lessThanEqual(linear, vec3(0.0031308)));
}

void main() {
    float coverage = 1.0;
    if (sceneDepths.y > 0.0) {
        float gap = gapToScene();
        // Smooth where it enters a surface, and not where a surface far behind it ends.
        coverage = clamp(gap / clamp(fwidth(gap), 1e-6, kWidestEntry) + 0.5, 0.0, 1.0);
        if (coverage <= 0.0) discard;
    }
    vec3 normal = normalize(cameraNormal);
    vec3 lamp = normalize(vec3(-0.5, 0.7, 0.6));
    float lit = pow(0.5 + 0.5 * dot(normal, lamp), 2.0);
    float sheen = 0.15 * pow(max(dot(normal, normalize(lamp + vec3(0.0, 0.0, 1.0))), 0.0), 40.0);
    float rim = 0.25 * pow(1.0 - abs(normal.z), 3.0);
    vec3 color = colorOfValue.a < 0.0 ? negativeColor : colorOfValue.rgb;
    vec3 linear = clamp(color * (0.06 + lit + rim) + sheen, 0.0, 1.0);
    shown = coverage * vec4(encodeSrgb(linear), 1.0);
}
