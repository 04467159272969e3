#include "prt/render/comparison.h"

#include <algorithm>
#include <cmath>

#include "prt/base/assert.h"
#include "prt/image/flip.h"

namespace prt {
namespace {

/// At most `maxCount` numbers below `count`, evenly spread.
std::vector<std::size_t> spreadEvenly(std::size_t count, std::size_t maxCount) {
    const std::size_t chosenCount = std::min(count, maxCount);
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < chosenCount; ++i)
        chosen.push_back(i * count / chosenCount);
    return chosen;
}

/// @param varianceAt  of the mean of reference pixel i
template <class VarianceAt>
NoisyError compareWithNoise(const Image& image, const Image& reference,
                            const VarianceAt& varianceAt) {
    double noise = 0.0, excess = 0.0, excessSquares = 0.0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const Vec3d variance = varianceAt(i);
        const double expected = (variance.x + variance.y + variance.z) / 3.0;
        const double square =
            (Vec3d(image.pixels[i]) - Vec3d(reference.pixels[i])).length2() / 3.0 - expected;
        noise += expected;
        excess += square;
        excessSquares += square * square;
    }
    const auto count = static_cast<double>(std::max<std::size_t>(image.pixels.size(), 1));
    const double mean = excess / count;
    const double spread = std::max(excessSquares / count - mean * mean, 0.0);
    return {measureError(image, reference), std::sqrt(noise / count), std::sqrt(spread / count)};
}

ImageOf<float> subtractLuminance(const Image& a, const Image& b) {
    ImageOf<float> difference(a.width, a.height);
    for (std::size_t i = 0; i < difference.pixels.size(); ++i)
        difference.pixels[i] = luminance(a.pixels[i]) - luminance(b.pixels[i]);
    return difference;
}

}  // namespace

Reference traceReference(const Scene& scene, const RayScene& rays, const DistantLight& light,
                         const Camera& camera, const ReferenceOptions& options) {
    PathTracerOptions tracing;
    tracing.walk.bounceCount = options.bounceCount;
    tracing.seed = options.view.seed;
    tracing.threadCount = options.view.threadCount;
    tracing.progress = options.view.progress;

    Reference reference;
    reference.view =
        pathTraceView(scene, rays, light, camera, options.view, options.samplesPerRay, tracing);
    reference.vertices = spreadEvenly(scene.vertexCount(), options.maxVertexCount);
    const std::vector<PathOrigin> allOrigins = placeVertexOrigins(scene, rays);
    std::vector<PathOrigin> origins;
    for (const std::size_t vertex : reference.vertices)
        origins.push_back(allOrigins[vertex]);
    reference.atVertices =
        estimateRadiance(scene, rays, light, origins, options.samplesPerVertex, tracing);
    return reference;
}

double NoisyError::rmseWithoutNoise() const {
    return std::sqrt(std::max(error.rmse * error.rmse - noiseRmse * noiseRmse, 0.0));
}

double NoisyError::largestRmseWithoutNoise() const {
    const double square = std::max(error.rmse * error.rmse - noiseRmse * noiseRmse, 0.0);
    return std::sqrt(square + 2.0 * squareDeviation);
}

bool NoisyError::isSignificant() const {
    return error.rmse * error.rmse - noiseRmse * noiseRmse >= 2.0 * squareDeviation;
}

double NoisyError::relative(double rmse) const {
    return error.rmse > 0.0 ? error.relativeRmse * rmse / error.rmse : 0.0;
}

PictureComparison comparePictures(const Image& picture, const PathTracedView& reference,
                                  const DisplayOptions& display) {
    const Rgba8Image shown = encodeForDisplay(picture, display);
    const Rgba8Image shownReference = encodeForDisplay(reference.radiance, display);
    PictureComparison comparison;
    comparison.error = compareWithNoise(picture, reference.radiance, [&](std::size_t i) {
        return Vec3d(reference.variance.pixels[i]);
    });
    comparison.psnr = measurePsnr(shown, shownReference);
    comparison.flip = measureFlip(shown, shownReference);
    comparison.meanFlip = meanValue(comparison.flip);
    comparison.luminanceChange = subtractLuminance(picture, reference.radiance);
    return comparison;
}

NoisyError compareAtVertices(std::span<const Vec3f> vertexRadiance, const Reference& reference) {
    // The vertices as the pixels of an image of one row.
    Image relit(static_cast<int>(reference.vertices.size()), 1);
    Image truth = relit;
    for (std::size_t i = 0; i < reference.vertices.size(); ++i) {
        PRT_ASSERT(reference.vertices[i] < vertexRadiance.size(), "the vertex is of the scene");
        relit.pixels[i] = vertexRadiance[reference.vertices[i]];
        truth.pixels[i] = Vec3f(reference.atVertices.mean[i]);
    }
    return compareWithNoise(relit, truth,
                            [&](std::size_t i) { return reference.atVertices.variance[i]; });
}

}  // namespace prt
