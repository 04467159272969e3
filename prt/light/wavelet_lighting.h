#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "prt/basis/haar_selection.h"
#include "prt/light/environment.h"

namespace prt {

/// Distant lighting in Haar wavelets on the six faces of a cube, each of S × S texels [Ng03].
///
/// The coefficients are those of radiance, orthonormal with respect to the sum over texels (see
/// prt/basis/haar.h). The solid angle of the texels is left to the transport:
///
///   ∫ L(ω) T(ω) dω = Σ_t L_t ∫_t T dω = Σ_i L_i T_i,   T_i = Σ_t ψ_i(t) ∫_t T dω
///
/// exactly, if radiance is constant in each texel t. So lighting stays an image, in which a
/// constant is six coefficients and products are those of multiplyHaar, and T_i is what rays give
/// that add their weight to the texel they escape through. What least squared error means is over
/// texels, of which a corner one has 3^(−3/2) of the solid angle of one in the middle of a face.
struct WaveletLighting {
    int faceSize = 0;  ///< S, a power of two
    /// 6 S², W·sr⁻¹·m⁻²; function i of face f, in the order of SphereMap::verticalStrip, has index
    /// f S² + i.
    std::vector<Vec3f> coefficients;
};

/// The same with what is left of it after a selection.
struct SparseWaveletLighting {
    int faceSize = 0;
    std::vector<SparseCoefficient> coefficients;  ///< ascending index
};

/// @param environment  a vertical strip whose faces have a power of two of texels on each side, as
///                     resample makes of any other
WaveletLighting projectWavelets(const Environment& environment);

/// The way back, to a vertical strip; approximations may be negative in places.
Environment reconstructCube(const WaveletLighting& lighting);

/// The N largest coefficients, by the same weights as the function on coefficients.
SparseWaveletLighting selectLargest(const WaveletLighting& lighting, std::size_t count,
                                    std::span<const float> weights = {});

/// All coefficients, 0 where none was kept.
WaveletLighting expand(const SparseWaveletLighting& lighting);

/// Coefficients of a transport function, with the solid angle of the texels in them.
///
/// @param faceSize  S, a power of two
/// @param transfer  T at the centres of the 6 S² texels of a vertical strip, row-major
/// @return          6 S², steradians times the unit of T; index as in WaveletLighting
std::vector<float> projectWaveletTransfer(int faceSize, std::span<const float> transfer);

/// ∫ L T dω: the sum over the coefficients that were kept.
///
/// @param transfer  6 S² coefficients with solid angle, as of projectWaveletTransfer
Vec3d integrateProduct(const SparseWaveletLighting& lighting, std::span<const float> transfer);

}  // namespace prt
