#include "prt/relight/receiver_surface.h"

#include <algorithm>
#include <limits>

#include "prt/base/assert.h"

namespace prt {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// The first vertex of each receiver, numbered mesh after mesh.
std::vector<std::size_t> findFirstVertices(const CompressedTransfer& transfer) {
    std::vector<std::size_t> first(transfer.receiverCount, kNone);
    for (std::size_t vertex = 0; vertex < transfer.receiverOfVertex.size(); ++vertex) {
        std::size_t& known = first[transfer.receiverOfVertex[vertex]];
        known = std::min(known, vertex);
    }
    return first;
}

/// The `corner`th corner of a triangle.
SurfacePoint cornerPoint(std::size_t mesh, std::size_t triangle, std::size_t corner) {
    return {.mesh = mesh,
            .triangle = triangle,
            .u = corner == 1 ? 1.0f : 0.0f,
            .v = corner == 2 ? 1.0f : 0.0f};
}

}  // namespace

std::vector<ReceiverSurface> describeReceivers(const Scene& scene,
                                               const CompressedTransfer& transfer) {
    PRT_ASSERT(transfer.receiverOfVertex.size() == scene.vertexCount(),
               "the transfer is that of the scene");
    const std::vector<std::size_t> firstVertices = findFirstVertices(transfer);
    const std::vector<std::size_t> offsets = vertexOffsets(scene);
    std::vector<ReceiverSurface> receivers(transfer.receiverCount);
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const Mesh& mesh = scene.meshes[m];
        const Material& material = scene.materials[mesh.material];

        // Take what the vertices hold themselves.
        for (std::size_t vertex = 0; vertex < mesh.vertexCount(); ++vertex) {
            const std::size_t receiver = transfer.receiverOfVertex[offsets[m] + vertex];
            if (firstVertices[receiver] != offsets[m] + vertex) continue;
            receivers[receiver] = {
                mesh.positions[vertex], mesh.normals[vertex], mesh.material,
                MetallicRoughness{material.metallicFactor, material.roughnessFactor}};
        }

        // Look textures up at a triangle's corner.
        for (std::size_t corner = 0; corner < mesh.indices.size(); ++corner) {
            const std::size_t vertex = mesh.indices[corner];
            const std::size_t receiver = transfer.receiverOfVertex[offsets[m] + vertex];
            if (firstVertices[receiver] == offsets[m] + vertex)
                receivers[receiver].surface =
                    evaluateMetallicRoughness(scene, cornerPoint(m, corner / 3, corner % 3));
        }
    }
    return receivers;
}

}  // namespace prt
