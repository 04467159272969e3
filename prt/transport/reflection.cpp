// Bibliography
//   [Kautz02]  BRDFs as spherical harmonics over incident directions
#include "prt/transport/reflection.h"

#include <algorithm>
#include <utility>

#include "prt/base/assert.h"
#include "prt/basis/sh.h"

namespace prt {

SurfaceReflection lambertReflection(const Scene& scene) {
    return [&scene](const SurfacePoint& point, const Vec3f&, std::span<float> response) {
        const std::size_t coefficientCount = response.size() / 3;
        PRT_ASSERT(coefficientCount >= 4, "the cosine has two bands");
        const Vec3f albedo = evaluateAlbedo(scene, point);
        for (std::size_t channel = 0; channel < 3; ++channel)
            response[channel * coefficientCount + shIndex(1, 0)] +=
                kLambertResponse * albedo[static_cast<int>(channel)];
    };
}

SurfaceReflection gltfReflection(const Scene& scene, std::shared_ptr<const GltfViewTable> table) {
    return [&scene, table = std::move(table)](const SurfacePoint& point, const Vec3f& view,
                                              std::span<float> response) {
        table->addResponse(evaluateAlbedo(scene, point), evaluateMetallicRoughness(scene, point),
                           view, response);
    };
}

SurfaceReflection brdfReflection(const Scene& scene,
                                 std::vector<std::shared_ptr<const BrdfViewTable>> tables,
                                 std::shared_ptr<const GltfViewTable> gltf) {
    PRT_ASSERT(tables.size() == scene.materials.size(), "there is a table a material, or null");
    PRT_ASSERT(gltf || std::find(tables.begin(), tables.end(), nullptr) == tables.end(),
               "materials that stay have a table too");
    return [&scene, tables = std::move(tables), ofGltf = gltfReflection(scene, std::move(gltf))](
               const SurfacePoint& point, const Vec3f& view, std::span<float> response) {
        if (const auto& table = tables[scene.meshes[point.mesh].material])
            table->addResponse(view, response);
        else
            ofGltf(point, view, response);
    };
}

}  // namespace prt
