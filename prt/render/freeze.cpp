#include "prt/render/freeze.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "prt/base/assert.h"
#include "prt/render/exit_shading.h"
#include "prt/scene/surface_color.h"

namespace prt {
namespace {

Vec3f rgbOf(const Vec4f& color) {
    return {color.x, color.y, color.z};
}

Vec4f withAlpha(const Vec3f& rgb, float alpha) {
    return {rgb.x, rgb.y, rgb.z, alpha};
}

/// Whether the mesh keeps its texture of base colour.
bool keepsTexture(const Scene& scene, const Mesh& mesh) {
    const auto& texture = scene.materials[mesh.material].baseColorTexture;
    return texture && !mesh.uvSets[static_cast<std::size_t>(texture->uvSet)].empty();
}

/// Without the texture, which is multiplied where the scene is shown.
Vec3f vertexAlbedo(const Scene& scene, const Mesh& mesh, std::size_t vertex) {
    Vec3f albedo = rgbOf(scene.materials[mesh.material].baseColorFactor);
    if (!mesh.colors.empty()) albedo *= rgbOf(mesh.colors[vertex]);
    for (int c = 0; c < 3; ++c)
        albedo[c] = std::clamp(albedo[c], 0.0f, 1.0f);
    return albedo;
}

/// What is left of a material when light and colour have gone into the vertices.
Material stripMaterial(const Material& material) {
    Material stripped;
    stripped.name = material.name;
    stripped.alphaMode = material.alphaMode;
    stripped.alphaCutoff = material.alphaCutoff;
    stripped.doubleSided = material.doubleSided;
    return stripped;
}

/// A mesh without what only materials of light have a use for.
Mesh stripMesh(const Mesh& mesh) {
    Mesh stripped = mesh;
    stripped.uvSets = {};
    stripped.colors.clear();
    return stripped;
}

Scene stripScene(const Scene& scene) {
    Scene stripped;
    stripped.cameras = scene.cameras;
    std::ranges::transform(scene.materials, std::back_inserter(stripped.materials), stripMaterial);
    std::ranges::transform(scene.meshes, std::back_inserter(stripped.meshes), stripMesh);
    return stripped;
}

/// Gives the stripped scene its textures of base colour again, with their images and the
/// coordinates that they need.
void keepTextures(const Scene& scene, Scene& frozen) {
    std::vector<std::optional<std::size_t>> imageOf(scene.images.size());
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const Mesh& mesh = scene.meshes[m];
        if (!keepsTexture(scene, mesh)) continue;
        TextureUse texture = *scene.materials[mesh.material].baseColorTexture;
        frozen.meshes[m].uvSets[0] = mesh.uvSets[static_cast<std::size_t>(texture.uvSet)];
        std::optional<std::size_t>& image = imageOf[texture.image];
        if (!image) {
            image = frozen.images.size();
            frozen.images.push_back(scene.images[texture.image]);
        }
        texture.image = *image;
        texture.uvSet = 0;
        frozen.materials[mesh.material].baseColorTexture = texture;
    }
}

void warnOfLostEmission(const Scene& scene, Scene& frozen) {
    std::vector<bool> isLost(scene.materials.size());
    for (const Mesh& mesh : scene.meshes)
        if (keepsTexture(scene, mesh) &&
            scene.materials[mesh.material].emissiveFactor != Vec3f(0.0f))
            isLost[mesh.material] = true;
    for (std::size_t i = 0; i < isLost.size(); ++i)
        if (isLost[i])
            frozen.warnings.push_back("material " + std::to_string(i) +
                                      " has a texture of base colour, so what it emits is left "
                                      "out");
}

}  // namespace

Scene freezeScene(const Scene& scene, std::span<const Vec3f> vertexRadiance,
                  const DisplayOptions& display) {
    PRT_ASSERT(vertexRadiance.size() == scene.vertexCount(), "one radiance a vertex");
    Scene frozen = stripScene(scene);
    keepTextures(scene, frozen);
    warnOfLostEmission(scene, frozen);
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        frozen.materials[i].baseColorFactor.w = scene.materials[i].baseColorFactor.w;

    const auto points = findVertexPoints(scene);
    std::size_t vertex = 0;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const Mesh& mesh = scene.meshes[m];
        const bool showsEmission = !keepsTexture(scene, mesh);
        for (std::size_t i = 0; i < mesh.vertexCount(); ++i, ++vertex) {
            Vec3f radiance = vertexAlbedo(scene, mesh, i) * vertexRadiance[vertex];
            if (showsEmission && points[vertex])
                radiance += evaluateEmission(scene, *points[vertex]);
            frozen.meshes[m].colors.push_back(
                withAlpha(exposeForDisplay(radiance, display),
                          mesh.colors.empty() ? 1.0f : mesh.colors[i].w));
        }
    }
    return frozen;
}

Scene freezeView(const Scene& scene, std::span<const ExitRadiance> vertexRadiance, const Vec3f& eye,
                 const MirrorEnvironment* mirrors, const DisplayOptions& display) {
    Scene frozen = stripScene(scene);
    const std::vector<Vec3f> shaded = shadeVertices(scene, vertexRadiance, eye, mirrors);
    const auto points = findVertexPoints(scene);
    std::size_t vertex = 0;
    for (Mesh& mesh : frozen.meshes) {
        mesh.colors.assign(mesh.vertexCount(), Vec4f(0.0f, 0.0f, 0.0f, 1.0f));
        for (Vec4f& color : mesh.colors) {
            const auto& point = points[vertex];
            if (point)
                color = withAlpha(
                    exposeForDisplay(shaded[vertex] + evaluateEmission(scene, *point), display),
                    evaluateBaseColor(scene, *point).w);
            ++vertex;
        }
    }
    return frozen;
}

}  // namespace prt
