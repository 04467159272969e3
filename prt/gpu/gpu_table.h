#pragma once

#include <cstddef>

#include "prt/gpu/gl_name.h"
#include "prt/transfer/coefficient_table.h"

namespace prt {

/// Of a table in the memory of the graphics card, its last panel padded.
std::size_t gpuTableBytes(const CoefficientTable& table);

/// A table as it is, panel after panel: [panel][receiver][4].
///
/// @throws Error  outOfMemory
GlName uploadTable(const CoefficientTable& table);

}  // namespace prt
