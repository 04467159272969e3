#pragma once

#include <memory>

#include "prt/base/random.h"
#include "prt/light/environment.h"
#include "prt/light/lighting.h"

namespace prt {

/// A direction drawn towards a light.
struct LightSample {
    Vec3f direction{0.0f, 0.0f, 1.0f};  ///< unit, world space
    /// Radiance from there over the density: the mean of samples is the integral over the sphere.
    Vec3f radianceOverDensity{0.0f, 0.0f, 0.0f};
    double density = 0.0;  ///< per steradian; ∞ for a light of no extent
};

/// What a light sends from one direction.
struct LightValue {
    Vec3f radiance{0.0f, 0.0f, 0.0f};  ///< W·sr⁻¹·m⁻²
    double density = 0.0;              ///< per steradian, with which sample() draws the direction
};

/// A light at infinity that can be drawn from in proportion to how bright it is. Many threads may
/// use it at once.
class DistantLight {
  public:
    virtual ~DistantLight() = default;
    virtual LightSample sample(RandomStream& random) const = 0;
    /// A light of no extent is never met: all 0.
    virtual LightValue evaluate(const Vec3f& direction) const = 0;
};

/// A disc of constant radiance that gives unit irradiance to a surface facing it (as sunLighting).
///
/// @param direction         unit, towards the disc's centre
/// @param halfAngleRadians  in [0, π]; 0 is a light of no extent
std::unique_ptr<DistantLight> makeSunLight(const Vec3d& direction, double halfAngleRadians);

/// What the coefficients stand for, negative lobes included (C5).
std::unique_ptr<DistantLight> makeBandLimitedLight(const Lighting& lighting);

/// An environment whose texels have constant radiance and their exact solid angle, which is what
/// projectLighting integrates.
///
/// @param environment             every texel finite
/// @param worldFromEnvironment    a rotation: L(R⁻¹ω)
std::unique_ptr<DistantLight> makeEnvironmentLight(Environment environment,
                                                   const Mat3d& worldFromEnvironment = {});

}  // namespace prt
