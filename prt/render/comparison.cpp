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

template <class Vector>
double rootMeanOfChannels(std::span<const Vector> variances) {
    double sum = 0.0;
    for (const Vector& variance : variances)
        sum += static_cast<double>(variance.x + variance.y + variance.z);
    return variances.empty() ? 0.0 : std::sqrt(sum / (3.0 * static_cast<double>(variances.size())));
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

double NoisyError::relativeRmseWithoutNoise() const {
    return error.rmse > 0.0 ? error.relativeRmse * rmseWithoutNoise() / error.rmse : 0.0;
}

PictureComparison comparePictures(const Image& picture, const PathTracedView& reference,
                                  const DisplayOptions& display) {
    const Rgba8Image shown = encodeForDisplay(picture, display);
    const Rgba8Image shownReference = encodeForDisplay(reference.radiance, display);
    PictureComparison comparison;
    comparison.error = {measureError(picture, reference.radiance),
                        rootMeanOfChannels<Vec3f>(reference.variance.pixels)};
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
    return {measureError(relit, truth), rootMeanOfChannels<Vec3d>(reference.atVertices.variance)};
}

}  // namespace prt
