#include "benchmarks/yardsticks.h"

#include <benchmark/benchmark.h>
#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <ctime>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "benchmarks/yardsticks.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace prt::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Vector = hn::Vec<Floats>;

constexpr int kChainCount = 8;  // two multiply-adds a cycle, each of four cycles

float multiplyAdd(int stepCount, float factor) {
    const Floats d;
    const Vector a = hn::Set(d, factor), b = hn::Set(d, 1.0f - factor);
    Vector chains[kChainCount];
    for (int i = 0; i < kChainCount; ++i)
        chains[i] = hn::Set(d, 1.0f + static_cast<float>(i));
    for (int step = 0; step < stepCount; ++step) {
        for (Vector& chain : chains)
            chain = hn::MulAdd(chain, a, b);
    }
    for (int i = 1; i < kChainCount; ++i)
        chains[0] = hn::Add(chains[0], chains[i]);
    return hn::GetLane(hn::SumOfLanes(d, chains[0]));
}

/// @param count  a multiple of 64
float readBlock(const float* block, std::size_t count) {
    const Floats d;
    Vector sums[4] = {hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    for (std::size_t i = 0; i < count; i += 4 * hn::Lanes(d)) {
        for (std::size_t j = 0; j < 4; ++j)
            sums[j] = hn::Add(sums[j], hn::Load(d, block + i + j * hn::Lanes(d)));
    }
    return hn::GetLane(
        hn::SumOfLanes(d, hn::Add(hn::Add(sums[0], sums[1]), hn::Add(sums[2], sums[3]))));
}

/// @param count  a multiple of 16
float storeBlock(float* block, std::size_t count, float value) {
    const Floats d;
    const Vector values = hn::Set(d, value);
    for (std::size_t i = 0; i < count; i += hn::Lanes(d))
        hn::Store(values, d, block + i);
    return value;
}

}  // namespace
}  // namespace prt::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace prt {

HWY_EXPORT(multiplyAdd);
HWY_EXPORT(readBlock);
HWY_EXPORT(storeBlock);

namespace {

/// The least time of a call.
template <class Work>
double measureSeconds(int callCount, const Work& work) {
    constexpr int kRunCount = 20;
    double least = std::numeric_limits<double>::infinity();
    for (int run = 0; run < kRunCount; ++run) {
        const double start = readCpuSeconds();
        for (int call = 0; call < callCount; ++call)
            benchmark::DoNotOptimize(work());
        least = std::min(least, (readCpuSeconds() - start) / callCount);
    }
    return least;
}

/// Calls that move some megabytes.
int countCalls(std::size_t bytes) {
    constexpr std::size_t kMovedBytes = 1 << 24;
    return static_cast<int>(std::max<std::size_t>(1, kMovedBytes / bytes));
}

}  // namespace

double readCpuSeconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double measureMultiplyAddSeconds() {
    constexpr int kStepCount = 10000, kChains = 8;
    return measureSeconds(10, [] { return HWY_DYNAMIC_DISPATCH(multiplyAdd)(kStepCount, 0.5f); }) /
           (kStepCount * kChains);
}

double measureReadSeconds(std::size_t bytes) {
    const std::size_t count = (bytes / sizeof(float) + 63) / 64 * 64;
    const auto block = hwy::AllocateAligned<float>(count);
    std::fill_n(block.get(), count, 1.0f);
    return measureSeconds(countCalls(bytes),
                          [&] { return HWY_DYNAMIC_DISPATCH(readBlock)(block.get(), count); });
}

double measureStoreSeconds(std::size_t bytes) {
    const std::size_t count = (bytes / sizeof(float) + 15) / 16 * 16;
    const auto block = hwy::AllocateAligned<float>(count);
    return measureSeconds(countCalls(bytes), [&] {
        return HWY_DYNAMIC_DISPATCH(storeBlock)(block.get(), count, 1.0f);
    });
}

}  // namespace prt
#endif  // HWY_ONCE
