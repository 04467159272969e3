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
#include "prt/transport/runs.h"

namespace prt {
namespace {

constexpr int kBounceLimit = 10'000;
constexpr double kConvergedFraction = 1e-6;
// Rows of a bounce in one file: gigabytes of hits are read for some megabytes written.
constexpr std::size_t kRowsPerUnit = std::size_t(1) << 18;
// Rows that are copied between one table and another at a time.
constexpr std::size_t kRowsAtOnce = 4096;

constexpr std::size_t kWidth = CoefficientTable::kPanelWidth;
constexpr std::size_t kPanelsPerBlock = kLaneMultiple / kWidth;

/// Calls work(firstRow, rowCount) for all rows, a few thousand at a time.
template <class Work>
void forRows(std::size_t rowCount, int threadCount, Work work) {
    parallelFor((rowCount + kRowsAtOnce - 1) / kRowsAtOnce, {threadCount, 1},
                [&](std::size_t begin, std::size_t end) {
                    for (std::size_t i = begin; i < end; ++i) {
                        const std::size_t first = i * kRowsAtOnce;
                        work(first, std::min(kRowsAtOnce, rowCount - first));
                    }
                });
}

/// The transfer of one side of the surfaces, the same for red, green and blue.
void replicateChannels(const CoefficientTable& direct, std::size_t firstRow, int threadCount,
                       CoefficientTable& transfer) {
    const std::size_t n = direct.columnCount();
    forRows(direct.rowCount(), threadCount, [&](std::size_t first, std::size_t count) {
        std::vector<float> rows(count * 3 * n);
        for (std::size_t i = 0; i < count; ++i) {
            float* row = rows.data() + i * 3 * n;
            direct.readRow(first + i, std::span(row, n));
            std::copy_n(row, n, row + n);
            std::copy_n(row, n, row + 2 * n);
        }
        transfer.writeRows(firstRow + first, std::span<const float>(rows));
        direct.releaseMemory();
    });
}

/// Panels of a table, [begin, end).
struct PanelRange {
    std::size_t begin = 0;
    std::size_t end = 0;

    std::size_t columnCount() const { return (end - begin) * kWidth; }
};

std::vector<PanelRange> dividePanels(PanelRange panels, std::size_t panelsPerRange) {
    std::vector<PanelRange> ranges;
    for (std::size_t begin = panels.begin; begin < panels.end; begin += panelsPerRange)
        ranges.push_back({begin, std::min(panels.end, begin + panelsPerRange)});
    return ranges;
}

/// Adds one table to the first rows of another.
void addToTotal(const CoefficientTable& transfer, PanelRange panels, int threadCount,
                CoefficientTable& total) {
    forRows(total.rowCount(), threadCount, [&](std::size_t first, std::size_t count) {
        std::vector<float> rows(count * kWidth);
        for (std::size_t panel = panels.begin; panel < panels.end; ++panel) {
            const float* added = floatPanel(transfer, panel).data() + first * kWidth;
            const float* before = floatPanel(total, panel).data() + first * kWidth;
            for (std::size_t i = 0; i < rows.size(); ++i)
                rows[i] = before[i] + added[i];
            total.writePanel(panel, first, std::as_bytes(std::span(rows)));
        }
        transfer.releaseMemory();
        total.releaseMemory();
    });
}

/// The largest mean transfer of any receiver: what is left to bounce.
double largestMean(const CoefficientTable& transfer) {
    const std::size_t coefficientCount = transfer.columnCount() / 3;
    float largest = 0.0f;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const std::size_t column = channel * coefficientCount;
        const std::span<const float> panel = floatPanel(transfer, column / kWidth);
        for (std::size_t i = column % kWidth; i < panel.size(); i += kWidth)
            largest = std::max(largest, std::abs(panel[i]));
        transfer.releaseMemory();
    }
    return static_cast<double>(largest);
}

/// Some columns of the transfer of all receivers, side by side in memory: what is gathered from.
class IncomingTransfer {
  public:
    IncomingTransfer(const CoefficientTable& transfer, PanelRange panels, int threadCount)
        : columns_{nullptr, transfer.columnCount() / 3, panels.begin * kWidth,
                   padToLanes(panels.columnCount())},
          values_(hwy::AllocateAligned<float>(transfer.rowCount() * columns_.columnCount)) {
        if (!values_) throw std::bad_alloc();
        columns_.values = values_.get();
        const std::size_t stride = columns_.columnCount;
        forRows(transfer.rowCount(), threadCount, [&](std::size_t first, std::size_t count) {
            std::fill_n(values_.get() + first * stride, count * stride, 0.0f);
            for (std::size_t panel = panels.begin; panel < panels.end; ++panel) {
                const std::span<const float> source = floatPanel(transfer, panel);
                float* const target = values_.get() + (panel - panels.begin) * kWidth;
                for (std::size_t row = first; row < first + count; ++row)
                    std::copy_n(source.data() + row * kWidth, kWidth, target + row * stride);
            }
            transfer.releaseMemory();
        });
    }

    const BounceTransfer& columns() const { return columns_; }

  private:
    BounceTransfer columns_;
    hwy::AlignedFreeUniquePtr<float[]> values_;
};

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

/// One multiplication with the matrix, in place: it is made for some columns after the others, and
/// for each the incoming transfer is put aside.
class BouncePass {
  public:
    BouncePass(const HitMatrix& matrix, const GatherKernels& kernels, const BounceOptions& options,
               int bounce, CoefficientTable& transfer)
        : matrix_(matrix),
          kernels_(kernels),
          options_(options),
          unitStage_("bounce-" + std::to_string(bounce) + "-"),
          groups_(dividePanels({0, transfer.panelCount()}, panelsAtOnce(options, transfer))),
          stage_("bounce " + std::to_string(bounce)),
          reporter_(options.progress, stage_, "rows", matrix.rowCount() * groups_.size()),
          transfer_(transfer) {}

    /// @param total  what comes out is added to its rows
    void run(CoefficientTable& total) {
        for (const PanelRange& panels : groups_) {
            const IncomingTransfer incoming(transfer_, panels, options_.threadCount);
            if (options_.checkpoint)
                multiplyResumably(panels, incoming);
            else
                multiply({0, matrix_.slabCount(), matrix_.rowCount()}, panels, incoming);
            addToTotal(transfer_, panels, options_.threadCount, total);
        }
    }

  private:
    static std::size_t panelsAtOnce(const BounceOptions& options,
                                    const CoefficientTable& transfer) {
        const std::size_t blockCount = padToLanes(transfer.columnCount()) / kLaneMultiple;
        return std::min(options.blocksAtOnce, blockCount) * kPanelsPerBlock;
    }

    /// A unit is one block of columns of many rows, however many are made at once.
    void multiplyResumably(PanelRange panels, const IncomingTransfer& incoming) {
        std::uint64_t firstRow = 0;
        std::uint32_t index = 0;
        for (const SlabRange& slabs : divideSlabs(matrix_, kRowsPerUnit)) {
            const auto keyOf = [&](const PanelRange& block) {
                return UnitKey{unitStage_ + std::to_string(block.begin / kPanelsPerBlock), index,
                               firstRow, firstRow + slabs.rowCount};
            };
            const std::vector<PanelRange> blocks = dividePanels(panels, kPanelsPerBlock);
            if (std::all_of(blocks.begin(), blocks.end(), [&](const PanelRange& block) {
                    return load(keyOf(block), slabs, block);
                })) {
                reporter_.advance(slabs.rowCount);
            } else {
                multiply(slabs, panels, incoming);
                for (const PanelRange& block : blocks)
                    store(keyOf(block), slabs, block);
            }
            firstRow += slabs.rowCount;
            ++index;
        }
    }

    void multiply(const SlabRange& slabs, PanelRange panels, const IncomingTransfer& incoming) {
        parallelFor(slabs.end - slabs.begin, {options_.threadCount, 1},
                    [&](std::size_t begin, std::size_t end) {
                        for (std::size_t i = begin; i < end; ++i)
                            multiplySlab(slabs.begin + i, panels, incoming.columns());
                    });
    }

    void multiplySlab(std::size_t slab, PanelRange panels, const BounceTransfer& incoming) {
        matrix_.visitSlab(slab, [&](const HitSlab& rows) {
            const std::size_t stride = incoming.columnCount;
            const auto outgoing = hwy::AllocateAligned<float>(rows.receivers.size() * stride);
            if (!outgoing) throw std::bad_alloc();
            for (std::size_t i = 0; i < rows.receivers.size(); ++i)
                kernels_.multiplyRow(rows.row(i), incoming, outgoing.get() + i * stride);
            writeRows(rows.receivers, panels, outgoing.get(), stride);
            reporter_.advance(rows.receivers.size());
        });
    }

    /// Writes columns of some receivers, those with consecutive numbers at once.
    void writeRows(std::span<const std::uint32_t> receivers, PanelRange panels, const float* rows,
                   std::size_t stride) {
        std::vector<float> part(receivers.size() * kWidth);
        for (std::size_t panel = panels.begin; panel < panels.end; ++panel, rows += kWidth) {
            for (std::size_t i = 0; i < receivers.size(); ++i)
                std::copy_n(rows + i * stride, kWidth, part.data() + i * kWidth);
            forRuns(receivers, [&](std::size_t first, std::size_t count) {
                transfer_.writePanel(
                    panel, receivers[first],
                    std::as_bytes(std::span(part).subspan(first * kWidth, count * kWidth)));
            });
        }
    }

    bool load(const UnitKey& key, const SlabRange& slabs, PanelRange block) {
        const std::size_t stride = block.columnCount();
        std::vector<float> values;
        const bool found = options_.checkpoint->load(key, [&](std::span<const std::byte> payload) {
            ByteReader reader(payload);
            values = reader.readVector<float>(slabs.rowCount * stride);
            reader.requireEnd();
        });
        if (!found) return false;
        const float* rows = values.data();
        for (std::size_t slab = slabs.begin; slab < slabs.end; ++slab) {
            const std::span<const std::uint32_t> receivers = matrix_.slabReceivers(slab);
            writeRows(receivers, block, rows, stride);
            rows += receivers.size() * stride;
        }
        return true;
    }

    void store(const UnitKey& key, const SlabRange& slabs, PanelRange block) {
        ByteWriter writer(slabs.rowCount * block.columnCount() * sizeof(float));
        for (std::size_t slab = slabs.begin; slab < slabs.end; ++slab)
            for (const std::uint32_t receiver : matrix_.slabReceivers(slab))
                for (std::size_t panel = block.begin; panel < block.end; ++panel)
                    writer.write(floatPanel(transfer_, panel).subspan(receiver * kWidth, kWidth));
        transfer_.releaseMemory();
        options_.checkpoint->store(key, writer.bytes());
    }

    const HitMatrix& matrix_;
    const GatherKernels& kernels_;
    const BounceOptions& options_;
    std::string unitStage_;
    std::vector<PanelRange> groups_;
    std::string stage_;
    ProgressReporter reporter_;
    CoefficientTable& transfer_;
};

}  // namespace

int addBounces(const HitMatrix& matrix, const DirectTransfer& direct, const GatherKernels& kernels,
               const BounceOptions& options, CoefficientTable& total) {
    if (direct.receiverCount() == 0) return 0;
    CoefficientTable transfer(direct.receiverCount(), total.columnCount(), sizeof(float),
                              total.storage());
    replicateChannels(direct.fronts, 0, options.threadCount, transfer);
    if (direct.isFromBacks)
        replicateChannels(direct.backs, direct.fronts.rowCount(), options.threadCount, transfer);
    addToTotal(transfer, {0, transfer.panelCount()}, options.threadCount, total);

    const bool untilConverged = options.bounceCount == kInfiniteBounces;
    const int limit = untilConverged ? kBounceLimit : options.bounceCount;
    const double converged = largestMean(transfer) * kConvergedFraction;
    int bounce = 0;
    while (bounce < limit) {
        BouncePass(matrix, kernels, options, bounce + 1, transfer).run(total);
        ++bounce;
        if (untilConverged && largestMean(transfer) <= converged) break;
    }
    return bounce;
}

}  // namespace prt
