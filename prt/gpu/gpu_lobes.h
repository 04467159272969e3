#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "prt/brdf/brdf_view_table.h"
#include "prt/brdf/gltf_view_table.h"
#include "prt/gpu/gpu_programs.h"
#include "prt/relight/receiver_lobes.h"
#include "prt/relight/receiver_surface.h"
#include "prt/transfer/compressed_transfer.h"

namespace prt {

/// What every receiver of an asset reflects to any view, in the memory of the graphics card:
/// ReceiverLobes there.
class GpuLobes {
  public:
    /// @param materialTables  one a material, null for those that glTF describes; or none
    /// @param programs        not null
    /// @throws Error          limitExceeded for more vertices than the driver lets a shader have,
    ///                        outOfMemory
    GpuLobes(const CompressedTransfer& transfer, std::span<const ReceiverSurface> receivers,
             const GltfViewTable& views,
             std::span<const std::shared_ptr<const BrdfViewTable>> materialTables,
             const LobeSplit& split, SharedGpuPrograms programs);

    /// Whether some receivers are split, and show what has bounced apart.
    bool hasSplit() const { return hasSplit_; }
    bool hasBounced() const { return hasBounced_; }

    /// Buffers of GpuMatrices::makeIncident().
    struct Incident {
        const GlName& all;
        const GlName& arriving;  ///< of white light, straight from it; where some are split
        const GlName& direct;    ///< of the light, straight from it; where some show bounces apart
    };

    /// @param eye    in the object's frame
    /// @param relit  of GpuVertexRadiance, written
    void reflect(const Vec3f& eye, const Incident& incident, const GlName& relit) const;

  private:
    std::size_t vertexCount_ = 0;
    bool hasSplit_ = false;
    bool hasBounced_ = false;
    std::size_t receiverCount_ = 0;
    std::vector<float> open_;  ///< the hemisphere, in zonal coefficients
    SharedGpuPrograms programs_;
    unsigned program_ = 0;
    GlName surfaces_;
    GlName vertices_;
    GlName elements_;
};

}  // namespace prt
