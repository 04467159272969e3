#pragma once

#include "prt/transfer/compressed_transfer.h"

namespace prt {

/// @throws Error  invalidOption if there is no such layer, with those that there are
const CompressedLayer& requireLayer(const CompressedTransfer& transfer, Transport transport);

}  // namespace prt
