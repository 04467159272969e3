// Bibliography
//   [Jolliffe02]  Principal component analysis
#include "prt/compress/pca.h"

#include "prt/base/assert.h"
#include "prt/compress/encode_vectors.h"
#include "prt/compress/principal_axes.h"
#include "prt/compress/weighted_vectors.h"

namespace prt {
namespace {

/// The fewest axes that keep an error, or all.
std::size_t countAxes(const PrincipalAxes& axes, double maxSquaredError) {
    std::size_t count = 0;
    while (count < axes.squares.size() && axes.squaredError(count) > maxSquaredError)
        ++count;
    return count;
}

}  // namespace

Pca computePca(const VectorSet& vectors, const PcaOptions& options) {
    const WeightedVectors weighted = weighVectors(vectors, options.threadCount);
    const std::vector<std::uint32_t> all = allIndices(weighted.count());
    const PrincipalAxes axes =
        findPrincipalAxes(weighted, all, options.componentCount, options.threadCount);
    const double maxSquaredError = options.maxError * options.maxError *
                                   static_cast<double>(vectors.numbers.size()) /
                                   weighted.squaredErrorUnit;
    const std::size_t count = countAxes(axes, maxSquaredError);

    StoredNumbers stored = unweighSubspace(weighted, axes.subspace, count);
    Pca pca{
        vectors.dimension, std::move(stored.mean), std::move(stored.components), {}, {}, 0.0, 0.0};
    pca.weights.resize(vectors.count() * count);
    for (std::size_t p = 0; p < count; ++p)
        pca.squares.push_back(weighted.squaredErrorUnit * axes.squares[p]);
    pca.totalSquares = weighted.squaredErrorUnit * axes.totalSquares;
    pca.squaredError = encodeVectors(weighted, all, {pca.mean, pca.components}, count, pca.weights,
                                     options.threadCount);
    return pca;
}

void expandVector(const Pca& pca, std::size_t vector, std::span<float> numbers) {
    PRT_ASSERT(numbers.size() == pca.dimension, "there is room for one vector");
    const std::size_t count = pca.componentCount();
    for (std::size_t j = 0; j < pca.dimension; ++j) {
        double sum = pca.mean[j];
        for (std::size_t p = 0; p < count; ++p)
            sum += double{pca.weights[vector * count + p]} * pca.components[p * pca.dimension + j];
        numbers[j] = static_cast<float>(sum);
    }
}

}  // namespace prt
