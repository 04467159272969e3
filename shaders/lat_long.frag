#version 430 core
// Looks light from infinity up in a lat-long environment, bilinear between the centres of its texels: its sampler blends
// them, and repeats them to the left and right.

const float kPi = 3.14159265358979;

// direction: in the environment's own axes, of any length
vec3 lookUpLatLong(sampler2D environment, vec3 direction) {
    // The angle from +y by both its sine and its cosine: exact at the poles too.
    float polar = atan(length(direction.xz), direction.y);
    float azimuth = direction.x == 0.0 && direction.z == 0.0 ? 0.0 : atan(direction.z, direction.x);
    return textureLod(environment, vec2(0.5 + azimuth / (2.0 * kPi), polar / kPi), 0.0).rgb;
}
