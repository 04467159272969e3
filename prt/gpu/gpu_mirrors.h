#pragma once

#include <vector>

#include "prt/gpu/gl_name.h"
#include "prt/render/mirror_shading.h"

namespace prt {

/// What mirror-like surfaces show of light from infinity, in the memory of the graphics card; as
/// showMirrored says, to rounding.
class GpuMirrors {
  public:
    /// @param environment  made by makeMirrorEnvironment of a lat-long map
    /// @throws Error       limitExceeded for one larger than the driver takes, outOfMemory
    explicit GpuMirrors(const MirrorEnvironment& environment);

    /// Turns the light. @param worldFromEnvironment  a rotation: L(R⁻¹ω)
    void turn(const Mat3d& worldFromEnvironment) { worldFromEnvironment_ = worldFromEnvironment; }

    /// Makes it what the surfaces of the program that is current mirror, which is that of a
    /// GpuRadiance that hasMirrors.
    ///
    /// @param worldFromObject  a rotation
    void use(const Mat3d& worldFromObject) const;

  private:
    std::vector<float> roughnesses_;
    Mat3d worldFromEnvironment_;
    GlName environment_;  ///< of roughness 0
    GlName mirrors_;      ///< of the others
    GlName specularAlbedos_;
    GlName environmentSampler_;
    GlName sampler_;  ///< of texels that the shader blends itself
};

}  // namespace prt
