#pragma once

#include <memory>
#include <span>
#include <vector>

#include "prt/light/analytic_lights.h"
#include "prt/math/frame.h"
#include "prt/render/path_tracer.h"
#include "tests/brdf/brdf_samples.h"

namespace prt::test {

/// Radiance 1 from everywhere.
inline std::unique_ptr<DistantLight> makeWhiteSky() {
    return makeBandLimitedLight(uniformLighting(Vec3d(1.0), 1));
}

/// The glTF model, or the given BRDFs, one a material.
inline PathTracerOptions glossyOptions(std::span<const Brdf> materialBrdfs = {}) {
    PathTracerOptions options;
    options.walk.surfaceModel = SurfaceModel::gltf;
    options.walk.materialBrdfs = materialBrdfs;
    return options;
}

/// Points at the vertices of a scene, each looked at from somewhere above it.
inline std::vector<ExitPoint> lookAtVertices(const Scene& scene, const RayScene& rays,
                                             std::span<const Brdf> materialBrdfs) {
    RandomStream random(7, 0);
    std::vector<ExitPoint> points;
    const std::vector<PathOrigin> origins = placeVertexOrigins(scene, rays);
    for (const Mesh& mesh : scene.meshes)
        for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
            const PathOrigin& origin = origins[points.size()];
            const Vec3f view(
                frameFromNormal(Vec3d(origin.normal)).worldFromLocal(drawUpward(random)));
            points.push_back(
                {origin, makeReflection(materialBrdfs[mesh.material], origin.normal, view)});
        }
    return points;
}

}  // namespace prt::test
