#pragma once

#include <cstddef>

namespace prt {

/// What the vertices of a scene send to the eye, in the memory of the graphics card.
class GpuRadiance {
  public:
    virtual ~GpuRadiance() = default;
    virtual std::size_t vertexCount() const = 0;
    /// Makes the program of shaders/relight.vert and surface.frag current, with its buffers.
    virtual void use() const = 0;
    /// Whether that program is one that wants to know GpuMirrors.
    virtual bool hasMirrors() const { return false; }
};

}  // namespace prt
