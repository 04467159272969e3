#pragma once

#include "prt/transfer/compressed_transfer.h"

namespace prt {

struct CompressOptions {
    TransferEncoding encoding = TransferEncoding::unorm16;
};

/// Stores each coefficient in fewer bits: the columns of each layer as quantiseTable does.
///
/// @param field  its layers go as they are compressed: whoever needs it still passes a copy
CompressedTransfer compressTransfer(TransferField field, const CompressOptions& options = {});

}  // namespace prt
