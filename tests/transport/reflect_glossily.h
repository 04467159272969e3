#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "prt/basis/sh.h"
#include "prt/scene/surface_color.h"

namespace prt::test {

/// For three bands: reflects what comes from the mirrored direction, and some of all.
inline void reflectGlossily(const SurfacePoint& point, const Vec3f& view,
                            std::span<float> response) {
    std::vector<float> mirrored(9);
    evaluateSh(Vec3f(-view.x, -view.y, view.z), 3, std::span(mirrored));
    for (std::size_t channel = 0; channel < 3; ++channel)
        for (std::size_t i = 0; i < 9; ++i)
            response[9 * channel + i] += (0.1f + 0.2f * static_cast<float>(channel) +
                                          0.05f * static_cast<float>(point.mesh)) *
                                         (mirrored[i] + (i == 2 ? 0.3f : 0.0f));
}

}  // namespace prt::test
