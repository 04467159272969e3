#pragma once

#include <array>
#include <memory>
#include <variant>

#include "prt/brdf/measured_brdf.h"
#include "prt/math/vector.h"
#include "prt/scene/surface_color.h"

namespace prt {

// BRDFs of isotropic surfaces. ω_i and ω_o are unit, both point away from the surface, and the
// normal is +z (C12). All values are RGB, per steradian, without the cosine; below the horizon they
// are 0. Exchanging ω_i and ω_o changes none of them.

/// albedo / π.
struct LambertLobe {
    Vec3d albedo{0.0, 0.0, 0.0};
    bool operator==(const LambertLobe&) const = default;
};

/// The diffuse light that a Fresnel layer lets through: albedo/π (1 − (1 − ω_i·h)⁵), with the half
/// vector h [glTF 2.0, B.3.4].
struct LayeredLambertLobe {
    Vec3d albedo{0.0, 0.0, 0.0};
    bool operator==(const LayeredLambertLobe&) const = default;
};

/// albedo (s + 2)/(2π) max(cos α, 0)^s, α the angle between ω_i and the mirrored ω_o: scaled so
/// that seen along the normal, albedo is reflected, and less otherwise [Lafortune94].
struct PhongLobe {
    Vec3d albedo{0.0, 0.0, 0.0};
    double exponent = 1.0;  ///< s ≥ 0
    bool operator==(const PhongLobe&) const = default;
};

/// GGX microfacets, F D(h) G / (4 cos θ_i cos θ_o), with height-correlated Smith G and
/// F = F0 + (1 − F0)(1 − ω_i·h)⁵ [Walter07; Heitz14; Schlick94; glTF 2.0, B.3.2].
struct GgxLobe {
    Vec3d f0{1.0, 1.0, 1.0};
    double alpha = 1.0;  ///< the square of glTF's roughness; below kMinGgxAlpha counts as that
    bool operator==(const GgxLobe&) const = default;
};

/// As measured; equal only by the same table.
struct MeasuredLobe {
    std::shared_ptr<const MeasuredBrdf> table;
    bool operator==(const MeasuredLobe&) const = default;
};

using BrdfLobe =
    std::variant<std::monostate, LambertLobe, LayeredLambertLobe, PhongLobe, GgxLobe, MeasuredLobe>;

/// What its lobes reflect together, the broader one first.
struct Brdf {
    std::array<BrdfLobe, 2> lobes;
    bool operator==(const Brdf&) const = default;
};

/// Whether it is one at all: a black surface has a lobe too.
bool hasLobes(const Brdf& brdf);

/// The two lobes of a glTF material.
struct GltfLobes {
    LayeredLambertLobe diffuse;
    GgxLobe specular;
};

/// The BRDF of a glTF material [glTF 2.0, B.3.5]: a dielectric of F0 = 0.04 over a diffuse base,
/// and a metal of F0 = base colour, mixed by `metallic`. The specular parts of both are one lobe,
/// of F0 = (1 − metallic) 0.04 + metallic · base colour. The specification says itself that the
/// sum of diffuse and specular light can exceed what falls in.
///
/// @param baseColor  linear, in [0, 1]
GltfLobes splitGltfMaterial(const Vec3f& baseColor, const MetallicRoughness& surface);
Brdf makeGltfBrdf(const Vec3f& baseColor, const MetallicRoughness& surface);

/// f_r(ω_i, ω_o).
Vec3d evaluateLobe(const BrdfLobe& lobe, const Vec3d& incident, const Vec3d& view);
Vec3d evaluateBrdf(const Brdf& brdf, const Vec3d& incident, const Vec3d& view);

/// A direction ω_i drawn for a view.
struct BrdfSample {
    Vec3d incident{0.0, 0.0, 1.0};  ///< unit; may lie below the horizon, and then weighs nothing
    double density = 0.0;           ///< per steradian, as brdfDensity tells
    /// f_r cos θ_i over the density: the mean over samples is the directional albedo.
    Vec3d weight{0.0, 0.0, 0.0};
};

/// Draws ω_i about in proportion to f_r cos θ_i: diffuse lobes by the cosine, Phong's by its lobe,
/// GGX by visible normals [Heitz18], measured ones half by the cosine and half by their table.
///
/// @param view  above the horizon
/// @param u, v  in [0, 1)
BrdfSample sampleBrdf(const Brdf& brdf, const Vec3d& view, double u, double v);

/// The density per steradian with which sampleBrdf draws ω_i. Its integral over the upper
/// hemisphere is less than 1 where samples fall below the horizon.
double brdfDensity(const Brdf& brdf, const Vec3d& incident, const Vec3d& view);

/// The same of one lobe.
Vec3d sampleLobe(const BrdfLobe& lobe, const Vec3d& view, double u, double v);
double lobeDensity(const BrdfLobe& lobe, const Vec3d& incident, const Vec3d& view);

}  // namespace prt
