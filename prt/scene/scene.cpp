#include "prt/scene/scene.h"

#include <algorithm>
#include <limits>

#include "prt/base/assert.h"

namespace prt {

std::size_t Scene::vertexCount() const {
    std::size_t count = 0;
    for (const Mesh& mesh : meshes)
        count += mesh.vertexCount();
    return count;
}

std::size_t Scene::triangleCount() const {
    std::size_t count = 0;
    for (const Mesh& mesh : meshes)
        count += mesh.triangleCount();
    return count;
}

std::vector<std::size_t> vertexOffsets(const Scene& scene) {
    std::vector<std::size_t> offsets{0};
    for (const Mesh& mesh : scene.meshes)
        offsets.push_back(offsets.back() + mesh.vertexCount());
    return offsets;
}

Bounds computeBounds(const Scene& scene) {
    PRT_ASSERT(scene.vertexCount() > 0, "there is something to bound");
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    Bounds bounds{Vec3f(kInfinity), Vec3f(-kInfinity)};
    for (const Mesh& mesh : scene.meshes) {
        for (const Vec3f& position : mesh.positions) {
            for (int axis = 0; axis < 3; ++axis) {
                bounds.low[axis] = std::min(bounds.low[axis], position[axis]);
                bounds.high[axis] = std::max(bounds.high[axis], position[axis]);
            }
        }
    }
    return bounds;
}

}  // namespace prt
