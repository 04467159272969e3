#include "prt/gltf/gltf_scene.h"

#include "prt/gltf/gltf_document.h"

namespace prt {

Scene readGltf(const std::filesystem::path& path, const GltfLimits& limits) {
    return GltfDocument(path, limits).flatten().scene;
}

}  // namespace prt
