#pragma once

#include <cstddef>

#include "prt/gpu/surface_programs.h"

namespace prt {

/// What the vertices of a scene send to the eye, in the memory of the graphics card.
class GpuRadiance {
  public:
    virtual ~GpuRadiance() = default;
    virtual std::size_t vertexCount() const = 0;
    /// Makes its program of these features current, with its buffers.
    /// @throws Error  unsupported where the driver refuses the program
    virtual void use(const SurfaceFeatures& features) const = 0;
    /// Whether a vertex may show GpuMirrors.
    virtual bool hasMirrors() const { return false; }
};

}  // namespace prt
