#pragma once

#include <cstdint>

#include "prt/parallel/progress.h"
#include "prt/scene/scene.h"
#include "prt/transfer/transfer_field.h"

namespace prt {

struct InterpolationErrorOptions {
    std::size_t pointCount = 10'000;  ///< spread over the scene's surface by area
    int sampleCount = 4096;           ///< rays a point, 16 … 65536
    std::uint64_t seed = 2;  ///< another than the bake's, or the same noise is on both sides
    int threadCount = 0;     ///< 0: one a core
    ProgressCallback progress{};
};

/// How far interpolated transfer is from computed transfer, ‖T_interpolated − T(x)‖, over the
/// surface, in units of ‖T_open‖, the transfer of a surface that sees the whole sky.
struct InterpolationError {
    double rms = 0.0;
    double percentile99 = 0.0;
};

/// Measures what a bake's vertices are worth: shadowed transfer is computed at random points of
/// the surface and compared with what is interpolated there between the corners of the triangle.
///
/// @param field   baked from the scene, with a shadowed layer
/// @throws Error  invalidOption, cancelled
InterpolationError measureInterpolationError(const Scene& scene, const TransferField& field,
                                             const InterpolationErrorOptions& options = {});

/// ‖T_open‖, the unit of transfer errors.
double openTransferNorm(int bandCount);

}  // namespace prt
