#pragma once

#include <vector>

#include "prt/light/lighting.h"
#include "prt/relight/relighter.h"

namespace prt {

struct ReceiverDeringingOptions {
    /// A receiver may be negative by so much of the light's mean radiance: the noise of the bake
    /// and of quantisation, which no window mends without taking the light along. 8-bit transfer
    /// needs some 1e-2.
    double tolerance = 1e-3;
};

/// The least Laplacian smoothing of a light under which no receiver of an asset reflects negative
/// radiance, in any channel [Sloan17]:
///
///   Σ_l w_l Σ_m T_lm(x) L_lm ≥ −tolerance · L_00 y_00        for every receiver x
///
/// Mostly less than the light itself needs, since a receiver averages over all that it sees. Holds
/// for this asset and this turn of the light. "The least" means what it does in light/deringing.h.
/// A channel whose mean is not positive, and a receiver that is negative under the mean alone by
/// more than the tolerance, cannot be helped and are left out.
///
/// Takes as long as a few times n relights.
///
/// @param lighting  in the object's frame, with at most relighter.bandCount() bands
/// @return          one factor a band of the light, the first 1
std::vector<double> deringingFactors(const Relighter& relighter, const Lighting& lighting,
                                     const ReceiverDeringingOptions& options = {});

}  // namespace prt
