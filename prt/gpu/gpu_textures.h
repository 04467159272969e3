#pragma once

#include <array>
#include <optional>
#include <vector>

#include "prt/gpu/gl_name.h"
#include "prt/scene/surface_color.h"

namespace prt {

/// The textures that materials look up, in the memory of the graphics card, without levels of
/// detail.
class GpuTextures {
  public:
    /// @throws Error  limitExceeded for an image larger than the driver takes, outOfMemory
    explicit GpuTextures(const Scene& scene);

    /// @param texture  none is white
    void bind(unsigned unit, const std::optional<TextureUse>& texture,
              TexelCurve curve = TexelCurve::srgb) const;

  private:
    std::size_t placeOf(std::size_t image, TexelCurve curve) const;

    std::vector<GlName> images_;  ///< [curve][image of the scene]; 0 where none is needed
    GlName white_;
    std::array<GlName, 18> samplers_;  ///< [wrapU][wrapV][filter]
};

}  // namespace prt
