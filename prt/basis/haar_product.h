#pragma once

#include <span>

#include "prt/basis/haar.h"

namespace prt {

/// The product integral of three Haar functions on the unit square, where they are orthonormal with
/// respect to ∫dxdy [Ng04, the Haar tripling coefficient theorem]:
///
///   C_ijk = ∫ Ψ_i Ψ_j Ψ_k dxdy
///         = 1       if all three are the scaling function, or one is and the others are the same
///                   wavelet;
///         = 2^l     for the three types of wavelet on one square of level l;
///         = ±2^l    for a wavelet twice and a coarser one, of level l, whose square holds theirs:
///                   the sign that it has there;
///         = 0       otherwise.
///
/// On S² texels, with the normalisation of projectHaar, Σ_t ψ_i ψ_j ψ_k = C_ijk / S.
///
/// @param i, j, k  indices as haarIndex; in any order
double haarTriplingCoefficient(int i, int j, int k);

/// Multiplies two functions by their coefficients, texel by texel:
///
///   c_k = Σ_t f(t) g(t) ψ_k(t) = 1/S Σ_ij a_i b_j C_ijk
///
/// In time linear in the coefficients, by what coarser wavelets add up to on each square and the
/// energy of finer ones in it [Ng04, section 5]. Nothing is lost: S² functions hold every product.
///
/// @param a, b     S² coefficients each, as of projectHaar; S a power of two
/// @param product  S² numbers, written; must not overlap a or b
void multiplyHaar(std::span<const float> a, std::span<const float> b, std::span<float> product);

/// The triple product integral Σ_t f(t) g(t) h(t) = Σ_k (ab)_k c_k of lighting, visibility and
/// reflectance, for instance. For an integral over the sphere, one of the three is multiplied by
/// the solid angles of the texels before its projection.
///
/// @param a, b, c  S² coefficients each
double integrateHaarTriple(std::span<const float> a, std::span<const float> b,
                           std::span<const float> c);

}  // namespace prt
