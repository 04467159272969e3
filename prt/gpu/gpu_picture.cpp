#include "prt/gpu/gpu_picture.h"

#include <vector>

#include "prt/base/assert.h"

namespace prt {

Image drawGpuPicture(std::span<const GpuObject> objects, const Camera& camera,
                     const GpuPictureOptions& options) {
    const int n = options.samplesPerAxis;
    PRT_ASSERT(n >= 1, "a pixel shows something");
    const GpuTarget target(options.width, options.height);
    GpuViewOptions view{.background = options.background,
                        .worldFromBackground = options.worldFromBackground,
                        .mirrors = options.mirrors};
    std::vector<Vec3d> sums(
        static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height),
        Vec3d(0.0));
    ProgressReporter progress(options.progress, "render", "views", static_cast<std::size_t>(n * n));
    for (int i = 0; i < n * n; ++i) {
        const auto placeOf = [&](int stratum) {
            return (static_cast<float>(stratum) + 0.5f) / static_cast<float>(n) - 0.5f;
        };
        view.shiftPixels = {placeOf(i % n), placeOf(i / n)};
        drawGpuView(objects, camera, target, view);
        const Image drawn = target.readRadiance();
        for (std::size_t pixel = 0; pixel < sums.size(); ++pixel)
            sums[pixel] += Vec3d(drawn.pixels[pixel]);
        progress.advance(1);
    }
    Image mean(options.width, options.height);
    for (std::size_t pixel = 0; pixel < sums.size(); ++pixel)
        mean.pixels[pixel] = Vec3f(sums[pixel] / (n * n));
    return mean;
}

}  // namespace prt
