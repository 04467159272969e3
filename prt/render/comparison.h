#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "prt/image/error_metrics.h"
#include "prt/image/tone_curve.h"
#include "prt/render/path_traced_view.h"

namespace prt {

struct ReferenceOptions {
    RenderOptions view{};    ///< threads, progress and seed count for paths too
    int samplesPerRay = 16;  ///< paths for each of the samplesPerAxis² rays of a pixel
    int samplesPerVertex = 256;
    int bounceCount = kUnlimitedBounces;  ///< indirect bounces (C8)
    /// Of all surfaces, and of vertices: the diffuse model makes B of them, the glTF model what
    /// they send to the camera's eye.
    SurfaceModel surfaceModel = SurfaceModel::diffuse;
    std::span<const Brdf> materialBrdfs{};  ///< as WalkOptions has them
    std::size_t maxVertexCount = 4096;  ///< of those that are looked at, evenly through the list
};

/// The truth about a view of a scene under a light, and about some of its vertices.
struct Reference {
    PathTracedView view;
    std::vector<std::size_t> vertices;  ///< scene-wide numbers
    RadianceEstimate atVertices;        ///< B before albedo, or exit radiance; one a vertex
};

/// Path-traces a reference. Of the glTF model are looked at only vertices whose normals face the
/// eye. @throws Error invalidOption, cancelled
Reference traceReference(const Scene& scene, const RayScene& rays, const DistantLight& light,
                         const Camera& camera, const ReferenceOptions& options);

/// An error, and how much of it is the noise of the reference. The squares of the two add up, so
/// the noise can be taken out, as far as its own chance allows.
struct NoisyError {
    ImageError error;        ///< of radiance, noise included
    double noiseRmse = 0.0;  ///< of the reference, from its variance
    /// One standard deviation of the difference of the two squares.
    double squareDeviation = 0.0;

    double rmseWithoutNoise() const;
    /// The most that the error without noise may be, by two standard deviations.
    double largestRmseWithoutNoise() const;
    /// Whether the noise does not explain it all.
    bool isSignificant() const;
    /// What an RMSE is, relative to the reference.
    double relative(double rmse) const;
};

/// A relit picture held against a reference, pixel by pixel.
struct PictureComparison {
    NoisyError error;
    double psnr = 0.0;               ///< decibels, of the pictures for the screen
    double meanFlip = 0.0;           ///< of the same
    ImageOf<float> flip;             ///< 0 … 1
    ImageOf<float> luminanceChange;  ///< relit less reference, linear
};

/// @param picture  along the rays of the reference, so that edges agree and only light can differ
/// @param display  how both become pictures for the screen
PictureComparison comparePictures(const Image& picture, const PathTracedView& reference,
                                  const DisplayOptions& display);

/// The error over the pixels that show one material and nothing else.
struct MaterialError {
    std::size_t material = 0;  ///< index into Scene::materials
    std::size_t pixelCount = 0;
    NoisyError error;
};

/// A picture held against a reference material by material; materials that fill no pixel are left
/// out.
///
/// @param view  of both
std::vector<MaterialError> compareMaterials(const Scene& scene, const RayScene& rays,
                                            const Camera& camera, const RenderOptions& view,
                                            const Image& picture, const PathTracedView& reference);

/// Relit radiance held against a reference at its vertices, where nothing is interpolated.
///
/// @param vertexRadiance  of all vertices of the scene: B, or what shadeVertices makes of exit
///                        radiance, as the reference has it
NoisyError compareAtVertices(std::span<const Vec3f> vertexRadiance, const Reference& reference);

}  // namespace prt
