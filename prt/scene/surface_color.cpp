#include "prt/scene/surface_color.h"

#include <algorithm>
#include <cmath>

#include "prt/base/assert.h"
#include "prt/image/tone_curve.h"

namespace prt {
namespace {

const Vec4f kWhite(1.0f, 1.0f, 1.0f, 1.0f);

// Brings a texture coordinate into [0, 1]; what is not finite becomes 0.
float wrapCoordinate(float coordinate, TextureWrap wrap) {
    if (!std::isfinite(coordinate)) return 0.0f;
    switch (wrap) {
        case TextureWrap::repeat:
            return coordinate - std::floor(coordinate);
        case TextureWrap::mirroredRepeat:
            return std::abs(coordinate - 2.0f * std::round(0.5f * coordinate));
        case TextureWrap::clampToEdge:
            break;
    }
    return std::clamp(coordinate, 0.0f, 1.0f);
}

// The texel beside the edge of a wrapped image. At a mirror the edge
// texel meets itself, as at a clamp.
int wrapTexel(int texel, int size, TextureWrap wrap) {
    if (wrap == TextureWrap::repeat) return (texel + size) % size;
    return std::clamp(texel, 0, size - 1);
}

Vec4f decodeTexel(const Rgba8& texel, TexelCurve curve) {
    if (curve == TexelCurve::linear)
        return Vec4f(texel.red, texel.green, texel.blue, texel.alpha) / 255.0f;
    return Vec4f(decodeSrgb8(texel.red), decodeSrgb8(texel.green), decodeSrgb8(texel.blue),
                 static_cast<float>(texel.alpha) / 255.0f);
}

Vec4f sampleNearest(const Rgba8Image& image, TexelCurve curve, float u, float v) {
    const int x = std::min(static_cast<int>(u * static_cast<float>(image.width)), image.width - 1);
    const int y =
        std::min(static_cast<int>(v * static_cast<float>(image.height)), image.height - 1);
    return decodeTexel(image.at(x, y), curve);
}

// Blends the four texels around the point after decoding them: light
// adds linearly, code values do not.
Vec4f sampleLinear(const Rgba8Image& image, const TextureUse& texture, TexelCurve curve, float u,
                   float v) {
    const float x = u * static_cast<float>(image.width) - 0.5f;
    const float y = v * static_cast<float>(image.height) - 0.5f;
    const int left = static_cast<int>(std::floor(x));
    const int top = static_cast<int>(std::floor(y));
    const float toRight = x - static_cast<float>(left);
    const float toBottom = y - static_cast<float>(top);
    const int x0 = wrapTexel(left, image.width, texture.wrapU);
    const int x1 = wrapTexel(left + 1, image.width, texture.wrapU);
    const int y0 = wrapTexel(top, image.height, texture.wrapV);
    const int y1 = wrapTexel(top + 1, image.height, texture.wrapV);
    const auto texelAt = [&](int column, int row) {
        return decodeTexel(image.at(column, row), curve);
    };
    const Vec4f upper = texelAt(x0, y0) * (1.0f - toRight) + texelAt(x1, y0) * toRight;
    const Vec4f lower = texelAt(x0, y1) * (1.0f - toRight) + texelAt(x1, y1) * toRight;
    return upper * (1.0f - toBottom) + lower * toBottom;
}

/// The texture where the surface has coordinates for it, white elsewhere.
Vec4f sampleAt(const Scene& scene, const std::optional<TextureUse>& texture,
               const SurfacePoint& point, TexelCurve curve) {
    if (!texture) return kWhite;
    const Mesh& mesh = scene.meshes[point.mesh];
    const std::span<const Vec2f> uvs = mesh.uvSets[texture->uvSet == 1 ? 1 : 0];
    if (uvs.empty()) return kWhite;
    return sampleTexture(scene, *texture, interpolateCorners(mesh, point, uvs), curve);
}

// A reflectance, or a factor like one; what is not a number becomes 0.
float clampToUnit(float value) {
    return std::min(std::max(0.0f, value), 1.0f);
}

}  // namespace

Vec4f sampleTexture(const Scene& scene, const TextureUse& texture, const Vec2f& uv,
                    TexelCurve curve) {
    const Rgba8Image& image = scene.images[texture.image].pixels;
    if (image.pixels.empty()) return kWhite;
    const float u = wrapCoordinate(uv.x, texture.wrapU);
    const float v = wrapCoordinate(uv.y, texture.wrapV);
    return texture.filter == TextureFilter::nearest ? sampleNearest(image, curve, u, v)
                                                    : sampleLinear(image, texture, curve, u, v);
}

Vec4f evaluateBaseColor(const Scene& scene, const SurfacePoint& point) {
    const Mesh& mesh = scene.meshes[point.mesh];
    PRT_ASSERT(point.triangle < mesh.triangleCount(), "the point lies on a triangle of the mesh");
    const Material& material = scene.materials[mesh.material];
    Vec4f color = material.baseColorFactor;
    if (!mesh.colors.empty())
        color *= interpolateCorners(mesh, point, std::span<const Vec4f>(mesh.colors));
    color *= sampleAt(scene, material.baseColorTexture, point, TexelCurve::srgb);
    return Vec4f(clampToUnit(color.x), clampToUnit(color.y), clampToUnit(color.z), color.w);
}

Vec3f evaluateAlbedo(const Scene& scene, const SurfacePoint& point) {
    const Vec4f baseColor = evaluateBaseColor(scene, point);
    return {baseColor.x, baseColor.y, baseColor.z};
}

Vec3f evaluateEmission(const Scene& scene, const SurfacePoint& point) {
    const Material& material = scene.materials[scene.meshes[point.mesh].material];
    const Vec4f texel = sampleAt(scene, material.emissiveTexture, point, TexelCurve::srgb);
    return material.emissiveFactor * Vec3f(texel.x, texel.y, texel.z);
}

MetallicRoughness evaluateMetallicRoughness(const Scene& scene, const SurfacePoint& point) {
    const Material& material = scene.materials[scene.meshes[point.mesh].material];
    const Vec4f texel =
        sampleAt(scene, material.metallicRoughnessTexture, point, TexelCurve::linear);
    return {.metallic = clampToUnit(material.metallicFactor * texel.z),
            .roughness = clampToUnit(material.roughnessFactor * texel.y)};
}

bool isMasked(const Material& material) {
    return material.alphaMode == AlphaMode::mask;
}

}  // namespace prt
