#include "prt/transport/bake_plan.h"

#include <algorithm>
#include <mutex>
#include <vector>

#include "prt/base/resident_memory.h"
#include "prt/basis/sh.h"
#include "prt/parallel/parallel_for.h"

namespace prt {
namespace {

constexpr std::size_t kReceiversPerPilot = 1000;
constexpr std::size_t kMaxPilotCount = 256;

/// What some receivers, evenly spread along the curve that orders them, have met.
struct Pilot {
    double entriesPerReceiver = 0.0;
    bool meetsBacks = false;
};

Pilot flyPilot(const GatherScene& scene, const BakeOptions& options, Isa isa) {
    const GatherOptions gatherOptions = gatherOptionsOf(options);
    const std::size_t receiverCount = scene.receivers.fronts.size();
    const std::size_t count = std::min(receiverCount / kReceiversPerPilot, kMaxPilotCount);
    Pilot pilot;
    if (count == 0 || !gatherOptions.keepHits) return pilot;

    const GatherKernels kernels = selectGatherKernels(isa);
    const SamplePattern pattern(gatherOptions.sampleCount);
    std::mutex adding;
    parallelFor(count, {options.threadCount, 1}, [&](std::size_t begin, std::size_t end) {
        Gatherer gatherer(scene, kernels, pattern, gatherOptions);
        std::vector<float> transfer(
            static_cast<std::size_t>(shCoefficientCount(options.bandCount)));
        HitSlab slab;
        for (std::size_t i = begin; i < end; ++i)
            gatherer.gather(static_cast<std::uint32_t>((2 * i + 1) * receiverCount / (2 * count)),
                            transfer, slab);
        const std::lock_guard lock(adding);
        pilot.entriesPerReceiver +=
            static_cast<double>(slab.entries.size()) / static_cast<double>(count);
        for (const BounceEntry& entry : slab.entries)
            pilot.meetsBacks |= entry.receiver >= receiverCount;
    });
    return pilot;
}

/// What the threads hold of the units they work at: rows grow by doubling, and are laid out as a
/// file, twice.
std::size_t bytesAtWork(const BakeOptions& options, std::size_t unitBytes) {
    constexpr std::size_t kCopiesInMemory = 2;
    constexpr std::size_t kCopiesWithFile = 4;
    return static_cast<std::size_t>(resolveThreadCount(options.threadCount)) * unitBytes *
           (options.checkpoint.folder.empty() ? kCopiesInMemory : kCopiesWithFile);
}

/// What the transfer of all receivers takes.
struct TransferBytes {
    std::size_t tables = 0;  ///< before and after the bounces, and of the bounce at work
    std::size_t layers = 0;  ///< those that stay
    std::size_t block = 0;   ///< some columns of it that a bounce gathers from
    std::size_t blockCount = 0;
    std::size_t panel = 0;  ///< four columns: what reading a table on disk brings into memory
    std::size_t units = 0;  ///< in the files of a checkpoint

    /// A bounce gathers from at least a block of columns, and adds a panel to another.
    std::size_t least() const { return block + 2 * panel; }
};

/// @param receivers  fronts, and backs if light comes from any
TransferBytes countTransferBytes(const BakeOptions& options, std::size_t fronts,
                                 std::size_t receivers) {
    const auto n = static_cast<std::size_t>(shCoefficientCount(options.bandCount));
    TransferBytes bytes;
    bytes.tables = countTableBytes(receivers, n);
    bytes.panel = countTableBytes(receivers, 1);
    bytes.units = bytes.tables;
    bytes.layers = countTableBytes(fronts, n);
    if (!hasBounces(options.transport)) return bytes;
    bytes.layers += countTableBytes(fronts, 3 * n);
    bytes.tables += countTableBytes(fronts, 3 * n) + countTableBytes(receivers, 3 * n);
    bytes.block = receivers * kLaneMultiple * sizeof(float);
    bytes.blockCount = padToLanes(3 * n) / kLaneMultiple;
    bytes.units += static_cast<std::size_t>(std::max(options.bounceCount, 0)) *
                   countTableBytes(receivers, 3 * n);
    return bytes;
}

/// What a bake may use if nobody says: enough to be fast where the scene is small, and no more than
/// twice what a large scene takes ready for rays. It does not depend on the number of bands.
std::size_t defaultMemoryBytes(const Scene& scene) {
    constexpr std::size_t kBase = std::size_t(512) << 20;
    constexpr std::size_t kPerTriangle = 200;
    constexpr std::size_t kPerVertex = 16;
    std::size_t bytes =
        kBase + kPerTriangle * scene.triangleCount() + kPerVertex * scene.vertexCount();
    for (const TextureImage& image : scene.images)
        bytes += image.encoded.size() + image.pixels.pixels.size() * sizeof(Rgba8);
    return bytes;
}

/// Divides the memory while vectors are made. Sets what they take.
///
/// @param allowedBytes  of the whole process
/// @param fixedBytes    what the bake holds whatever the plan
/// @param layerRoom     what layers may hold for as long as the bake lasts
MemoryPlan divideMemory(const BakeOptions& options, std::size_t allowedBytes,
                        std::size_t fixedBytes, std::size_t layerRoom,
                        const TransferBytes& transfer, std::size_t hitBytes, BytesTaken& taken) {
    MemoryPlan plan;
    std::size_t leftBytes = allowedBytes - fixedBytes - transfer.least();
    if (transfer.block > 0) {
        const std::size_t moreBlocks =
            std::min(transfer.blockCount - 1, leftBytes / 2 / transfer.block);
        plan.blocksAtOnce = 1 + moreBlocks;
        leftBytes -= moreBlocks * transfer.block;
    }
    plan.tables = {transfer.tables > leftBytes || transfer.layers > layerRoom,
                   options.scratchFolder};
    if (!plan.tables.onDisk) leftBytes -= transfer.tables;
    plan.hitBytes = leftBytes;

    const std::size_t hitsInMemory = std::min(hitBytes, leftBytes);
    const bool toFiles = !options.checkpoint.folder.empty();
    taken.memory = allowedBytes - leftBytes + hitsInMemory;
    taken.scratch =
        (plan.tables.onDisk ? transfer.tables : 0) + (toFiles ? 0 : hitBytes - hitsInMemory);
    taken.files = toFiles ? hitBytes + transfer.units : 0;
    return plan;
}

}  // namespace

GatherOptions gatherOptionsOf(const BakeOptions& options) {
    return {options.bandCount, padToLanes(static_cast<std::size_t>(options.sampleCount)),
            options.seed, hasBounces(options.transport)};
}

std::size_t receiversPerUnit(std::size_t receiverCount, std::size_t sampleCount, bool inFiles) {
    constexpr std::size_t kReceiversWithoutFile = 128;
    constexpr std::size_t kRaysPerUnit = std::size_t(1) << 19;
    // Unless each would lose much work with the process, there should be at most so many files.
    constexpr std::size_t kMaxRaysPerUnit = std::size_t(1) << 24;
    constexpr std::size_t kUnitCountAim = 8192;
    if (!inFiles) return kReceiversWithoutFile;
    const std::size_t rays =
        std::clamp(receiverCount * sampleCount / kUnitCountAim, kRaysPerUnit, kMaxRaysPerUnit);
    return std::max<std::size_t>(rays / sampleCount, 1);
}

std::size_t countDoubleSided(const GatherScene& scene) {
    std::vector<bool> doubleSided(scene.receivers.fronts.size());
    const std::vector<std::size_t> offsets = vertexOffsets(scene.scene);
    for (std::size_t mesh = 0; mesh < scene.scene.meshes.size(); ++mesh)
        if (scene.scene.materials[scene.scene.meshes[mesh].material].doubleSided)
            for (std::size_t vertex = offsets[mesh]; vertex < offsets[mesh + 1]; ++vertex)
                doubleSided[scene.receivers.frontOfVertex[vertex]] = true;
    return static_cast<std::size_t>(std::count(doubleSided.begin(), doubleSided.end(), true));
}

BakePlan planBake(const GatherScene& scene, const BakeOptions& options, Isa isa,
                  std::optional<UnitRange> units) {
    const Pilot pilot = flyPilot(scene, options, isa);
    const std::size_t fronts = scene.receivers.fronts.size();
    const std::size_t sampleCount = gatherOptionsOf(options).sampleCount;
    const auto rowBytes =
        static_cast<std::size_t>(pilot.entriesPerReceiver * double(sizeof(BounceEntry)));
    const bool toFiles = !options.checkpoint.folder.empty();
    const std::size_t unitSize = receiversPerUnit(fronts, sampleCount, toFiles);
    const std::size_t fixedBytes =
        residentBytes() + bytesAtWork(options, rowBytes * std::min(unitSize, fronts));

    BakePlan plan;
    BakeForecast& forecast = plan.forecast;
    forecast.receiverCount = fronts;
    forecast.unitCount = toFiles ? (fronts + unitSize - 1) / unitSize : 0;
    if (units) {
        const std::size_t begin = std::min(units->begin * unitSize, fronts);
        const std::size_t end = std::min(units->end, forecast.unitCount) * unitSize;
        const std::size_t gathered = std::clamp(end, begin, fronts) - begin;
        forecast.rayCount = gathered * sampleCount;
        forecast.memoryBytes = fixedBytes;
        forecast.diskBytes = gathered * rowBytes;
        return plan;
    }
    const std::size_t seenBacks = pilot.meetsBacks ? countDoubleSided(scene) : 0;
    // Tables of vectors have room for all backs as soon as there is one.
    const std::size_t receivers = pilot.meetsBacks ? 2 * fronts : fronts;
    const TransferBytes transfer = countTransferBytes(options, fronts, receivers);
    const MatrixBytes matrices = countMatrixBytes(options, fronts, seenBacks);
    const std::size_t allowedBytes =
        std::max({fixedBytes + transfer.least(), fixedBytes + matrices.least(),
                  options.memoryBytes > 0 ? options.memoryBytes : defaultMemoryBytes(scene.scene)});

    BytesTaken forVectors;
    plan.memory = divideMemory(options, allowedBytes, fixedBytes,
                               allowedBytes - fixedBytes - matrices.least(), transfer,
                               (fronts + seenBacks) * rowBytes, forVectors);
    const bool layersOnDisk = plan.memory.tables.onDisk;
    BytesTaken forMatrices;
    plan.matrices = divideMatrixMemory(
        options, matrices, allowedBytes - fixedBytes - (layersOnDisk ? 0 : transfer.layers),
        forMatrices);
    if (isGlossy(options.transport)) {
        forMatrices.memory += fixedBytes + (layersOnDisk ? 0 : transfer.layers);
        forMatrices.scratch += layersOnDisk ? transfer.layers : 0;
    }
    forecast.rayCount = (fronts + seenBacks) * sampleCount +
                        countMatrixRays(options, matrices, plan.matrices, sampleCount);
    forecast.memoryBytes = std::max(forVectors.memory, forMatrices.memory);
    forecast.diskBytes =
        std::max(forVectors.scratch, forMatrices.scratch) + forVectors.files + forMatrices.files;
    return plan;
}

}  // namespace prt
