#include "prt/render/comparison.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "prt/base/assert.h"
#include "prt/image/flip.h"
#include "prt/render/camera_rays.h"
#include "prt/render/exit_shading.h"

namespace prt {
namespace {

/// At most `maxCount` of some numbers, evenly spread.
std::vector<std::size_t> spreadEvenly(std::span<const std::size_t> numbers, std::size_t maxCount) {
    const std::size_t chosenCount = std::min(numbers.size(), maxCount);
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < chosenCount; ++i)
        chosen.push_back(numbers[i * numbers.size() / chosenCount]);
    return chosen;
}

std::vector<std::size_t> countUp(std::size_t count) {
    std::vector<std::size_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    return numbers;
}

/// B at some vertices.
RadianceEstimate estimateAtVertices(const Scene& scene, const RayScene& rays,
                                    const DistantLight& light,
                                    std::span<const std::size_t> vertices, int sampleCount,
                                    const PathTracerOptions& tracing) {
    const std::vector<PathOrigin> allOrigins = placeVertexOrigins(scene, rays);
    std::vector<PathOrigin> origins;
    for (const std::size_t vertex : vertices)
        origins.push_back(allOrigins[vertex]);
    return estimateRadiance(scene, rays, light, origins, sampleCount, tracing);
}

/// The vertices of a scene as points that send light to the eye, as far as their normals face it.
class VerticesSeen {
  public:
    VerticesSeen(const Scene& scene, const RayScene& rays, const Vec3f& eye)
        : scene_(scene),
          points_(findVertexPoints(scene)),
          origins_(placeVertexOrigins(scene, rays)) {
        for (const Mesh& mesh : scene.meshes)
            for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
                const std::size_t vertex = views_.size();
                views_.push_back((eye - mesh.positions[i]).normalized());
                if (points_[vertex] && views_[vertex].dot(mesh.normals[i]) > 0.0f)
                    facing_.push_back(vertex);
            }
    }

    /// Ascending numbers.
    std::span<const std::size_t> facing() const { return facing_; }

    RadianceEstimate estimateExit(const RayScene& rays, const DistantLight& light,
                                  std::span<const std::size_t> vertices, int sampleCount,
                                  const PathTracerOptions& tracing) const {
        std::vector<ExitPoint> exits;
        for (const std::size_t vertex : vertices) {
            const Brdf brdf = findBrdf(scene_, *points_[vertex], tracing.walk);
            exits.push_back(
                {origins_[vertex], makeReflection(brdf, origins_[vertex].normal, views_[vertex])});
        }
        return estimateExitRadiance(scene_, rays, light, exits, sampleCount, tracing);
    }

  private:
    const Scene& scene_;
    std::vector<std::optional<SurfacePoint>> points_;
    std::vector<PathOrigin> origins_;
    std::vector<Vec3f> views_;
    std::vector<std::size_t> facing_;
};

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

NoisyError compareWithNoise(const Image& image, const PathTracedView& reference) {
    return compareWithNoise(image, reference.radiance,
                            [&](std::size_t i) { return Vec3d(reference.variance.pixels[i]); });
}

ImageOf<float> subtractLuminance(const Image& a, const Image& b) {
    ImageOf<float> difference(a.width, a.height);
    for (std::size_t i = 0; i < difference.pixels.size(); ++i)
        difference.pixels[i] = luminance(a.pixels[i]) - luminance(b.pixels[i]);
    return difference;
}

/// The material that all rays of a pixel meet, if it is one.
std::optional<std::size_t> findMaterial(const Scene& scene, std::span<const SeenPoint> seen) {
    std::optional<std::size_t> material;
    for (const SeenPoint& point : seen) {
        if (point.hit.escaped) return std::nullopt;
        const std::size_t met = scene.meshes[point.hit.point.mesh].material;
        if (material && *material != met) return std::nullopt;
        material = met;
    }
    return material;
}

/// Row-major numbers of the pixels that show each material alone.
std::vector<std::vector<std::size_t>> findPixelsOfMaterials(const Scene& scene,
                                                            const RayScene& rays,
                                                            const Camera& camera,
                                                            const RenderOptions& view) {
    const CameraRays cameraRays(scene, rays, camera, view);
    const auto width = static_cast<std::size_t>(view.width);
    std::vector<std::vector<std::size_t>> pixels(scene.materials.size());
    for (std::size_t row = 0; row < static_cast<std::size_t>(view.height); ++row) {
        const std::vector<SeenPoint> seen = cameraRays.findSeenPoints(row * width, width);
        const std::size_t rayCount = cameraRays.raysPerPixel();
        for (std::size_t i = 0; i < width; ++i)
            if (const auto material =
                    findMaterial(scene, std::span(seen).subspan(i * rayCount, rayCount)))
                pixels[*material].push_back(row * width + i);
    }
    return pixels;
}

/// Some pixels as an image of one row.
Image gatherPixels(const Image& image, std::span<const std::size_t> pixels) {
    Image gathered(static_cast<int>(pixels.size()), 1);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        gathered.pixels[i] = image.pixels[pixels[i]];
    return gathered;
}

}  // namespace

Reference traceReference(const Scene& scene, const RayScene& rays, const DistantLight& light,
                         const Camera& camera, const ReferenceOptions& options) {
    PathTracerOptions tracing;
    tracing.walk.surfaceModel = options.surfaceModel;
    tracing.walk.materialBrdfs = options.materialBrdfs;
    tracing.walk.bounceCount = options.bounceCount;
    tracing.seed = options.view.seed;
    tracing.threadCount = options.view.threadCount;
    tracing.progress = options.view.progress;

    Reference reference;
    reference.view =
        pathTraceView(scene, rays, light, camera, options.view, options.samplesPerRay, tracing);
    if (options.surfaceModel == SurfaceModel::diffuse) {
        reference.vertices = spreadEvenly(countUp(scene.vertexCount()), options.maxVertexCount);
        reference.atVertices = estimateAtVertices(scene, rays, light, reference.vertices,
                                                  options.samplesPerVertex, tracing);
    } else {
        const VerticesSeen seen(scene, rays, camera.eye);
        reference.vertices = spreadEvenly(seen.facing(), options.maxVertexCount);
        reference.atVertices =
            seen.estimateExit(rays, light, reference.vertices, options.samplesPerVertex, tracing);
    }
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
    comparison.error = compareWithNoise(picture, reference);
    comparison.psnr = measurePsnr(shown, shownReference);
    comparison.flip = measureFlip(shown, shownReference);
    comparison.meanFlip = meanValue(comparison.flip);
    comparison.luminanceChange = subtractLuminance(picture, reference.radiance);
    return comparison;
}

std::vector<MaterialError> compareMaterials(const Scene& scene, const RayScene& rays,
                                            const Camera& camera, const RenderOptions& view,
                                            const Image& picture, const PathTracedView& reference) {
    const std::vector<std::vector<std::size_t>> pixels =
        findPixelsOfMaterials(scene, rays, camera, view);
    std::vector<MaterialError> errors;
    for (std::size_t material = 0; material < pixels.size(); ++material) {
        if (pixels[material].empty()) continue;
        errors.push_back(
            {material, pixels[material].size(),
             compareWithNoise(gatherPixels(picture, pixels[material]),
                              PathTracedView{gatherPixels(reference.radiance, pixels[material]),
                                             gatherPixels(reference.variance, pixels[material])})});
    }
    return errors;
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
