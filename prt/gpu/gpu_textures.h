#pragma once

#include <array>
#include <optional>
#include <vector>

#include "prt/gpu/gl_name.h"
#include "prt/scene/scene.h"

namespace prt {

/// The colours that materials look up, in the memory of the graphics card, without levels of
/// detail.
class GpuTextures {
  public:
    /// Of the images that base colour and emission use.
    /// @throws Error  limitExceeded for an image larger than the driver takes, outOfMemory
    explicit GpuTextures(const Scene& scene);

    /// @param texture  none is white
    void bind(unsigned unit, const std::optional<TextureUse>& texture) const;

  private:
    std::vector<GlName> images_;  ///< one an image of the scene; 0 where none is needed
    GlName white_;
    std::array<GlName, 18> samplers_;  ///< [wrapU][wrapV][filter]
};

}  // namespace prt
