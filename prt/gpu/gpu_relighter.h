#pragma once

#include <cstddef>
#include <memory>

#include "prt/gpu/gpu_radiance.h"
#include "prt/light/lighting.h"
#include "prt/transfer/compressed_transfer.h"

namespace prt {

/// The transfer of one layer in the memory of the graphics card, and the light it is seen in.
///
///   B(x) = Σ_i T_i(x) L_i                                                            [Sloan02]
///
/// is summed at each vertex that is drawn, from numbers as they are stored: their scale and bias
/// go into the light. With clusters, R_kp = Σ_i b_kp,i L_i is made here once a light, and a vertex
/// adds w_p(x) R_kp up [Sloan03]. Agrees with Relighter to rounding.
class GpuRelighter final : public GpuRadiance {
  public:
    /// In darkness.
    ///
    /// @param transfer   whose layers are as large as its counts say
    /// @param transport  of vectors, a layer that `transfer` has
    /// @param programs   may be shared
    /// @throws Error     invalidOption if there is no such layer; unsupported for matrices, and
    ///                   where vertex shaders cannot read buffers; limitExceeded for a layer larger
    ///                   than the driver lets a shader read; outOfMemory
    GpuRelighter(const CompressedTransfer& transfer, Transport transport,
                 SharedGpuPrograms programs = {});
    ~GpuRelighter() override;
    GpuRelighter(GpuRelighter&&) noexcept;
    GpuRelighter& operator=(GpuRelighter&&) noexcept;

    std::size_t vertexCount() const override;
    int bandCount() const;

    /// Nothing but what the light makes goes to the card.
    ///
    /// @param lighting  in the object's frame, with at most bandCount() bands; higher bands of the
    ///                  transfer go unused
    void relight(const Lighting& lighting);

    void use(const SurfaceFeatures& features) const override;

  private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace prt
