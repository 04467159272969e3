#pragma once

#include <cstddef>
#include <vector>

#include "prt/light/environment.h"
#include "prt/light/texel_kernel.h"

namespace prt {

/// Projects environments of one layout and size onto SH, frame after frame of a video: where their
/// texels lie is found out once.
class EnvironmentProjector {
  public:
    /// @param width, height  such as fit the map
    /// @param bandCount      n in [1, kMaxBandCount]
    EnvironmentProjector(SphereMap map, int width, int height, int bandCount);

    /// What projectLighting gives: of lat-long images the same bits, as it has them soon; of others
    /// up to the rounding of floats. On one thread.
    ///
    /// @param radiance  of that size, every texel finite
    Lighting project(const Image& radiance) const;

  private:
    SphereMap map_;
    int width_;
    int height_;
    int bandCount_;
    std::vector<TexelBlock> blocks_;        // that show something; none of a lat-long image
    std::vector<std::size_t> firstTexels_;  // one a block
};

}  // namespace prt
