// Bibliography
//   [Heitz14]    Understanding the masking-shadowing function in microfacet-based BRDFs
//   [Heitz18]    Sampling the GGX distribution of visible normals
//   [Schlick94]  An inexpensive BRDF model for physically-based rendering
//   [Walter07]   Microfacet models for refraction through rough surfaces
#include "prt/brdf/microfacets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace prt {
namespace {

/// √(α² + (1 − α²) cos²θ): cos θ √(1 + α² tan²θ) without its pole.
double stretchedCosine(double cosTheta, double alpha) {
    return std::sqrt(alpha * alpha + (1.0 - alpha * alpha) * cosTheta * cosTheta);
}

}  // namespace

double ggxDistribution(const Vec3d& normal, double alpha) {
    if (normal.z <= 0.0) return 0.0;
    // From the sine, which near the normal has the digits that the cosine has lost.
    const double sinSquared = normal.x * normal.x + normal.y * normal.y;
    const double spread = sinSquared + alpha * alpha * normal.z * normal.z;
    return alpha * alpha * std::numbers::inv_pi / (spread * spread);
}

double smithVisibility(double cosIncident, double cosView, double alpha) {
    return 0.5 / (cosView * stretchedCosine(cosIncident, alpha) +
                  cosIncident * stretchedCosine(cosView, alpha));
}

double schlickWeight(double cosTheta) {
    const double rest = std::clamp(1.0 - cosTheta, 0.0, 1.0);
    return rest * rest * rest * rest * rest;
}

AxisFrame frameAbout(const Vec3d& axis) {
    const double radius = std::hypot(axis.x, axis.y);
    const Vec3d tangent = radius > 0.0 ? Vec3d(-axis.y / radius, axis.x / radius, 0.0)
                                       : Vec3d(0.0, axis.z < 0.0 ? -1.0 : 1.0, 0.0);
    return {tangent, axis.cross(tangent), axis};
}

Vec3d sampleVisibleNormal(const Vec3d& view, double alpha, double u, double v) {
    // Stretch the surface until its microfacets are a hemisphere.
    const AxisFrame frame = frameAbout(Vec3d(alpha * view.x, alpha * view.y, view.z).normalized());
    // Draw from its projection along the view: half a disc, and a squeezed half.
    const double radius = std::sqrt(u), phi = 2.0 * std::numbers::pi * v;
    const double x = radius * std::cos(phi);
    const double visible = 0.5 * (1.0 + frame.axis.z);
    const double y = std::lerp(std::sqrt(1.0 - x * x), radius * std::sin(phi), visible);
    // Lift it to the hemisphere, and take the stretching back.
    const Vec3d lifted = frame.tangent * x + frame.bitangent * y +
                         frame.axis * std::sqrt(std::max(0.0, 1.0 - x * x - y * y));
    return Vec3d(alpha * lifted.x, alpha * lifted.y, std::max(0.0, lifted.z)).normalized();
}

double visibleNormalDensity(const Vec3d& incident, const Vec3d& view, double alpha) {
    // D G₁(ω_o) (ω_o·h) / cos θ_o, over the 4 (ω_o·h) of mirroring.
    return 0.5 * ggxDistribution(halfVector(incident, view), alpha) /
           (view.z + stretchedCosine(view.z, alpha));
}

}  // namespace prt
