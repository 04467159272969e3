#include "prt/transport/matrix_plan.h"

#include <algorithm>

#include "prt/basis/sh.h"
#include "prt/parallel/parallel_for.h"
#include "prt/transport/bake_plan.h"

namespace prt {
namespace {

std::size_t divideUp(std::size_t number, std::size_t divisor) {
    return (number + divisor - 1) / divisor;
}

/// Bounces to reckon with.
std::size_t foreseenBounces(const BakeOptions& options) {
    constexpr std::size_t kForEndless = 10;
    if (options.transport != Transport::glossy) return 0;
    return options.bounceCount == kInfiniteBounces ? kForEndless
                                                   : static_cast<std::size_t>(options.bounceCount);
}

}  // namespace

std::size_t countTableBytes(std::size_t rowCount, std::size_t columnCount) {
    return rowCount * CoefficientTable::countPanels(columnCount) * CoefficientTable::kPanelWidth *
           sizeof(float);
}

MatrixBytes countMatrixBytes(const BakeOptions& options, std::size_t fronts, std::size_t backs) {
    MatrixBytes bytes;
    if (!isGlossy(options.transport)) return bytes;
    const std::size_t bounceCount = foreseenBounces(options);
    bytes.fronts = fronts;
    bytes.backs = bounceCount > 0 ? backs : 0;
    bytes.columnCount = coefficientsPerReceiver(options.bandCount, 1);
    const std::size_t elementCount =
        coefficientsPerReceiver(options.bandCount, 1, options.incidentBandCount);

    // Rows are made, and with a checkpoint laid out as a file, twice.
    const bool toFiles = !options.checkpoint.folder.empty();
    const std::size_t copies = toFiles ? 4 : 2;
    const auto threadCount = static_cast<std::size_t>(resolveThreadCount(options.threadCount));
    const std::size_t unitSize = receiversPerUnit(
        fronts, padToLanes(static_cast<std::size_t>(options.sampleCount)), toFiles);
    bytes.tables = countTableBytes(fronts + bytes.backs, elementCount);
    bytes.units = bytes.tables;
    bytes.atWork = threadCount * copies * countTableBytes(std::min(unitSize, fronts), elementCount);
    if (options.transport == Transport::glossyShadowed) return bytes;

    // The system reads so much of a mapped file around each page that is touched.
    constexpr std::size_t kWindowBytes = std::size_t(64) << 10;
    bytes.atWork *= 3;
    bytes.tables += countTableBytes(fronts + (bounceCount > 1 ? bytes.backs : 0), 3 * elementCount);
    bytes.windows = std::min(
        bytes.tables, threadCount * kWindowBytes * CoefficientTable::countPanels(3 * elementCount));
    if (bounceCount == 0) return bytes;
    bytes.column = (fronts + bytes.backs) * 3 * elementCount / bytes.columnCount * sizeof(float);
    bytes.units +=
        countTableBytes(bounceCount * fronts + (bounceCount - 1) * bytes.backs, 3 * elementCount);
    return bytes;
}

MatrixPlan divideMatrixMemory(const BakeOptions& options, const MatrixBytes& bytes,
                              std::size_t roomBytes, BytesTaken& taken) {
    MatrixPlan plan;
    std::size_t leftBytes = roomBytes - bytes.least();
    if (bytes.column > 0) {
        // As many times as must be, and then no more at once than that takes.
        const std::size_t most = std::min(1 + leftBytes / bytes.column, bytes.columnCount);
        plan.columnsAtOnce = divideUp(bytes.columnCount, divideUp(bytes.columnCount, most));
        leftBytes -= (plan.columnsAtOnce - 1) * bytes.column;
    }
    plan.tables = {bytes.tables > leftBytes + bytes.windows, options.scratchFolder};
    taken.memory = roomBytes - leftBytes;
    if (plan.tables.onDisk)
        taken.scratch = bytes.tables;
    else
        taken.memory += bytes.tables - bytes.windows;
    taken.files = options.checkpoint.folder.empty() ? 0 : bytes.units;
    return plan;
}

std::uint64_t countMatrixRays(const BakeOptions& options, const MatrixBytes& bytes,
                              const MatrixPlan& plan, std::size_t sampleCount) {
    const std::size_t bounceCount = foreseenBounces(options);
    std::uint64_t receiverCount = bytes.fronts + bytes.backs;
    if (bounceCount > 0) {
        const std::size_t blockCount = divideUp(bytes.columnCount, plan.columnsAtOnce);
        receiverCount +=
            blockCount * (bounceCount * bytes.fronts + (bounceCount - 1) * bytes.backs);
    }
    return receiverCount * sampleCount;
}

}  // namespace prt
