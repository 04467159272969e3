#include "prt/transport/bounce.h"

#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <string>
#include <utility>

#include "prt/basis/sh.h"
#include "prt/parallel/parallel_for.h"
#include "prt/transport/bake.h"

namespace prt {
namespace {

constexpr int kBounceLimit = 10'000;
constexpr double kConvergedFraction = 1e-6;

/// Transfer of every receiver, as BounceTransfer.
struct PaddedTransfer {
    std::size_t coefficientCount;
    std::size_t receiverCount;
    hwy::AlignedFreeUniquePtr<float[]> values;

    PaddedTransfer(std::size_t coefficients, std::size_t receivers)
        : coefficientCount(coefficients),
          receiverCount(receivers),
          values(hwy::AllocateAligned<float>(view().receiverStride() * receivers)) {
        if (!values) throw std::bad_alloc();
        std::fill_n(values.get(), view().receiverStride() * receivers, 0.0f);
    }

    BounceTransfer view() const { return {values.get(), coefficientCount}; }
    float* of(std::size_t receiver) { return values.get() + view().receiverStride() * receiver; }
};

PaddedTransfer replicateChannels(std::span<const float> direct, std::size_t coefficientCount) {
    PaddedTransfer transfer(coefficientCount, direct.size() / coefficientCount);
    for (std::size_t receiver = 0; receiver < transfer.receiverCount; ++receiver)
        for (std::size_t channel = 0; channel < 3; ++channel)
            std::copy_n(direct.data() + receiver * coefficientCount, coefficientCount,
                        transfer.of(receiver) + channel * coefficientCount);
    return transfer;
}

void addToTotal(PaddedTransfer& transfer, std::span<float> total) {
    const std::size_t size = 3 * transfer.coefficientCount;
    for (std::size_t begin = 0; begin < total.size(); begin += size) {
        const float* source = transfer.of(begin / size);
        for (std::size_t i = 0; i < size; ++i)
            total[begin + i] += source[i];
    }
}

/// The largest mean transfer of any receiver: what is left to bounce.
double largestMean(PaddedTransfer& transfer) {
    float largest = 0.0f;
    for (std::size_t receiver = 0; receiver < transfer.receiverCount; ++receiver)
        for (std::size_t channel = 0; channel < 3; ++channel)
            largest = std::max(
                largest, std::abs(transfer.of(receiver)[channel * transfer.coefficientCount]));
    return static_cast<double>(largest);
}

}  // namespace

int addBounces(const HitMatrix& matrix, std::span<const float> direct, const GatherKernels& kernels,
               const BounceOptions& options, std::span<float> total) {
    if (direct.empty()) return 0;
    const auto coefficientCount = static_cast<std::size_t>(shCoefficientCount(options.bandCount));
    PaddedTransfer incoming = replicateChannels(direct, coefficientCount);
    PaddedTransfer outgoing(coefficientCount, incoming.receiverCount);
    std::fill(total.begin(), total.end(), 0.0f);
    addToTotal(incoming, total);

    const bool untilConverged = options.bounceCount == kInfiniteBounces;
    const int limit = untilConverged ? kBounceLimit : options.bounceCount;
    const double converged = largestMean(incoming) * kConvergedFraction;
    int bounce = 0;
    while (bounce < limit) {
        const std::string stage = "bounce " + std::to_string(bounce + 1);
        ProgressReporter reporter(options.progress, stage, "rows", matrix.rowCount());
        parallelFor(matrix.slabCount(), {options.threadCount, 1},
                    [&](std::size_t begin, std::size_t end) {
                        for (std::size_t slab = begin; slab < end; ++slab)
                            matrix.visitSlab(slab, [&](const HitSlab& rows) {
                                for (std::size_t i = 0; i < rows.receivers.size(); ++i)
                                    kernels.multiplyRow(rows.row(i), incoming.view(),
                                                        outgoing.of(rows.receivers[i]));
                                reporter.advance(rows.receivers.size());
                            });
                    });
        addToTotal(outgoing, total);
        std::swap(incoming, outgoing);
        ++bounce;
        if (untilConverged && largestMean(incoming) <= converged) break;
    }
    return bounce;
}

}  // namespace prt
