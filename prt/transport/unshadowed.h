#pragma once

#include "prt/scene/scene.h"
#include "prt/transfer/transfer_field.h"

namespace prt {

/// The unshadowed transfer of every vertex, in closed form from its normal: one receiver a vertex.
TransferField makeUnshadowedTransfer(const Scene& scene, int bandCount);

}  // namespace prt
