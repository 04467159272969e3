#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prt/parallel/progress.h"
#include "prt/render/distant_light.h"
#include "prt/render/path_walk.h"

namespace prt {

// The truth that a bake is held against: unbiased path tracing, which shares the scene and the ray
// tracer with the baker and none of its transport.

struct PathTracerOptions {
    WalkOptions walk{};
    /// Draws a direction towards the light at every surface point, and weighs it against the paths
    /// that find the light themselves by the balance heuristic [Veach95].
    bool lightSampling = true;
    std::uint64_t seed = 1;
    /// Number of the first origin's random streams: parts of a whole must not draw the same ones.
    std::uint64_t firstStream = 0;
    int threadCount = 0;  ///< 0: one a core
    ProgressCallback progress{};
};

/// Means of independent paths, and how far they can be trusted.
struct RadianceEstimate {
    std::vector<Vec3d> mean;      ///< W·sr⁻¹·m⁻²
    std::vector<Vec3d> variance;  ///< of the mean
};

/// B before albedo at each origin (C6): the light that arrives there, times ⟨n, ω⟩/π. Origins are
/// diffuse whatever the model of options.walk, which is of the surfaces that paths meet.
///
/// @param sampleCount  paths an origin, at least 2
/// @return             one a origin; the same for any number of threads (C10)
/// @throws Error       invalidOption, cancelled
RadianceEstimate estimateRadiance(const Scene& scene, const RayScene& rays,
                                  const DistantLight& light, std::span<const PathOrigin> origins,
                                  int sampleCount, const PathTracerOptions& options = {});

/// A point that is looked at from one side.
struct ExitPoint {
    PathOrigin origin;
    Reflection reflection;  ///< makeReflection, with the origin's normal
};

/// The radiance that leaves each point towards its view, ∫ f_r(ω, ω_o) ⟨n, ω⟩ L(ω) dω, without
/// what it emits.
///
/// @param sampleCount  paths a point, at least 2
/// @return             one a point; the same for any number of threads (C10)
/// @throws Error       invalidOption, cancelled
RadianceEstimate estimateExitRadiance(const Scene& scene, const RayScene& rays,
                                      const DistantLight& light, std::span<const ExitPoint> points,
                                      int sampleCount, const PathTracerOptions& options = {});

/// Transfer vectors, as TransferLayer has them with three channels.
struct TransferEstimate {
    int bandCount = 0;
    std::vector<double> mean;      ///< [origin][channel][coefficient]
    std::vector<double> variance;  ///< of the mean, likewise
};

/// T_i at each origin (C6): the walk of estimateRadiance with y_i in place of the light; only paths
/// that leave the scene count, so options.lightSampling means nothing.
///
/// @param bandCount, sampleCount  at least 1, and 2
/// @throws Error                  invalidOption, cancelled
TransferEstimate estimateTransfer(const Scene& scene, const RayScene& rays, int bandCount,
                                  std::span<const PathOrigin> origins, int sampleCount,
                                  const PathTracerOptions& options = {});

/// Origins at all vertices of a scene, numbered mesh after mesh, each a thousandth of a triangle
/// inside one that it belongs to, so that it sees what the surface beside the vertex sees and not
/// what lies behind a wall that meets it there.
std::vector<PathOrigin> placeVertexOrigins(const Scene& scene, const RayScene& rays);

}  // namespace prt
