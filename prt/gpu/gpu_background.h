#pragma once

#include "prt/gpu/screen_pass.h"
#include "prt/gpu/view_frame.h"
#include "prt/light/environment.h"
#include "prt/math/transform.h"

namespace prt {

/// Light from infinity in the memory of the graphics card, seen as lookUpRadiance says; a card may
/// know no more than 256 places between two texels.
class GpuBackground {
  public:
    /// @param environment  a lat-long map (resample makes one of any other)
    /// @throws Error       limitExceeded for one larger than the driver takes, outOfMemory
    explicit GpuBackground(const Environment& environment);

    /// Draws it where nothing has been drawn to the framebuffer that is bound. Leaves culling and
    /// blending off.
    ///
    /// @param worldFromBackground  a rotation: L(R⁻¹ω)
    void draw(const ViewFrame& view, const Mat3d& worldFromBackground) const;

  private:
    ScreenPass pass_;
    GlName texture_;
};

}  // namespace prt
