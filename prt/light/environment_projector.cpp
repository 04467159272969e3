// Bibliography
//   [Ramamoorthi01]  An efficient representation for irradiance environment maps
#include "prt/light/environment_projector.h"

#include <algorithm>

#include "prt/base/assert.h"
#include "prt/light/lat_long_projection.h"

namespace prt {

EnvironmentProjector::EnvironmentProjector(SphereMap map, int width, int height, int bandCount)
    : map_(map), width_(width), height_(height), bandCount_(bandCount) {
    PRT_ASSERT(bandCount >= 1 && bandCount <= kMaxBandCount, "there is code for so many bands");
    if (map == SphereMap::latLong) return;
    const std::vector<double> solidAngles = normalisedSolidAngles(map, width, height);
    for (std::size_t first = 0; first < solidAngles.size(); first += TexelBlock::kSize) {
        TexelBlock block;
        bool showsSomething = false;
        for (std::size_t i = first; i < std::min(first + TexelBlock::kSize, solidAngles.size());
             ++i) {
            if (solidAngles[i] == 0.0) continue;
            const auto [x, y] = std::pair(static_cast<int>(i) % width, static_cast<int>(i) / width);
            const Vec3f direction(sphereTexel(map, width, height, x, y).direction);
            const std::size_t j = i - first;
            block.x[j] = direction.x;
            block.y[j] = direction.y;
            block.z[j] = direction.z;
            block.solidAngle[j] = static_cast<float>(solidAngles[i]);
            showsSomething = true;
        }
        if (!showsSomething) continue;
        blocks_.push_back(block);
        firstTexels_.push_back(first);
    }
}

/// Each L_i = ∫ L(ω) y_i(ω) dω [Ramamoorthi01, eq. 3].
Lighting EnvironmentProjector::project(const Image& radiance) const {
    PRT_ASSERT(radiance.width == width_ && radiance.height == height_,
               "the image has the size that was said");
    if (map_ == SphereMap::latLong) return projectLatLong(radiance, bandCount_);
    Lighting lighting(bandCount_);
    projectTexelBlocks(blocks_, firstTexels_, radiance.pixels, bandCount_, lighting.coefficients);
    return lighting;
}

}  // namespace prt
