#include "prt/math/sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace prt {

std::uint32_t reverseBits(std::uint32_t bits) {
    bits = (bits >> 16) | (bits << 16);
    bits = ((bits & 0xff00ff00u) >> 8) | ((bits & 0x00ff00ffu) << 8);
    bits = ((bits & 0xf0f0f0f0u) >> 4) | ((bits & 0x0f0f0f0fu) << 4);
    bits = ((bits & 0xccccccccu) >> 2) | ((bits & 0x33333333u) << 2);
    return ((bits & 0xaaaaaaaau) >> 1) | ((bits & 0x55555555u) << 1);
}

SquareBits sobolPoint(std::uint32_t index) {
    // The first dimension is the radical inverse; the second's direction
    // numbers are Pascal's triangle mod 2.
    SquareBits point{reverseBits(index), 0};
    for (std::uint32_t direction = 0x80000000u; index != 0;
         index >>= 1, direction ^= direction >> 1)
        if (index & 1u) point.y ^= direction;
    return point;
}

std::uint32_t owenScramble(std::uint32_t bits, std::uint32_t seed) {
    return reverseBits(owenScrambleReversed(reverseBits(bits), seed));
}

Vec3f sampleCosineHemisphere(float u, float v) {
    const float radius = std::sqrt(u);
    const float phi = std::numbers::pi_v<float> * (2.0f * v - 1.0f);
    return {radius * std::cos(phi), radius * std::sin(phi), std::sqrt(1.0f - u)};
}

float cosineHemispherePdf(const Vec3f& direction) {
    return std::max(0.0f, direction.z) * std::numbers::inv_pi_v<float>;
}

Vec3f sampleUniformHemisphere(float u, float v) {
    const float radius = std::sqrt(u * (2.0f - u));
    const float phi = std::numbers::pi_v<float> * (2.0f * v - 1.0f);
    return {radius * std::cos(phi), radius * std::sin(phi), 1.0f - u};
}

float uniformHemispherePdf(const Vec3f& direction) {
    return direction.z < 0.0f ? 0.0f : std::numbers::inv_pi_v<float> / 2.0f;
}

Vec3f sampleUniformSphere(float u, float v) {
    const float cosTheta = 1.0f - 2.0f * u;
    const float sinTheta = std::sqrt(std::max(0.0f, 1.0f - cosTheta * cosTheta));
    const float phi = 2.0f * std::numbers::pi_v<float> * v;
    return {sinTheta * std::cos(phi), sinTheta * std::sin(phi), cosTheta};
}

float uniformSpherePdf() {
    return std::numbers::inv_pi_v<float> / 4.0f;
}

}  // namespace prt
