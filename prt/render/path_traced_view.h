#pragma once

#include "prt/image/image.h"
#include "prt/render/path_tracer.h"
#include "prt/render/render_view.h"

namespace prt {

/// A picture, and the variance of each of its pixels that is due to its paths.
struct PathTracedView {
    Image radiance;
    Image variance;
};

/// The picture that renderView approximates, along the same rays: what each point seen reflects to
/// the eye, by the surface model of options.walk (diffuse: albedo times B), and emission where it
/// is seen (a bake carries none in its transport).
///
/// @param view           as for renderView; of threads, progress and the seed of paths
///                       `options` decides
/// @param samplesPerRay  paths for each of the samplesPerAxis² rays of a pixel, at least 2
/// @throws Error         invalidOption, cancelled
PathTracedView pathTraceView(const Scene& scene, const RayScene& rays, const DistantLight& light,
                             const Camera& camera, const RenderOptions& view, int samplesPerRay,
                             const PathTracerOptions& options = {});

}  // namespace prt
