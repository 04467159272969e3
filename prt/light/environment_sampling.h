#pragma once

#include <cstddef>

#include "prt/base/random.h"
#include "prt/light/environment.h"
#include "prt/math/alias_table.h"

namespace prt {

/// A direction in which an environment shines, and how likely it is drawn.
struct EnvironmentPlace {
    std::size_t texel = 0;  ///< in row-major order
    Vec3d direction{0.0, 0.0, 0.0};
    double density = 0.0;  ///< per steradian; 0 where the image shows nothing
};

/// Draws directions in proportion to the light from there: texels by the absolute luminance of
/// their radiance times their solid angle, and places evenly over a texel's part of the image. A
/// black environment is drawn evenly. Many threads may use it at once.
class EnvironmentSampler {
  public:
    /// @param environment  every texel finite; not kept
    explicit EnvironmentSampler(const Environment& environment);

    EnvironmentPlace sample(RandomStream& random) const;

    /// The place in a direction, with the density that sample() draws it with.
    ///
    /// @param direction  unit, world space
    EnvironmentPlace find(const Vec3f& direction) const;

  private:
    EnvironmentPlace placeAt(std::size_t texel, double x, double y) const;

    SphereMap map_;
    int width_;
    int height_;
    AliasTable table_;
};

}  // namespace prt
