#include "prt/trace/ray_stream.h"

#include <algorithm>
#include <limits>

namespace prt {

RayStream::RayStream(std::size_t rayCount)
    : originX(rayCount),
      originY(rayCount),
      originZ(rayCount),
      directionX(rayCount),
      directionY(rayCount),
      directionZ(rayCount),
      tFar(rayCount) {}

void RayStream::restart(const Vec3f& origin) {
    std::fill(originX.begin(), originX.end(), origin.x);
    std::fill(originY.begin(), originY.end(), origin.y);
    std::fill(originZ.begin(), originZ.end(), origin.z);
    std::fill(tFar.begin(), tFar.end(), std::numeric_limits<float>::infinity());
}

}  // namespace prt
