// Form factors of a cube's inside are known: 0.199824896 between opposite faces and 0.200043776
// between adjacent ones, averaged over a face (A14; [Goral84] had .200 for both).
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "prt/scene/procedural.h"
#include "tests/support/scenes.h"
#include "tests/transport/gathered_scene.h"

namespace prt {
namespace {

using test::assembleScene;
using test::GatheredScene;

constexpr int kCellCount = 24;

std::size_t faceOf(const Vec3f& normal) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (std::abs(normal[static_cast<int>(axis)]) > 0.5f)
            return 2 * axis + (normal[static_cast<int>(axis)] > 0.0f ? 1 : 0);
    return 0;
}

/// The share of a face's area that belongs to one of its vertices, by the trapezoidal rule.
double vertexShare(const Vec3f& position) {
    double share = 1.0 / (kCellCount * kCellCount);
    int rimCount = -1;  // every vertex of a face of a cube lies on that face's plane
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(std::abs(position[axis]) - 0.5f) < 1e-4f) ++rimCount;
    for (; rimCount > 0; --rimCount)
        share *= 0.5;
    return share;
}

TEST(FormFactors, OfACubesInsideAreTheKnownOnes) {  // A14
    const Scene scene = assembleScene(
        {{makeBox({-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}, true, kCellCount), {1, 1, 1}}});
    const GatheredScene gathered(scene, 4096);
    const Mesh& mesh = scene.meshes[0];

    // Face of each receiver, and its share of it.
    std::vector<std::size_t> faces(gathered.receivers.fronts.size());
    std::vector<double> shares(faces.size());
    for (std::size_t vertex = 0; vertex < mesh.vertexCount(); ++vertex) {
        const std::uint32_t receiver = gathered.receivers.frontOfVertex[vertex];
        faces[receiver] = faceOf(mesh.normals[vertex]);
        shares[receiver] = vertexShare(mesh.positions[vertex]);
    }

    std::array<std::array<double, 6>, 6> factors{};
    gathered.hits.visitSlab(0, [&](const HitSlab& slab) {
        for (std::size_t row = 0; row < slab.receivers.size(); ++row)
            for (const BounceEntry& entry : slab.row(row))
                factors[faces[slab.receivers[row]]][faces[entry.receiver]] +=
                    shares[slab.receivers[row]] * static_cast<double>(entry.weight.x);
    });
    for (std::size_t from = 0; from < 6; ++from) {
        double sum = 0.0;
        for (std::size_t to = 0; to < 6; ++to) {
            const double expected = from == to           ? 0.0
                                    : from / 2 == to / 2 ? 0.199824896
                                                         : 0.200043776;
            EXPECT_NEAR(factors[from][to], expected, 1e-3) << from << " to " << to;
            sum += factors[from][to];
        }
        EXPECT_NEAR(sum, 1.0, 1e-5);
    }
}

}  // namespace
}  // namespace prt
