#pragma once

#include "prt/transfer/compressed_transfer.h"

namespace prt {

/// How far the coefficients of one layer are from those of another.
struct CompressionError {
    double rmse = 0.0;          ///< over all receivers, channels and coefficients
    double relativeRmse = 0.0;  ///< over the root mean square of the original; 0 if that is 0
    double largest = 0.0;       ///< of a single coefficient
};

/// Measures what reading the stored numbers back gives.
///
/// @param compressed, original  of the same receivers, channels and coefficients
CompressionError measureCompressionError(const CompressedLayer& compressed,
                                         const CompressedLayer& original);

}  // namespace prt
