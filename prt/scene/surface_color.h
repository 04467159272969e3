#pragma once

#include <span>

#include "prt/scene/scene.h"

namespace prt {

/// A point of a triangle: the weights of its three corners are (1−u−v, u, v).
struct SurfacePoint {
    std::size_t mesh = 0;
    std::size_t triangle = 0;  ///< within the mesh
    float u = 0.0f;
    float v = 0.0f;
};

/// A value given at the vertices of a mesh, linear in the triangle, and exactly constant where its
/// corners agree.
template <class Value>
Value interpolateCorners(const Mesh& mesh, const SurfacePoint& point,
                         std::span<const Value> values) {
    const std::uint32_t* corners = &mesh.indices[3 * point.triangle];
    const Value& origin = values[corners[0]];
    return origin + (values[corners[1]] - origin) * point.u +
           (values[corners[2]] - origin) * point.v;
}

/// Base colour with coverage: factor × vertex colour × texture, linear [glTF 2.0, 3.9.2]. rgb is
/// the diffuse albedo.
///
/// Textures must be decoded; an undecoded one counts as white. rgb is clamped
/// to [0, 1], as a reflectance is.
Vec4f evaluateBaseColor(const Scene& scene, const SurfacePoint& point);

/// The rgb of evaluateBaseColor.
Vec3f evaluateAlbedo(const Scene& scene, const SurfacePoint& point);

/// Emitted radiance: factor × texture, linear [glTF 2.0, 3.9.3], W·sr⁻¹·m⁻².
Vec3f evaluateEmission(const Scene& scene, const SurfacePoint& point);

/// How metallic and how rough a surface is, each in [0, 1].
struct MetallicRoughness {
    float metallic = 0.0f;
    float roughness = 1.0f;
};

/// Factors × texture [glTF 2.0, 3.9.2]. An undecoded texture counts as white.
MetallicRoughness evaluateMetallicRoughness(const Scene& scene, const SurfacePoint& point);

/// What the code values of a texture's red, green and blue stand for.
enum class TexelCurve {
    srgb,    ///< colours
    linear,  ///< data
};

/// One linear RGBA sample of a texture, with its wrap modes and filter.
Vec4f sampleTexture(const Scene& scene, const TextureUse& texture, const Vec2f& uv,
                    TexelCurve curve = TexelCurve::srgb);

/// Whether the material's texture or vertex alpha can let light through (alpha mode "mask").
bool isMasked(const Material& material);

}  // namespace prt
