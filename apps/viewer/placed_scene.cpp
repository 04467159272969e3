#include "apps/viewer/placed_scene.h"

#include <optional>

namespace prt::viewer {
namespace {

Mesh placeMesh(Mesh mesh, const Affine3d& worldFromObject) {
    for (Vec3f& position : mesh.positions)
        position = Vec3f(transformPoint(worldFromObject, Vec3d(position)));
    for (Vec3f& normal : mesh.normals)
        normal = Vec3f(worldFromObject.linear * Vec3d(normal));
    return mesh;
}

void addScene(const Scene& source, const Affine3d& worldFromObject, Scene& scene) {
    const std::size_t firstMaterial = scene.materials.size();
    const std::size_t firstImage = scene.images.size();
    for (const Mesh& mesh : source.meshes) {
        scene.meshes.push_back(placeMesh(mesh, worldFromObject));
        scene.meshes.back().material += firstMaterial;
    }
    for (Material material : source.materials) {
        for (std::optional<TextureUse>* use :
             {&material.baseColorTexture, &material.emissiveTexture,
              &material.metallicRoughnessTexture})
            if (*use) (*use)->image += firstImage;
        scene.materials.push_back(std::move(material));
    }
    for (const TextureImage& image : source.images)
        scene.images.push_back({.name = image.name,
                                .mimeType = image.mimeType,
                                .encoded = {},
                                .pixels = image.pixels});
}

}  // namespace

bool operator==(const PlacedAsset& a, const PlacedAsset& b) {
    return a.asset == b.asset && a.worldFromObject.linear == b.worldFromObject.linear &&
           a.worldFromObject.translation == b.worldFromObject.translation;
}

Scene assembleWorld(std::span<const PlacedAsset> assets) {
    Scene scene;
    for (const PlacedAsset& placed : assets)
        addScene(placed.asset->scene, placed.worldFromObject, scene);
    return scene;
}

}  // namespace prt::viewer
