#include "prt/scene/weld.h"

#include "prt/base/assert.h"
#include "prt/base/error.h"
#include "prt/scene/vertex_grouping.h"

namespace prt {
namespace {

template <class KeyOfVertex>
Welding weldByKey(const Scene& scene, const KeyOfVertex& keyOfVertex) {
    const std::size_t vertexCount = scene.vertexCount();
    if (vertexCount >= 0xffffffffu) {
        throw Error(ErrorCode::limitExceeded, "the scene has more than 4294967294 vertices");
    }
    Welding welding;
    welding.groupOfVertex.reserve(vertexCount);
    VertexGrouping grouping(vertexCount);
    for (const Mesh& mesh : scene.meshes) {
        for (std::size_t vertex = 0; vertex < mesh.vertexCount(); ++vertex) {
            const std::uint32_t group = grouping.groupOf(keyOfVertex(mesh, vertex));
            if (group == welding.vertexOfGroup.size()) {
                welding.vertexOfGroup.push_back(
                    static_cast<std::uint32_t>(welding.groupOfVertex.size()));
            }
            welding.groupOfVertex.push_back(group);
        }
    }
    return welding;
}

}  // namespace

Welding weldVertices(const Scene& scene) {
    return weldByKey(scene, [&](const Mesh& mesh, std::size_t vertex) {
        PRT_ASSERT(mesh.normals.size() == mesh.positions.size(), "every vertex has a normal");
        VertexKey key{};
        putVector(key, 0, mesh.positions[vertex]);
        putVector(key, 3, mesh.normals[vertex]);
        key[6] = scene.materials[mesh.material].doubleSided ? 1u : 0u;
        return key;
    });
}

Welding weldPositions(const Scene& scene) {
    return weldByKey(scene, [](const Mesh& mesh, std::size_t vertex) {
        VertexKey key{};
        putVector(key, 0, mesh.positions[vertex]);
        return key;
    });
}

}  // namespace prt
