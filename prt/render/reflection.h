#pragma once

#include "prt/brdf/brdf.h"
#include "prt/math/vector.h"

namespace prt {

/// How one point of a surface reflects to one side: towards the eye, or back along a path.
struct Reflection {
    Brdf brdf;
    /// ω_o in the frame of the shading normal (frameFromNormal; C12): unit, above the horizon.
    Vec3d view{0.0, 0.0, 1.0};
};

/// Where the shading normal leans so far that the view lies below its horizon, though it sees the
/// surface, the view is raised to the horizon: the surface goes on shining as it does at its rim.
///
/// @param normal  unit, of shading, world space
/// @param view    unit, away from the surface, world space
Reflection makeReflection(Brdf brdf, const Vec3f& normal, const Vec3f& view);

/// What a surface makes of the light from one direction.
struct Scattering {
    Vec3d value{0.0, 0.0, 0.0};  ///< f_r ⟨n, ω⟩, per steradian; 0 below the horizon
    double density = 0.0;        ///< per steradian, with which drawReflected draws the direction
};

/// @param direction  ω_i, unit, world space
Scattering evaluateReflection(const Reflection& reflection, const Vec3f& normal,
                              const Vec3f& direction);

/// A direction ω_i drawn by the BRDF.
struct ReflectedDirection {
    Vec3f direction{0.0f, 0.0f, 1.0f};  ///< unit, world space
    Vec3f weight{0.0f, 0.0f, 0.0f};     ///< f_r ⟨n, ω⟩ over the density; 0 below the horizon
    double density = 0.0;
};

/// @param u, v  in [0, 1)
ReflectedDirection drawReflected(const Reflection& reflection, const Vec3f& normal, double u,
                                 double v);

}  // namespace prt
