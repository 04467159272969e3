#include "prt/compress/weighted_vectors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "prt/base/assert.h"
#include "prt/parallel/parallel_for.h"

namespace prt {
namespace {

/// What one pass over some vectors tells of each dimension.
struct Extent {
    std::vector<double> sum;
    std::vector<float> low, high;
};

Extent measureExtent(std::span<const float> rows, std::size_t dimension) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    Extent extent{std::vector<double>(dimension, 0.0), std::vector<float>(dimension, kInfinity),
                  std::vector<float>(dimension, -kInfinity)};
    double* sum = extent.sum.data();
    float* low = extent.low.data();
    float* high = extent.high.data();
    for (const float* row = rows.data(); row != rows.data() + rows.size(); row += dimension) {
        for (std::size_t j = 0; j < dimension; ++j) {
            sum[j] += row[j];
            low[j] = std::min(low[j], row[j]);
            high[j] = std::max(high[j], row[j]);
        }
    }
    return extent;
}

/// The same of all, by chunks whose sums are added in sequence.
Extent measureExtent(const VectorSet& vectors, int threadCount) {
    constexpr std::size_t kChunkSize = 16384;
    const std::size_t count = vectors.count();
    std::vector<Extent> parts((count + kChunkSize - 1) / kChunkSize);
    parallelFor(count, {threadCount, kChunkSize}, [&](std::size_t begin, std::size_t end) {
        parts[begin / kChunkSize] = measureExtent(
            vectors.numbers.subspan(begin * vectors.dimension, (end - begin) * vectors.dimension),
            vectors.dimension);
    });
    Extent all = std::move(parts.front());
    for (std::size_t part = 1; part < parts.size(); ++part) {
        for (std::size_t j = 0; j < vectors.dimension; ++j) {
            all.sum[j] += parts[part].sum[j];
            all.low[j] = std::min(all.low[j], parts[part].low[j]);
            all.high[j] = std::max(all.high[j], parts[part].high[j]);
        }
    }
    return all;
}

}  // namespace

WeightedVectors weighVectors(const VectorSet& vectors, int threadCount) {
    PRT_ASSERT(vectors.dimension > 0 && !vectors.numbers.empty() &&
                   vectors.numbers.size() % vectors.dimension == 0,
               "there are whole vectors, at least one");
    PRT_ASSERT(vectors.errorWeights.empty() || vectors.errorWeights.size() == vectors.dimension,
               "each dimension has a weight");
    PRT_ASSERT(vectors.count() <= std::numeric_limits<std::uint32_t>::max(),
               "a vector has an index of 32 bits");
    const Extent extent = measureExtent(vectors, threadCount);
    WeightedVectors weighted{vectors.numbers, vectors.dimension, {}, {}, 1.0};
    double largest = 0.0;
    std::vector<double> weights(vectors.dimension, 1.0);
    for (std::size_t j = 0; j < vectors.dimension; ++j) {
        if (!vectors.errorWeights.empty()) weights[j] = vectors.errorWeights[j];
        PRT_ASSERT(std::isfinite(weights[j]) && weights[j] > 0.0, "every weight is positive");
        PRT_ASSERT(std::isfinite(extent.sum[j]), "every number is finite");
        const float origin =
            static_cast<float>(extent.sum[j] / static_cast<double>(vectors.count()));
        const double reach =
            std::max(extent.high[j] - double{origin}, double{origin} - extent.low[j]);
        largest = std::max(largest, weights[j] * reach);
        weighted.origin.push_back(origin);
    }
    int exponent = 0;
    std::frexp(largest, &exponent);
    const double unit = largest > 0.0 ? std::ldexp(1.0, exponent) : 1.0;
    weighted.squaredErrorUnit = unit * unit;
    for (const double weight : weights)
        weighted.scale.push_back(static_cast<float>(weight / unit));
    return weighted;
}

std::vector<float> unweighPoint(const WeightedVectors& vectors, std::span<const double> point) {
    std::vector<float> numbers(vectors.dimension);
    for (std::size_t j = 0; j < numbers.size(); ++j)
        numbers[j] = static_cast<float>(vectors.origin[j] + point[j] / vectors.scale[j]);
    return numbers;
}

std::vector<float> unweighDirection(const WeightedVectors& vectors,
                                    std::span<const double> direction) {
    std::vector<float> numbers(vectors.dimension);
    const double unit = std::sqrt(vectors.squaredErrorUnit);
    for (std::size_t j = 0; j < numbers.size(); ++j)
        numbers[j] = static_cast<float>(direction[j] / (vectors.scale[j] * unit));
    return numbers;
}

std::vector<double> weighPoint(const WeightedVectors& vectors, std::span<const float> point) {
    std::vector<double> weighted(vectors.dimension);
    for (std::size_t j = 0; j < weighted.size(); ++j)
        weighted[j] = (double{point[j]} - vectors.origin[j]) * vectors.scale[j];
    return weighted;
}

std::vector<double> weighDirection(const WeightedVectors& vectors,
                                   std::span<const float> direction) {
    std::vector<double> weighted(vectors.dimension);
    const double unit = std::sqrt(vectors.squaredErrorUnit);
    for (std::size_t j = 0; j < weighted.size(); ++j)
        weighted[j] = double{direction[j]} * vectors.scale[j] * unit;
    return weighted;
}

VectorGroups groupByLabel(std::span<const std::uint32_t> indices,
                          std::span<const std::uint32_t> labels, std::size_t groupCount) {
    VectorGroups groups{std::vector<std::size_t>(groupCount + 1, 0),
                        std::vector<std::uint32_t>(indices.size())};
    for (const std::uint32_t label : labels)
        ++groups.first[label + 1];
    std::partial_sum(groups.first.begin(), groups.first.end(), groups.first.begin());
    std::vector<std::size_t> next(groups.first.begin(), groups.first.end() - 1);
    for (std::size_t i = 0; i < indices.size(); ++i)
        groups.order[next[labels[i]]++] = indices[i];
    return groups;
}

std::vector<std::uint32_t> allIndices(std::size_t count) {
    std::vector<std::uint32_t> indices(count);
    std::iota(indices.begin(), indices.end(), 0u);
    return indices;
}

}  // namespace prt
