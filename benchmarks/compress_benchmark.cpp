// Compression of a million vectors by one thread, against multiply-adds of the same run.
//
// The vectors have a structure of 12 dimensions: clouds about 64 points, with some noise in all
// dimensions. of_multiply_adds is the CPU time over that of the multiply-adds that an exhaustive
// search would take, at the rate of the widest vectors: N K d for an iteration of k-means,
// N K (1 + P) d for one of clustered PCA, and for principal components N d² / 2, their matrix.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "benchmarks/yardsticks.h"
#include "prt/base/random.h"
#include "prt/compress/clustered_pca.h"
#include "prt/compress/kmeans.h"
#include "prt/compress/pca.h"
#include "prt/math/isa.h"

namespace prt {
namespace {

constexpr std::size_t kVectorCount = 1'000'000;
constexpr std::size_t kClusterCount = 256;

/// Sum of four uniform numbers, of variance 1.
float drawNumber(RandomStream& random) {
    float sum = -2.0f;
    for (int i = 0; i < 4; ++i)
        sum += random.nextUnitFloat();
    return sum * 1.7320508f;
}

std::vector<float> makeVectors(std::size_t count, std::size_t dimension) {
    constexpr std::size_t kStructure = 12, kCloudCount = 64;
    RandomStream random(1, dimension);
    std::vector<float> factors(kStructure * dimension), clouds(kCloudCount * kStructure);
    for (float& factor : factors)
        factor = drawNumber(random);
    for (float& number : clouds)
        number = 2.0f * drawNumber(random);
    std::vector<float> vectors(count * dimension, 0.0f);
    for (std::size_t i = 0; i < count; ++i) {
        float* vector = &vectors[i * dimension];
        const float* cloud = &clouds[random.nextBits() % kCloudCount * kStructure];
        for (std::size_t s = 0; s < kStructure; ++s) {
            const float amount = cloud[s] + drawNumber(random);
            for (std::size_t j = 0; j < dimension; ++j)
                vector[j] += amount * factors[s * dimension + j];
        }
        for (std::size_t j = 0; j < dimension; ++j)
            vector[j] += 0.05f * drawNumber(random);
    }
    return vectors;
}

const std::vector<float>& vectorsOf(std::size_t dimension) {
    static std::size_t held = 0;
    static std::vector<float> vectors;
    if (held != dimension) {
        vectors = {};
        vectors = makeVectors(kVectorCount, dimension);
        held = dimension;
    }
    return vectors;
}

/// @param multiplyAdds  of single numbers, that the work takes
void report(benchmark::State& state, double seconds, double multiplyAdds) {
    const Isa isa = detectIsa();
    const double lanes = isa == Isa::avx512 ? 16.0 : isa == Isa::avx2 ? 8.0 : 4.0;
    state.counters["seconds"] = seconds;
    state.counters["of_multiply_adds"] =
        seconds / (multiplyAdds / lanes * measureMultiplyAddSeconds());
}

/// The difference between the fastest runs with more and with fewer iterations, over their number.
void iterateKMeans(benchmark::State& state) {
    const auto dimension = static_cast<std::size_t>(state.range(0));
    const VectorSet vectors{vectorsOf(dimension), dimension};
    const auto run = [&](std::size_t iterationCount) {
        const double start = readCpuSeconds();
        benchmark::DoNotOptimize(computeKMeans(
            vectors,
            {.clusterCount = kClusterCount, .iterationCount = iterationCount, .threadCount = 1}));
        return readCpuSeconds() - start;
    };
    constexpr std::size_t kFew = 1, kMany = 6;
    double few = 1e30, many = 1e30;
    for (auto _ : state) {
        few = std::min(few, run(kFew));
        many = std::min(many, run(kMany));
    }
    const double seconds = (many - few) / (kMany - kFew);
    report(state, seconds, 1e0 * kVectorCount * kClusterCount * static_cast<double>(dimension));
}

void findComponents(benchmark::State& state) {
    const auto dimension = static_cast<std::size_t>(state.range(0));
    const VectorSet vectors{vectorsOf(dimension), dimension};
    double seconds = 1e30;
    for (auto _ : state) {
        const double start = readCpuSeconds();
        benchmark::DoNotOptimize(computePca(vectors, {.componentCount = 8, .threadCount = 1}));
        seconds = std::min(seconds, readCpuSeconds() - start);
    }
    report(state, seconds,
           0.5 * kVectorCount * static_cast<double>(dimension) * static_cast<double>(dimension));
}

/// From vectors to encoded vectors, with 20 iterations.
void clusterComponents(benchmark::State& state) {
    const auto dimension = static_cast<std::size_t>(state.range(0));
    const VectorSet vectors{vectorsOf(dimension), dimension};
    constexpr std::size_t kComponentCount = 8, kIterationCount = 20;
    double seconds = 0.0, squaredError = 0.0;
    for (auto _ : state) {
        const double start = readCpuSeconds();
        const ClusteredPca pca = computeClusteredPca(vectors, {.clusterCount = kClusterCount,
                                                               .componentCount = kComponentCount,
                                                               .iterationCount = kIterationCount,
                                                               .threadCount = 1});
        seconds = readCpuSeconds() - start;
        squaredError = pca.squaredError;
    }
    report(state, seconds,
           1e0 * kIterationCount * kVectorCount * kClusterCount * (1 + kComponentCount) *
               static_cast<double>(dimension));
    state.counters["rms_error"] =
        std::sqrt(squaredError / static_cast<double>(vectors.numbers.size()));
}

BENCHMARK(iterateKMeans)
    ->ArgName("d")
    ->Arg(25)
    ->Arg(75)
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(findComponents)
    ->ArgName("d")
    ->Arg(25)
    ->Arg(75)
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(clusterComponents)
    ->ArgName("d")
    ->Arg(25)
    ->Arg(75)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace prt

BENCHMARK_MAIN();
