#include "prt/transport/bounce.h"

#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "prt/base/byte_stream.h"
#include "prt/basis/sh.h"
#include "prt/parallel/parallel_for.h"
#include "prt/transport/bake.h"

namespace prt {
namespace {

constexpr int kBounceLimit = 10'000;
constexpr double kConvergedFraction = 1e-6;
// Rows of a bounce in one file: gigabytes of hits are read for some megabytes written.
constexpr std::size_t kRowsPerUnit = 65536;

/// Transfer of every receiver, as BounceTransfer.
struct PaddedTransfer {
    std::size_t coefficientCount;
    std::size_t receiverCount;
    hwy::AlignedFreeUniquePtr<float[]> values;

    PaddedTransfer(std::size_t coefficients, std::size_t receivers)
        : coefficientCount(coefficients),
          receiverCount(receivers),
          values(hwy::AllocateAligned<float>(stride() * receivers)) {
        if (!values) throw std::bad_alloc();
        std::fill_n(values.get(), stride() * receivers, 0.0f);
    }

    BounceTransfer view() const { return {values.get(), coefficientCount}; }
    float* of(std::size_t receiver) { return values.get() + stride() * receiver; }

  private:
    std::size_t stride() const {
        return BounceTransfer{nullptr, coefficientCount}.receiverStride();
    }
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

/// Consecutive slabs, and the rows in them.
struct SlabRange {
    std::size_t begin = 0;
    std::size_t end = 0;
    std::size_t rowCount = 0;
};

std::vector<SlabRange> divideSlabs(const HitMatrix& matrix, std::size_t rowsPerRange) {
    std::vector<SlabRange> ranges;
    for (std::size_t slab = 0; slab < matrix.slabCount(); ++slab) {
        if (ranges.empty() || ranges.back().rowCount >= rowsPerRange)
            ranges.push_back({slab, slab, 0});
        ranges.back().end = slab + 1;
        ranges.back().rowCount += matrix.slabReceivers(slab).size();
    }
    return ranges;
}

/// One multiplication with the matrix.
class BouncePass {
  public:
    BouncePass(const HitMatrix& matrix, const GatherKernels& kernels, const BounceOptions& options,
               int bounce)
        : matrix_(matrix),
          kernels_(kernels),
          options_(options),
          stage_("bounce " + std::to_string(bounce)),
          unitStage_("bounce-" + std::to_string(bounce)),
          reporter_(options.progress, stage_, "rows", matrix.rowCount()) {}

    void run(const PaddedTransfer& incoming, PaddedTransfer& outgoing) {
        if (!options_.checkpoint)
            return multiply({0, matrix_.slabCount(), matrix_.rowCount()}, incoming, outgoing);
        UnitKey key{unitStage_};
        for (const SlabRange& slabs : divideSlabs(matrix_, kRowsPerUnit)) {
            key.end = key.begin + slabs.rowCount;
            if (!load(key, slabs, outgoing)) {
                multiply(slabs, incoming, outgoing);
                store(key, slabs, outgoing);
            }
            key.begin = key.end;
            ++key.index;
        }
    }

  private:
    void multiply(const SlabRange& slabs, const PaddedTransfer& incoming,
                  PaddedTransfer& outgoing) {
        parallelFor(slabs.end - slabs.begin, {options_.threadCount, 1},
                    [&](std::size_t begin, std::size_t end) {
                        for (std::size_t i = begin; i < end; ++i)
                            multiplySlab(slabs.begin + i, incoming, outgoing);
                    });
    }

    void multiplySlab(std::size_t slab, const PaddedTransfer& incoming, PaddedTransfer& outgoing) {
        matrix_.visitSlab(slab, [&](const HitSlab& rows) {
            for (std::size_t i = 0; i < rows.receivers.size(); ++i)
                kernels_.multiplyRow(rows.row(i), incoming.view(), outgoing.of(rows.receivers[i]));
            reporter_.advance(rows.receivers.size());
        });
    }

    bool load(const UnitKey& key, const SlabRange& slabs, PaddedTransfer& outgoing) {
        const std::size_t size = 3 * outgoing.coefficientCount;
        std::vector<float> values;
        const bool found = options_.checkpoint->load(key, [&](std::span<const std::byte> payload) {
            ByteReader reader(payload);
            values = reader.readVector<float>(slabs.rowCount * size);
            reader.requireEnd();
        });
        if (!found) return false;
        const float* row = values.data();
        for (std::size_t slab = slabs.begin; slab < slabs.end; ++slab)
            for (const std::uint32_t receiver : matrix_.slabReceivers(slab)) {
                std::copy_n(row, size, outgoing.of(receiver));
                row += size;
            }
        reporter_.advance(slabs.rowCount);
        return true;
    }

    void store(const UnitKey& key, const SlabRange& slabs, PaddedTransfer& outgoing) {
        ByteWriter writer(slabs.rowCount * 3 * outgoing.coefficientCount * sizeof(float));
        for (std::size_t slab = slabs.begin; slab < slabs.end; ++slab)
            for (const std::uint32_t receiver : matrix_.slabReceivers(slab))
                writer.write(
                    std::span<const float>(outgoing.of(receiver), 3 * outgoing.coefficientCount));
        options_.checkpoint->store(key, writer.bytes());
    }

    const HitMatrix& matrix_;
    const GatherKernels& kernels_;
    const BounceOptions& options_;
    std::string stage_;
    std::string unitStage_;
    ProgressReporter reporter_;
};

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
        BouncePass(matrix, kernels, options, bounce + 1).run(incoming, outgoing);
        addToTotal(outgoing, total);
        std::swap(incoming, outgoing);
        ++bounce;
        if (untilConverged && largestMean(incoming) <= converged) break;
    }
    return bounce;
}

}  // namespace prt
