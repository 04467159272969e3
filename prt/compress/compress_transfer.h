#pragma once

#include "prt/transfer/compressed_transfer.h"

namespace prt {

struct CompressOptions {
    TransferEncoding encoding = TransferEncoding::unorm16;
};

/// Stores each coefficient in fewer bits, its range over all receivers mapped to the integers
/// [Kautz04, storage].
///
/// The error of a coefficient is at most half a step: its range / 131070 for unorm16, / 510 for
/// unorm8. float32 stores the numbers as they are.
///
/// @param field  its layers go as they are compressed: whoever needs it still passes a copy
CompressedTransfer compressTransfer(TransferField field, const CompressOptions& options = {});

}  // namespace prt
