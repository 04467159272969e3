#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "prt/brdf/gltf_view_table.h"
#include "prt/gpu/gpu_radiance.h"
#include "prt/light/lighting.h"
#include "prt/relight/exit_radiance.h"
#include "prt/relight/glossy_relighter.h"
#include "prt/relight/receiver_surface.h"
#include "prt/transfer/compressed_transfer.h"

namespace prt {

/// One layer of matrices in the memory of the graphics card, shown to an eye as GlossyRelighter
/// shows it, to rounding. Compute shaders make what arrives at each receiver once a light, and what
/// the eye sees of it once an eye; only the light goes to the card.
class GpuGlossyRelighter final : public GpuRadiance {
  public:
    /// In darkness. All as GlossyRelighter has it.
    ///
    /// @param programs  may be shared
    /// @throws Error    invalidOption if there is no such layer; limitExceeded for a layer larger
    ///                  than the driver lets a shader read; unsupported, outOfMemory
    GpuGlossyRelighter(const CompressedTransfer& transfer, Transport transport,
                       std::span<const ReceiverSurface> receivers, const GltfViewTable& views,
                       const GlossyRelightOptions& options = {}, SharedGpuPrograms programs = {});
    ~GpuGlossyRelighter() override;
    GpuGlossyRelighter(GpuGlossyRelighter&&) noexcept;
    GpuGlossyRelighter& operator=(GpuGlossyRelighter&&) noexcept;

    std::size_t vertexCount() const override;
    int bandCount() const;  ///< of light

    /// The light as it arrives; seen from the next lookFrom() on.
    ///
    /// @param lighting  in the object's frame, with at most bandCount() bands
    void relight(const Lighting& lighting);

    /// What the eye sees of it. @param eye  in the object's frame
    void lookFrom(const Vec3f& eye);

    void use(const SurfaceFeatures& features) const override;
    bool hasMirrors() const override;

    /// What each vertex sends, read back.
    std::vector<ExitRadiance> read() const;

  private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace prt
