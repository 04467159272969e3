#pragma once

#include <span>

#include "prt/gpu/gpu_view.h"
#include "prt/parallel/progress.h"

namespace prt {

struct GpuPictureOptions {
    int width = 1280;
    int height = 720;
    int samplesPerAxis = 4;                     ///< samplesPerAxis² places a pixel; at least 1
    const GpuBackground* background = nullptr;  ///< as in GpuViewOptions, and the next two
    Mat3d worldFromBackground{};
    const GpuMirrors* mirrors = nullptr;
    ProgressCallback progress{};
};

/// A picture as renderView makes it, to be kept: the mean of views by drawGpuView that look through
/// other places of every pixel, the middles of renderView's strata.
///
/// @throws Error  as drawGpuView and GpuTarget, cancelled
Image drawGpuPicture(std::span<const GpuObject> objects, const Camera& camera,
                     const GpuPictureOptions& options = {});

}  // namespace prt
