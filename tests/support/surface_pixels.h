#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "prt/render/camera_rays.h"

namespace prt::test {

/// Which pixels show one mesh, or the background, through all their rays; row by row.
inline std::vector<bool> findSurfacePixels(const Scene& scene, const RayScene& rays,
                                           const Camera& camera, const RenderOptions& view) {
    const CameraRays cameraRays(scene, rays, camera, view);
    const auto pixelCount =
        static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height);
    std::vector<bool> isWhole(pixelCount, true);
    for (std::size_t pixel = 0; pixel < pixelCount; ++pixel) {
        const std::vector<SeenPoint> points = cameraRays.findSeenPoints(pixel, 1);
        for (const SeenPoint& point : points) {
            const Hit& first = points.front().hit;
            if (point.hit.escaped != first.escaped ||
                (!first.escaped && point.hit.point.mesh != first.point.mesh))
                isWhole[pixel] = false;
        }
    }
    return isWhole;
}

struct PixelAgreement {
    double psnr = 0.0;   ///< of linear values, for a peak of 1
    double share = 0.0;  ///< of all pixels
};

/// Over the pixels that are whole, or over those that are not.
inline PixelAgreement comparePixels(const Image& a, const Image& b,
                                    const std::vector<bool>& isWhole, bool ofWhole) {
    double squares = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        if (isWhole[i] != ofWhole) continue;
        squares += static_cast<double>((a.pixels[i] - b.pixels[i]).length2());
        ++count;
    }
    return {squares > 0.0 ? 10.0 * std::log10(3.0 * static_cast<double>(count) / squares)
                          : std::numeric_limits<double>::infinity(),
            static_cast<double>(count) / static_cast<double>(a.pixels.size())};
}

}  // namespace prt::test
