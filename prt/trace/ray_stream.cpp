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

void RayStream::setRay(std::size_t index, const Vec3f& origin, const Vec3f& direction) {
    originX[index] = origin.x;
    originY[index] = origin.y;
    originZ[index] = origin.z;
    directionX[index] = direction.x;
    directionY[index] = direction.y;
    directionZ[index] = direction.z;
    tFar[index] = std::numeric_limits<float>::infinity();
}

void RayStream::restart(const Vec3f& origin) {
    std::fill(originX.begin(), originX.end(), origin.x);
    std::fill(originY.begin(), originY.end(), origin.y);
    std::fill(originZ.begin(), originZ.end(), origin.z);
    std::fill(tFar.begin(), tFar.end(), std::numeric_limits<float>::infinity());
}

}  // namespace prt
