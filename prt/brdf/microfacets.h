#pragma once

#include "prt/math/vector.h"

namespace prt {

/// Smoother surfaces than this are mirrors to every purpose of ours.
inline constexpr double kMinGgxAlpha = 1e-4;

/// D(h), the GGX distribution of microfacet normals [Walter07, eq. 33]: ∫ D cos θ_h dω = 1.
///
/// @param normal  h, unit, local frame
double ggxDistribution(const Vec3d& normal, double alpha);

/// G / (4 cos θ_i cos θ_o) with the height-correlated G of Smith [Heitz14].
double smithVisibility(double cosIncident, double cosView, double alpha);

/// (1 − cos θ)⁵ [Schlick94].
double schlickWeight(double cosTheta);

/// A microfacet normal that the view sees, drawn in proportion to how much of it is seen, and the
/// density of the direction ω_i that it mirrors the view to [Heitz18].
///
/// @param view  ω_o, unit, above the horizon
/// @param u, v  in [0, 1)
Vec3d sampleVisibleNormal(const Vec3d& view, double alpha, double u, double v);
double visibleNormalDensity(const Vec3d& incident, const Vec3d& view, double alpha);

/// ω mirrored at a microfacet.
inline Vec3d mirrorAbout(const Vec3d& normal, const Vec3d& direction) {
    return normal * (2.0 * normal.dot(direction)) - direction;
}

/// (ω_i + ω_o) normalised; +z for opposite directions.
inline Vec3d halfVector(const Vec3d& incident, const Vec3d& view) {
    const Vec3d sum = incident + view;
    const double length = sum.length();
    return length > 0.0 ? sum / length : Vec3d(0.0, 0.0, 1.0);
}

/// A right-handed frame about a direction whose tangent is horizontal, so that what is spread
/// evenly in it lies alike on both sides of the plane of the direction and the normal.
struct AxisFrame {
    Vec3d tangent;
    Vec3d bitangent;
    Vec3d axis;
};
AxisFrame frameAbout(const Vec3d& axis);

}  // namespace prt
