#pragma once

#include "prt/scene/scene.h"
#include "prt/transfer/transfer_field.h"

namespace prt {

/// The unshadowed transfer of every vertex, in closed form from its normal: one receiver a vertex.
TransferField makeUnshadowedTransfer(const Scene& scene, int bandCount);

/// The transfer matrices of every vertex as if nothing but its own horizon stood in the way of
/// light, ∫ y_i(R_x ω) y_j(ω) dω over the hemisphere about the normal, in closed form: one receiver
/// a vertex, in a layer Transport::glossyShadowed.
///
/// @param bandCount, incidentBandCount  n and n_in, n_in + n − 1 ≤ kMaxBandCount
TransferField makeUnshadowedMatrices(const Scene& scene, int bandCount, int incidentBandCount);

}  // namespace prt
