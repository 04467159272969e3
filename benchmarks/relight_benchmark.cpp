// Relighting of a million receivers by one thread, against what the same thread can read from
// memory in the same run.
//
// Bytes counted: the transfer that is read, once, and the 12 bytes of RGB written for each
// receiver. of_read_bandwidth is their rate over that of summing 256 MB, measured just before and
// after; it can exceed 1 where transfer stays in the last-level cache from one frame to the next.
#include <benchmark/benchmark.h>
#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <vector>

#include "prt/base/assert.h"
#include "prt/base/random.h"
#include "prt/relight/relighter.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "benchmarks/relight_benchmark.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace prt::HWY_NAMESPACE {
namespace {

/// Adds up numbers with the widest vectors, in four chains. @param count  a multiple of 256
float sumFloats(const float* values, std::size_t count) {
    namespace hn = hwy::HWY_NAMESPACE;
    const hn::ScalableTag<float> d;
    const std::size_t step = hn::Lanes(d);
    auto a = hn::Zero(d);
    auto b = a;
    auto c = a;
    auto e = a;
    for (std::size_t i = 0; i < count; i += 4 * step) {
        a = hn::Add(a, hn::Load(d, values + i));
        b = hn::Add(b, hn::Load(d, values + i + step));
        c = hn::Add(c, hn::Load(d, values + i + 2 * step));
        e = hn::Add(e, hn::Load(d, values + i + 3 * step));
    }
    return hn::GetLane(hn::SumOfLanes(d, hn::Add(hn::Add(a, b), hn::Add(c, e))));
}

}  // namespace
}  // namespace prt::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace prt {

HWY_EXPORT(sumFloats);

namespace {

constexpr std::size_t kReceiverCount = 1'000'000;
constexpr std::size_t kReadFloats = std::size_t{64} << 20;  // 256 MB

double threadSeconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

const float* readBuffer() {
    static const auto buffer = [] {
        auto floats = hwy::AllocateAligned<float>(kReadFloats);
        PRT_ASSERT(floats, "256 MB are there");
        std::fill_n(floats.get(), kReadFloats, 1.0f);
        return floats;
    }();
    return buffer.get();
}

void sumReadBuffer() {
    benchmark::DoNotOptimize(HWY_DYNAMIC_DISPATCH(sumFloats)(readBuffer(), kReadFloats));
}

void timeReads(std::vector<double>& seconds) {
    constexpr int kRepetitions = 5;
    for (int i = 0; i < kRepetitions; ++i) {
        const double start = threadSeconds();
        sumReadBuffer();
        seconds.push_back(threadSeconds() - start);
    }
}

void readMemory(benchmark::State& state) {
    for (auto _ : state)
        sumReadBuffer();
    state.SetBytesProcessed(state.iterations() *
                            static_cast<std::int64_t>(kReadFloats * sizeof(float)));
}

CompressedTransfer makeTransfer(TransferEncoding encoding, int bandCount, int channelCount) {
    CompressedTransfer transfer;
    transfer.bandCount = bandCount;
    transfer.receiverCount = kReceiverCount;
    CompressedLayer layer;
    layer.channelCount = channelCount;
    layer.table.encoding = encoding;
    const std::size_t rowCount = coefficientsPerReceiver(bandCount, channelCount);
    if (encoding != TransferEncoding::float32) {
        layer.table.scale.assign(rowCount, 1.5f);
        layer.table.bias.assign(rowCount, -0.25f);
    }
    // A number of moderate size in every encoding.
    constexpr std::byte kPattern{0x3c};
    layer.table.numbers = CoefficientTable(kReceiverCount, rowCount, bytesPerCoefficient(encoding));
    const std::vector<std::byte> panel(layer.table.numbers.panel(0).size(), kPattern);
    for (std::size_t i = 0; i < layer.table.numbers.panelCount(); ++i)
        layer.table.numbers.writePanel(i, 0, panel);
    transfer.layers.push_back(std::move(layer));
    return transfer;
}

/// How clusters lie over receivers that are numbered row by row over a square.
enum class Labels {
    inPatches,  ///< each a square patch, as it is nearly on a surface
    random,     ///< the worst that there can be
};

std::uint32_t clusterOf(std::size_t receiver, std::size_t clusterCount, Labels labels) {
    constexpr std::size_t kSide = 1000;
    if (labels == Labels::random) {
        RandomStream random(1, receiver);
        return static_cast<std::uint32_t>(random.nextBits() % clusterCount);
    }
    const auto patches = static_cast<std::size_t>(std::sqrt(clusterCount));
    const std::size_t column = receiver % kSide * patches / kSide;
    const std::size_t row = receiver / kSide * patches / kSide;
    return static_cast<std::uint32_t>(row * patches + column);
}

template <class Integer>
CoefficientTable makeClusterTable(std::size_t clusterCount, std::size_t componentCount,
                                  Labels labels) {
    std::vector<Integer> rows(kReceiverCount * (1 + componentCount), Integer{0x3c});
    for (std::size_t i = 0; i < kReceiverCount; ++i)
        rows[i * (1 + componentCount)] = static_cast<Integer>(clusterOf(i, clusterCount, labels));
    return makeTable(1 + componentCount, rows);
}

/// With bases of floats.
CompressedTransfer makeClusteredTransfer(TransferEncoding encoding, int channelCount,
                                         std::size_t clusterCount, std::size_t componentCount,
                                         Labels labels) {
    CompressedTransfer transfer;
    transfer.bandCount = 5;
    transfer.receiverCount = kReceiverCount;
    CompressedLayer layer;
    layer.channelCount = channelCount;
    layer.table.encoding = encoding;
    layer.table.numbers =
        encoding == TransferEncoding::unorm8
            ? makeClusterTable<std::uint8_t>(clusterCount, componentCount, labels)
            : makeClusterTable<std::uint16_t>(clusterCount, componentCount, labels);
    layer.bases.emplace();
    layer.bases->componentCounts.assign(clusterCount, static_cast<std::uint32_t>(componentCount));
    const std::size_t dimension = coefficientsPerReceiver(transfer.bandCount, channelCount);
    layer.bases->vectors.numbers = makeTable(
        dimension, std::vector<float>(clusterCount * (1 + componentCount) * dimension, 0.5f));
    transfer.layers.push_back(std::move(layer));
    return transfer;
}

void timeRelighting(benchmark::State& state, const Relighter& relighter) {
    Lighting lighting(relighter.bandCount());
    std::fill(lighting.coefficients.begin(), lighting.coefficients.end(), Vec3d(1.0, 0.5, 0.25));
    std::vector<Vec3f> radiance(kReceiverCount);

    std::vector<double> readSeconds;
    std::vector<double> relightSeconds;
    timeReads(readSeconds);
    for (auto _ : state) {
        const double start = threadSeconds();
        relighter.relight(lighting, radiance);
        benchmark::ClobberMemory();
        relightSeconds.push_back(threadSeconds() - start);
    }
    timeReads(readSeconds);

    const std::size_t bytes = relighter.transferBytes() + kReceiverCount * sizeof(Vec3f);
    const double readRate = kReadFloats * sizeof(float) / median(readSeconds);
    const double relightRate = static_cast<double>(bytes) / median(relightSeconds);
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes));
    state.counters["median_ms"] = 1e3 * median(relightSeconds);
    state.counters["least_ms"] =
        1e3 * *std::min_element(relightSeconds.begin(), relightSeconds.end());
    state.counters["read_GB/s"] = 1e-9 * readRate;
    state.counters["of_read_bandwidth"] = relightRate / readRate;
    state.counters["bytes"] = static_cast<double>(bytes) / kReceiverCount;
    state.counters["receivers/s"] = kReceiverCount / median(relightSeconds);
}

void relight(benchmark::State& state, TransferEncoding encoding) {
    const auto bandCount = static_cast<int>(state.range(0));
    const auto channelCount = static_cast<int>(state.range(1));
    timeRelighting(state,
                   Relighter(makeTransfer(encoding, bandCount, channelCount), Transport::shadowed));
}

void relightClusters(benchmark::State& state, TransferEncoding encoding, Labels labels) {
    const auto channelCount = static_cast<int>(state.range(0));
    const auto clusterCount = static_cast<std::size_t>(state.range(1));
    const auto componentCount = static_cast<std::size_t>(state.range(2));
    timeRelighting(state, Relighter(makeClusteredTransfer(encoding, channelCount, clusterCount,
                                                          componentCount, labels),
                                    Transport::shadowed));
}

void chooseSizes(benchmark::internal::Benchmark* relighting) {
    relighting->ArgNames({"bands", "channels"})
        ->ArgsProduct({{3, 5, 10}, {1}})
        ->Args({5, 3})
        ->Unit(benchmark::kMillisecond);
}

/// Clustered principal components; then principal components alone, and vector quantisation.
void chooseClusters(benchmark::internal::Benchmark* relighting) {
    relighting->ArgNames({"channels", "clusters", "components"})
        ->ArgsProduct({{1, 3}, {256}, {8, 15}})
        ->Args({3, 1, 12})
        ->Args({3, 256, 0})
        ->Unit(benchmark::kMillisecond);
}

void chooseManyClusters(benchmark::internal::Benchmark* relighting) {
    relighting->ArgNames({"channels", "clusters", "components"})
        ->ArgsProduct({{1}, {256, 65536}, {8}})
        ->Unit(benchmark::kMillisecond);
}

BENCHMARK(readMemory)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(relight, float32, TransferEncoding::float32)->Apply(chooseSizes);
BENCHMARK_CAPTURE(relight, unorm16, TransferEncoding::unorm16)->Apply(chooseSizes);
BENCHMARK_CAPTURE(relight, unorm8, TransferEncoding::unorm8)->Apply(chooseSizes);
BENCHMARK_CAPTURE(relightClusters, unorm8_patches, TransferEncoding::unorm8, Labels::inPatches)
    ->Apply(chooseClusters);
BENCHMARK_CAPTURE(relightClusters, unorm16_patches, TransferEncoding::unorm16, Labels::inPatches)
    ->Apply(chooseClusters);
BENCHMARK_CAPTURE(relightClusters, unorm8_random, TransferEncoding::unorm8, Labels::random)
    ->Args({1, 256, 8})
    ->ArgNames({"channels", "clusters", "components"})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(relightClusters, unorm16_random, TransferEncoding::unorm16, Labels::random)
    ->Apply(chooseManyClusters);

}  // namespace
}  // namespace prt

BENCHMARK_MAIN();
#endif  // HWY_ONCE
