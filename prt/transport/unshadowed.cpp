#include "prt/transport/unshadowed.h"

#include <numeric>
#include <utility>
#include <vector>

#include "prt/basis/sh.h"
#include "prt/basis/zonal.h"

namespace prt {

TransferField makeUnshadowedTransfer(const Scene& scene, int bandCount) {
    const auto coefficientCount = static_cast<std::size_t>(shCoefficientCount(bandCount));
    TransferField field{bandCount, scene.vertexCount(), {}, {}};
    field.receiverOfVertex.resize(field.receiverCount);
    std::iota(field.receiverOfVertex.begin(), field.receiverOfVertex.end(), 0u);

    TransferLayer layer{Transport::unshadowed, 1,
                        CoefficientTable(field.receiverCount, coefficientCount, sizeof(float))};
    std::vector<float> row(coefficientCount);
    std::size_t receiver = 0;
    for (const Mesh& mesh : scene.meshes)
        for (const Vec3f& normal : mesh.normals) {
            unshadowedTransfer(normal, bandCount, row);
            layer.coefficients.writeRows(receiver++, std::span<const float>(row));
        }
    field.layers.push_back(std::move(layer));
    return field;
}

}  // namespace prt
