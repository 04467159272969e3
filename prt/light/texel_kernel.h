#pragma once

#include <cstddef>
#include <span>

#include "prt/math/vector.h"

namespace prt {

/// Texels that stand side by side in an image, and where they lie on the sphere.
struct alignas(64) TexelBlock {
    static constexpr std::size_t kSize = 16;
    float x[kSize] = {}, y[kSize] = {}, z[kSize] = {};  ///< unit directions
    float solidAngle[kSize] = {};                       ///< steradians; 0 where nothing is shown
};

/// Sums L y_i dω over texels, with the widest vectors of the machine: in floats over a thousand
/// texels, then in doubles.
///
/// @param firstTexels   where in the image each block begins
/// @param radiance      of the image; where nothing is shown it may hold anything
/// @param bandCount     n in [1, kMaxBandCount]
/// @param coefficients  n², added to
void projectTexelBlocks(std::span<const TexelBlock> blocks,
                        std::span<const std::size_t> firstTexels, std::span<const Vec3f> radiance,
                        int bandCount, std::span<Vec3d> coefficients);

}  // namespace prt
