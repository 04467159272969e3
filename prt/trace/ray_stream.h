#pragma once

#include <cstddef>
#include <vector>

#include "prt/math/vector.h"

namespace prt {

/// Rays of infinite length as structure of arrays, in the tracer's own space
/// (RayScene::tracePoint).
struct RayStream {
    explicit RayStream(std::size_t rayCount);

    std::size_t size() const { return directionX.size(); }

    void setRay(std::size_t index, const Vec3f& origin, const Vec3f& direction);

    /// Moves all rays to this origin and makes them infinite again.
    void restart(const Vec3f& origin);

    std::vector<float> originX, originY, originZ;
    std::vector<float> directionX, directionY, directionZ;
    std::vector<float>
        tFar;  ///< +∞; RayScene::findOccluded makes it −∞ where something stands on the ray
};

}  // namespace prt
