#include "prt/render/reflection.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "prt/math/frame.h"

namespace prt {
namespace {

/// The cosine of views at the horizon, where BRDFs are no longer defined.
constexpr double kLowestViewCosine = 1e-4;

Frame<double> frameAround(const Vec3f& normal) {
    return frameFromNormal(Vec3d(normal).normalized());
}

Vec3d localFromWorld(const Frame<double>& frame, const Vec3f& world) {
    const Vec3d direction(world);
    return {direction.dot(frame.tangent), direction.dot(frame.bitangent),
            direction.dot(frame.normal)};
}

Vec3d raiseToHorizon(const Vec3d& view) {
    if (view.z >= kLowestViewCosine) return view;
    const double radius = std::hypot(view.x, view.y);
    const Vec3d along =
        radius > 0.0 ? Vec3d(view.x / radius, view.y / radius, 0.0) : Vec3d(1.0, 0.0, 0.0);
    return (along + Vec3d(0.0, 0.0, kLowestViewCosine)).normalized();
}

}  // namespace

Reflection makeReflection(Brdf brdf, const Vec3f& normal, const Vec3f& view) {
    return {std::move(brdf), raiseToHorizon(localFromWorld(frameAround(normal), view))};
}

Scattering evaluateReflection(const Reflection& reflection, const Vec3f& normal,
                              const Vec3f& direction) {
    const Vec3d incident = localFromWorld(frameAround(normal), direction);
    if (incident.z <= 0.0) return {};
    return {evaluateBrdf(reflection.brdf, incident, reflection.view) * incident.z,
            brdfDensity(reflection.brdf, incident, reflection.view)};
}

ReflectedDirection drawReflected(const Reflection& reflection, const Vec3f& normal, double u,
                                 double v) {
    const BrdfSample drawn = sampleBrdf(reflection.brdf, reflection.view, u, v);
    return {Vec3f(frameAround(normal).worldFromLocal(drawn.incident)), Vec3f(drawn.weight),
            drawn.density};
}

}  // namespace prt
