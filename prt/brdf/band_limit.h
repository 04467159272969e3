#pragma once

#include <optional>

#include "prt/brdf/brdf_matrix.h"
#include "prt/brdf/horizon_fit.h"

namespace prt {

/// What bands lose of a BRDF: the L2 norm of the difference between g(ω_i, ω_o) = f_r max(cos θ_i,
/// 0) and what its coefficients say, over the norm of g, all channels together.
struct BandLimitError {
    /// With bands for ω_i alone, fitted above the horizon as tables of views have them
    /// (GltfViewTable), there and for all views above it: how well the lobe itself is held. It has
    /// a floor, at the roughest, in lobes that end at the horizon.
    double incident = 0.0;
    /// With bands for both, as projectBrdf has them, over all directions. g is 0 below the horizon,
    /// and the coefficients spend much on that step: 0.25 of a Lambert BRDF at 5 bands.
    double matrix = 0.0;
};

BandLimitError measureBandLimitError(const Brdf& brdf, const BrdfProjectionOptions& options = {});

/// The least roughness at which n bands hold a GGX lobe (F = 1) with a BandLimitError::incident of
/// at most maxError; nothing if they do not at roughness 1. What is smoother is better split off.
///
/// @param maxError  > 0
std::optional<double> findLeastRoughnessHeld(int bandCount, double maxError,
                                             const LobeQuadratureOptions& quadrature = {});

/// A lobe that loses more than this is like a mirror to its bands. Copper of roughness ½ in 5 bands
/// under a probe, 0.56, errs by a third as much in its bands as split off; of 0.3, 0.90, by ten
/// times as much.
inline constexpr double kMostLobeError = 0.65;

/// The least roughness that is shown with n bands, what is smoother being split off: with an error
/// of at most kMostLobeError, or 1 where no roughness is.
double leastRoughnessHeld(int bandCount);

}  // namespace prt
