#pragma once

#include <array>

#include "prt/gpu/gpu_target.h"
#include "prt/gpu/screen_pass.h"
#include "prt/image/tone_curve.h"

namespace prt {

/// Shows linear radiance as pictures for the screen, as encodeForDisplay makes them to rounding.
class GpuDisplay {
  public:
    GpuDisplay();

    /// Draws a picture over the viewport of the framebuffer that is bound, pixel for pixel where
    /// they are of the same size. Leaves depth test, culling and blending off.
    ///
    /// @param columns  of the viewport, which are drawn; the others stay as they are
    void draw(const GpuTarget& radiance, const DisplayOptions& options = {},
              const PixelColumns& columns = {}) const;

  private:
    std::array<ScreenPass, 3> passes_;  ///< of each ToneCurve
};

}  // namespace prt
