#pragma once

#include <cstddef>

#include "prt/gpu/gl_name.h"

namespace prt {

/// How many items a work group of our compute shaders has along x.
inline constexpr std::size_t kComputeGroupSize = 64;

/// @param itemCount     that a compute shader is to be run for
/// @param largestBytes  of a buffer that it will read or write
/// @throws Error        limitExceeded where these are more than the driver lets a shader have
void requireComputed(std::size_t itemCount, std::size_t largestBytes);

void bindBuffer(unsigned place, const GlName& buffer);

/// Runs the compute shader that is current, with the buffers that are bound. What it writes is seen
/// by shaders that run after it.
///
/// @param rowCount  how many times for each item, in y
void computeFor(std::size_t itemCount, std::size_t rowCount = 1);

}  // namespace prt
