#pragma once

#include <span>
#include <vector>

#include "prt/gpu/gl_name.h"
#include "prt/gpu/gpu_radiance.h"
#include "prt/relight/exit_radiance.h"

namespace prt {

/// Radiance that has been made elsewhere: on the CPU by Relighter, which is faster than a
/// rasteriser on the same CPU would be, or of glossy materials towards an eye.
class GpuVertexRadiance final : public GpuRadiance {
  public:
    /// Black.
    /// @throws Error  as GpuRelighter
    explicit GpuVertexRadiance(std::size_t vertexCount, SharedGpuPrograms programs = {});

    std::size_t vertexCount() const override { return vertexCount_; }
    void use(const SurfaceFeatures& features) const override;
    bool hasMirrors() const override { return hasMirrors_; }

    /// @param vertexRadiance  B of every vertex, before base colour, W·sr⁻¹·m⁻²
    void upload(std::span<const Vec3f> vertexRadiance);
    /// @param vertexRadiance  of every vertex
    void upload(std::span<const ExitRadiance> vertexRadiance);

    /// What a compute shader is to write: of each vertex perBaseColor, mirrorVisibility, constant
    /// and a number that is not used.
    ///
    /// @param hasMirrors  whether a vertex may have mirrorVisibility
    const GlName& buffer(bool hasMirrors);

    std::vector<ExitRadiance> read() const;

  private:
    std::size_t vertexCount_;
    SurfacePrograms programs_;
    bool hasMirrors_ = false;
    GlName buffer_;
};

}  // namespace prt
