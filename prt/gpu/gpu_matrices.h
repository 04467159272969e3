#pragma once

#include <cstddef>
#include <memory>

#include "prt/gpu/gpu_programs.h"
#include "prt/light/lighting.h"
#include "prt/transfer/compressed_transfer.h"

namespace prt {

/// A layer of transfer matrices in the memory of the graphics card, from numbers as they are
/// stored. With clusters, R_kp = M_kp L is made on the CPU once a light.
class GpuMatrices {
  public:
    /// @param layer     of matrices, complete; not needed afterwards
    /// @param programs  not null
    /// @throws Error    limitExceeded for a layer larger than the driver lets a shader read,
    ///                  outOfMemory
    GpuMatrices(const CompressedTransfer& transfer, const CompressedLayer& layer,
                SharedGpuPrograms programs);
    ~GpuMatrices();
    GpuMatrices(GpuMatrices&&) noexcept;
    GpuMatrices& operator=(GpuMatrices&&) noexcept;

    /// A buffer for what arrives at all receivers: floats, [colour][incidentIndex][receiver].
    GlName makeIncident() const;

    /// @param lighting  in the object's frame, with at most as many bands as the layer
    /// @param incident  of makeIncident(), written
    void receive(const Lighting& lighting, const GlName& incident) const;

  private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace prt
