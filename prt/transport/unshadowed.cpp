#include "prt/transport/unshadowed.h"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "prt/basis/sh.h"
#include "prt/basis/zonal.h"
#include "prt/transport/visibility_matrix.h"

namespace prt {
namespace {

/// A field whose one layer has a receiver for each vertex, its row made of the vertex's normal.
///
/// @param makeRow  writes coefficientsPerReceiver() numbers
template <class MakeRow>
TransferField makeOfNormals(const Scene& scene, int bandCount, Transport transport,
                            int incidentBandCount, const MakeRow& makeRow) {
    TransferField field{bandCount, scene.vertexCount(), {}, {}};
    field.receiverOfVertex.resize(field.receiverCount);
    std::iota(field.receiverOfVertex.begin(), field.receiverOfVertex.end(), 0u);

    const std::size_t length = coefficientsPerReceiver(bandCount, 1, incidentBandCount);
    TransferLayer layer{transport, 1, CoefficientTable(field.receiverCount, length, sizeof(float)),
                        incidentBandCount};
    std::vector<float> row(length);
    std::size_t receiver = 0;
    for (const Mesh& mesh : scene.meshes)
        for (const Vec3f& normal : mesh.normals) {
            makeRow(normal, std::span(row));
            layer.coefficients.writeRows(receiver++, std::span<const float>(row));
        }
    field.layers.push_back(std::move(layer));
    return field;
}

}  // namespace

TransferField makeUnshadowedTransfer(const Scene& scene, int bandCount) {
    return makeOfNormals(scene, bandCount, Transport::unshadowed, 0,
                         [&](const Vec3f& normal, std::span<float> row) {
                             unshadowedTransfer(normal, bandCount, row);
                         });
}

TransferField makeUnshadowedMatrices(const Scene& scene, int bandCount, int incidentBandCount) {
    const VisibilityMatrix matrices(incidentBandCount, bandCount);
    const std::vector<double> cap =
        capZonal(matrices.visibilityBandCount(), 0.5 * std::numbers::pi);
    const auto count = static_cast<std::size_t>(shCoefficientCount(matrices.visibilityBandCount()));
    std::vector<double> turned(count);
    std::vector<float> visibility(count), scratch(matrices.elementCount());
    return makeOfNormals(scene, bandCount, Transport::glossyShadowed, incidentBandCount,
                         [&](const Vec3f& normal, std::span<float> row) {
                             rotateZonal(cap, Vec3d(normal).normalized(), turned);
                             std::transform(turned.begin(), turned.end(), visibility.begin(),
                                            [](double value) { return static_cast<float>(value); });
                             matrices.make(visibility, normal, scratch, row);
                         });
}

}  // namespace prt
