#version 430 core
// Light from infinity where no surface is: a lat-long environment.

in vec2 place;

// In the environment's own axes: the middle of the picture, and from there to its right and its upper edge.
layout(location = 0) uniform vec3 forward;
layout(location = 1) uniform vec3 rightward;
layout(location = 2) uniform vec3 upward;
layout(binding = 0) uniform sampler2D environment;

layout(location = 0) out vec4 radiance;

vec3 lookUpLatLong(sampler2D environment, vec3 direction);

void main() {
    vec3 direction = forward + (2.0 * place.x - 1.0) * rightward + (2.0 * place.y - 1.0) * upward;
    radiance = vec4(lookUpLatLong(environment, direction), 0.0);
}
