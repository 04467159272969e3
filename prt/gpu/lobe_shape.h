#pragma once

#include <optional>
#include <span>
#include <vector>

#include "prt/light/lighting.h"
#include "prt/scene/scene.h"

namespace prt {

/// A vertex of a lobe as lobe.vert has it.
struct LobeVertex {
    Vec3f position{0.0f, 0.0f, 0.0f};
    Vec3f normal{0.0f, 0.0f, 1.0f};
    Vec3f color{1.0f, 1.0f, 1.0f};  ///< linear, where the value is positive
    float value = 0.0f;             ///< f over its largest magnitude
};

/// A spherical function as the closed surface r(ω) = |Y(f(ω))| about the origin, Y the luminance of
/// its three channels, scaled so that the largest radius is 1. All zero where f is 0.
///
/// @param sphere    of radius 1 about the origin, whose vertices are the directions
/// @param function  its bands beyond kMaxBandCount go unused
/// @param color     of positive values; none: f's own, as bright as can be
/// @return          one a vertex of the sphere, joined as those are
std::vector<LobeVertex> shapeLobe(const Mesh& sphere, const Lighting& function,
                                  const std::optional<Vec3f>& color = {});

}  // namespace prt
