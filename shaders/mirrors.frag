#version 430 core
// What mirror-like surfaces show of light from infinity: its mean over a lobe about the mirrored view r, times the
// share that is reflected.
//
//   S(r, roughness) ∫ f_r(ω_i, ω_o) max(cos θ_i, 0) dω_i                    [Karis13]

layout(location = 22) uniform mat3 environmentFromObject;
layout(location = 23) uniform int levelCount;  // of roughness, ascending from 0
layout(location = 32) uniform float roughnesses[16];
layout(binding = 3) uniform sampler2D environment;       // of roughness 0, lat-long
layout(binding = 4) uniform sampler2DArray mirrors;      // of the others: six faces one below another
layout(binding = 5) uniform sampler2D specularAlbedos;   // [view][roughness]: F0 = 0, F0 = 1

const float kPi = 3.14159265358979;
const float kDielectricF0 = 0.04;
const float kLowestViewCosine = 1e-4;

vec3 lookUpLatLong(sampler2D environment, vec3 direction);

vec3 lookUpFaces(vec3 direction, int level) {
    vec3 d = direction;
    vec3 size = abs(d);
    int face;
    vec3 place;  // to the right, down, forward
    if (size.x >= size.y && size.x >= size.z) {
        face = d.x > 0.0 ? 0 : 1;
        place = vec3(d.x > 0.0 ? -d.z : d.z, -d.y, size.x);
    } else if (size.y >= size.z) {
        face = d.y > 0.0 ? 2 : 3;
        place = vec3(d.x, d.y > 0.0 ? d.z : -d.z, size.y);
    } else {
        face = d.z > 0.0 ? 4 : 5;
        place = vec3(d.z > 0.0 ? d.x : -d.x, -d.y, size.z);
    }
    int faceSize = textureSize(mirrors, 0).x;
    vec2 pixel = 0.5 * float(faceSize) * (1.0 + place.xy / place.z) - 0.5;
    ivec2 low = ivec2(floor(pixel));
    vec2 weight = pixel - vec2(low);
    ivec2 first = clamp(low, 0, faceSize - 1);
    ivec2 last = clamp(low + 1, 0, faceSize - 1);
    int top = face * faceSize;
    vec3 upper = mix(texelFetch(mirrors, ivec3(first.x, top + first.y, level), 0).rgb,
                     texelFetch(mirrors, ivec3(last.x, top + first.y, level), 0).rgb, weight.x);
    vec3 lower = mix(texelFetch(mirrors, ivec3(first.x, top + last.y, level), 0).rgb,
                     texelFetch(mirrors, ivec3(last.x, top + last.y, level), 0).rgb, weight.x);
    return mix(upper, lower, weight.y);
}

vec3 lookUpMirror(vec3 direction, float roughness) {
    int rougher = 1;
    while (rougher < levelCount - 1 && roughnesses[rougher] <= roughness) ++rougher;
    float low = roughnesses[rougher - 1];
    float share = min((roughness - low) / (roughnesses[rougher] - low), 1.0);
    vec3 smoother =
        rougher == 1 ? lookUpLatLong(environment, direction) : lookUpFaces(direction, rougher - 2);
    return mix(smoother, lookUpFaces(direction, rougher - 1), share);
}

// The table stands finer towards the horizon.
vec3 evaluateAlbedo(vec3 f0, float roughness, float cosine) {
    float rest = min(asin(clamp(cosine, 0.0, 1.0)) * (2.0 / kPi), 1.0);
    ivec2 last = textureSize(specularAlbedos, 0) - 1;
    vec2 position = vec2(1.0 - sqrt(rest), roughness) * vec2(last);
    ivec2 low = min(ivec2(position), last - 1);
    vec2 weight = position - vec2(low);
    vec2 smoother = mix(texelFetch(specularAlbedos, low, 0).rg,
                        texelFetch(specularAlbedos, low + ivec2(1, 0), 0).rg, weight.x);
    vec2 rougher = mix(texelFetch(specularAlbedos, low + ivec2(0, 1), 0).rg,
                       texelFetch(specularAlbedos, low + ivec2(1, 1), 0).rg, weight.x);
    vec2 both = mix(smoother, rougher, weight.y);
    return both.x + f0 * (both.y - both.x);
}

// normal, view: along the object's axes, of any length
// surface:      metallic, roughness
vec3 showMirrored(vec3 normal, vec3 view, vec3 baseColor, vec2 surface) {
    vec3 n = normalize(normal);
    vec3 towardsEye = normalize(view);
    float cosine = dot(n, towardsEye);
    if (cosine < kLowestViewCosine) {  // the normal leans away
        vec3 along = towardsEye - cosine * n;
        towardsEye = normalize(along / max(length(along), 1e-20) + kLowestViewCosine * n);
        cosine = kLowestViewCosine;
    }
    vec3 mirrored = environmentFromObject * (2.0 * cosine * n - towardsEye);
    vec3 f0 = mix(vec3(kDielectricF0), baseColor, surface.x);
    return lookUpMirror(mirrored, surface.y) * evaluateAlbedo(f0, surface.y, cosine);
}
