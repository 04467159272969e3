#include "prt/compress/encode_vectors.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "prt/compress/row_kernel.h"
#include "prt/parallel/parallel_for.h"

namespace prt {

StoredNumbers unweighSubspace(const WeightedVectors& vectors, const Subspace& subspace,
                              std::size_t axisCount) {
    StoredNumbers stored{unweighPoint(vectors, subspace.mean), {}};
    for (std::size_t p = 0; p < axisCount; ++p) {
        const std::vector<float> component = unweighDirection(
            vectors, std::span(subspace.axes).subspan(p * vectors.dimension, vectors.dimension));
        stored.components.insert(stored.components.end(), component.begin(), component.end());
    }
    return stored;
}

double encodeVectors(const WeightedVectors& vectors, std::span<const std::uint32_t> members,
                     const StoredSubspace& subspace, std::size_t weightStride,
                     std::span<float> weights, int threadCount) {
    constexpr std::size_t kChunkSize = 4096, kRowsAtOnce = 64;
    const std::size_t dimension = vectors.dimension;
    const std::size_t size = paddedSize(dimension);
    const std::size_t axisCount = subspace.components.size() / dimension;
    const std::vector<double> mean = weighPoint(vectors, subspace.mean);
    std::vector<double> axes(axisCount * size, 0.0);
    for (std::size_t p = 0; p < axisCount; ++p) {
        const std::vector<double> axis =
            weighDirection(vectors, subspace.components.subspan(p * dimension, dimension));
        std::copy(axis.begin(), axis.end(), axes.begin() + static_cast<std::ptrdiff_t>(p * size));
    }
    // Stored weights are in the units of the error: u times those in the space of y.
    const double unit = std::sqrt(vectors.squaredErrorUnit);
    std::vector<double> errors((members.size() + kChunkSize - 1) / kChunkSize, 0.0);
    parallelFor(members.size(), {threadCount, kChunkSize}, [&](std::size_t begin, std::size_t end) {
        std::vector<double> rows(kRowsAtOnce * size);
        double& error = errors[begin / kChunkSize];
        for (std::size_t i = begin; i < end; i += kRowsAtOnce) {
            const auto batch = members.subspan(i, std::min(kRowsAtOnce, end - i));
            gatherRows(vectors, batch, mean, rows);
            for (std::size_t k = 0; k < batch.size(); ++k) {
                const auto own = weights.subspan(batch[k] * weightStride, axisCount);
                error +=
                    projectRow(std::span<const double>(rows).subspan(k * size, size), axes, own);
                for (float& weight : own)
                    weight = static_cast<float>(weight * unit);
            }
        }
    });
    return vectors.squaredErrorUnit * std::accumulate(errors.begin(), errors.end(), 0.0);
}

}  // namespace prt
