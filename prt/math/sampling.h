#pragma once

#include <cstdint>

#include "prt/math/vector.h"

namespace prt {

/// A point of the unit square as two 32-bit fractions.
struct SquareBits {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
};

/// Point `index` of the two-dimensional Sobol sequence: each of its blocks of 2^k points is a (0,
/// 2)-net [Sobol67].
SquareBits sobolPoint(std::uint32_t index);

/// Owen's nested uniform scrambling of one coordinate, by a hash that only lets higher bits decide
/// over lower ones [Owen95; Burley20; Vegdahl21]. Every seed gives an unbiased net of its own.
std::uint32_t owenScramble(std::uint32_t bits, std::uint32_t seed);

/// The same on a coordinate whose bits are already reversed, giving reversed bits: the part that is
/// worth sharing when many points are scrambled.
constexpr std::uint32_t owenScrambleReversed(std::uint32_t reversedBits, std::uint32_t seed) {
    std::uint32_t bits = reversedBits;
    bits ^= bits * 0x3d20adeau;
    bits += seed;
    bits *= (seed >> 16) | 1u;
    bits ^= bits * 0x05526c56u;
    bits ^= bits * 0x53a22864u;
    return bits;
}

std::uint32_t reverseBits(std::uint32_t bits);

/// The middle of the 2⁻²³ wide cell that the bits lie in: inside (0, 1), and never exactly ½.
constexpr float unitFloatFromBits(std::uint32_t bits) {
    return (static_cast<float>(bits >> 9) + 0.5f) * 0x1p-23f;
}

/// Cosine-distributed direction in the hemisphere about +z: cos² θ = 1 − u, φ = π (2v − 1).
///
/// Chosen over the concentric map of the disc [Shirley97], whose creases along the diagonals cost
/// scrambled nets a quarter of their order of convergence on smooth functions.
///
/// @param u, v  in (0, 1)
Vec3f sampleCosineHemisphere(float u, float v);

/// Its density, cos θ / π per steradian; 0 below the horizon.
float cosineHemispherePdf(const Vec3f& direction);

/// Uniform direction in the hemisphere about +z: cos θ = 1 − u, φ = π (2v − 1).
///
/// @param u, v  in (0, 1)
Vec3f sampleUniformHemisphere(float u, float v);

/// Its density, 1/2π per steradian; 0 below the horizon.
float uniformHemispherePdf(const Vec3f& direction);

/// Uniform direction: cos θ = 1 − 2u, φ = 2πv [Kautz04].
Vec3f sampleUniformSphere(float u, float v);

/// Its density, 1/4π per steradian.
float uniformSpherePdf();

}  // namespace prt
