#include "prt/gltf/vertex_order.h"

#include <meshoptimizer.h>

#include <limits>
#include <vector>

#include "prt/base/assert.h"

namespace prt {
namespace {

constexpr unsigned int kUnused = std::numeric_limits<unsigned int>::max();

/// The new number of each vertex: those that triangles use as they are met, then the others.
std::vector<unsigned int> numberVertices(const Mesh& mesh) {
    std::vector<unsigned int> numbers(mesh.vertexCount());
    std::size_t next = meshopt_optimizeVertexFetchRemap(numbers.data(), mesh.indices.data(),
                                                        mesh.indices.size(), numbers.size());
    for (unsigned int& number : numbers)
        if (number == kUnused) number = static_cast<unsigned int>(next++);
    return numbers;
}

template <class Value>
void reorder(std::span<Value> values, const std::vector<unsigned int>& numbers) {
    const std::vector<Value> old(values.begin(), values.end());
    for (std::size_t i = 0; i < old.size(); ++i)
        values[numbers[i]] = old[i];
}

}  // namespace

void orderForEncoding(Scene& scene, std::span<std::uint32_t> numbers) {
    PRT_ASSERT(numbers.size() == scene.vertexCount(), "there is a number for each vertex");
    std::size_t firstVertex = 0;
    for (Mesh& mesh : scene.meshes) {
        const std::size_t vertexCount = mesh.vertexCount();
        meshopt_optimizeVertexCache(mesh.indices.data(), mesh.indices.data(), mesh.indices.size(),
                                    vertexCount);
        const std::vector<unsigned int> order = numberVertices(mesh);
        for (std::uint32_t& index : mesh.indices)
            index = order[index];
        reorder(std::span(mesh.positions), order);
        reorder(std::span(mesh.normals), order);
        for (std::vector<Vec2f>& uvs : mesh.uvSets)
            reorder(std::span(uvs), order);
        reorder(std::span(mesh.colors), order);
        reorder(numbers.subspan(firstVertex, vertexCount), order);
        firstVertex += vertexCount;
    }
}

}  // namespace prt
