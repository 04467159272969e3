#pragma once

#include <array>
#include <span>

#include "prt/gpu/gpu_view.h"
#include "prt/gpu/view_frame.h"

namespace prt {

/// Distances along a camera's axis.
struct DepthRange {
    double nearest = 0.0;
    double farthest = 0.0;
};

/// Those between which drawGpuView draws: of all that the camera sees of the balls about its
/// objects.
DepthRange findDepths(std::span<const GpuObject> objects, const Camera& camera,
                      const ViewFrame& view);

/// OpenGL's clip space, of points relative to the eye along the axes that the view has; column
/// after column.
std::array<float, 16> makeClipMatrix(const DepthRange& depths, const ViewFrame& view);

}  // namespace prt
