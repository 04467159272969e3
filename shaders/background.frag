#version 430 core
// Light from infinity where no surface is: a lat-long environment, bilinear between the centres of its texels.

in vec2 place;

// In the environment's own axes: the middle of the picture, and from there to its right and its upper edge.
layout(location = 0) uniform vec3 forward;
layout(location = 1) uniform vec3 rightward;
layout(location = 2) uniform vec3 upward;
layout(binding = 0) uniform sampler2D environment;

layout(location = 0) out vec4 radiance;

const float kPi = 3.14159265358979;

void main() {
    vec3 direction = forward + (2.0 * place.x - 1.0) * rightward + (2.0 * place.y - 1.0) * upward;
    // The angle from +y by both its sine and its cosine: exact at the poles too.
    float polar = atan(length(direction.xz), direction.y);
    float azimuth = direction.x == 0.0 && direction.z == 0.0 ? 0.0 : atan(direction.z, direction.x);
    radiance = vec4(textureLod(environment, vec2(0.5 + azimuth / (2.0 * kPi), polar / kPi), 0.0).rgb, 0.0);
}
