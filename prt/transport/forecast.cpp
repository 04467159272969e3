#include "prt/transport/forecast.h"

#include <algorithm>
#include <mutex>
#include <vector>

#include "prt/basis/sh.h"
#include "prt/parallel/parallel_for.h"
#include "prt/transport/gather_pass.h"

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

/// Receivers that have another side: if any back is met, all may be.
std::size_t countDoubleSided(const GatherScene& scene) {
    std::vector<bool> doubleSided(scene.receivers.fronts.size());
    const std::vector<std::size_t> offsets = vertexOffsets(scene.scene);
    for (std::size_t mesh = 0; mesh < scene.scene.meshes.size(); ++mesh)
        if (scene.scene.materials[scene.scene.meshes[mesh].material].doubleSided)
            for (std::size_t vertex = offsets[mesh]; vertex < offsets[mesh + 1]; ++vertex)
                doubleSided[scene.receivers.frontOfVertex[vertex]] = true;
    return static_cast<std::size_t>(std::count(doubleSided.begin(), doubleSided.end(), true));
}

/// What the threads hold of the units they work at: rows grow by doubling, and are laid out as a
/// file, twice.
std::size_t bytesAtWork(const BakeOptions& options, std::size_t unitBytes) {
    constexpr std::size_t kCopiesInMemory = 2;
    constexpr std::size_t kCopiesWithFile = 4;
    return static_cast<std::size_t>(resolveThreadCount(options.threadCount)) * unitBytes *
           (options.checkpoint.folder.empty() ? kCopiesInMemory : kCopiesWithFile);
}

/// Transfer of all receivers, before and after the bounces, and of two bounces that follow each
/// other.
std::size_t transferBytes(const BakeOptions& options, std::size_t fronts, std::size_t receivers) {
    const auto coefficientCount = static_cast<std::size_t>(shCoefficientCount(options.bandCount));
    const std::size_t vectorBytes = coefficientCount * sizeof(float);
    const std::size_t direct = (receivers + fronts) * vectorBytes;
    if (options.transport != Transport::interreflected) return direct;
    const std::size_t stride = BounceTransfer{nullptr, coefficientCount}.receiverStride();
    return direct + fronts * 3 * vectorBytes + 2 * receivers * stride * sizeof(float);
}

}  // namespace

BakeForecast forecastBake(const GatherScene& scene, const BakeOptions& options, Isa isa,
                          std::optional<UnitRange> units) {
    const Pilot pilot = flyPilot(scene, options, isa);
    const std::size_t fronts = scene.receivers.fronts.size();
    const std::size_t sampleCount = gatherOptionsOf(options).sampleCount;
    const auto rowBytes =
        static_cast<std::size_t>(pilot.entriesPerReceiver * double(sizeof(BounceEntry)));
    const bool toFiles = !options.checkpoint.folder.empty();
    const std::size_t unitSize =
        toFiles ? receiversPerUnit(fronts, sampleCount) : kReceiversPerSlab;

    BakeForecast forecast;
    forecast.receiverCount = fronts;
    forecast.unitCount = toFiles ? (fronts + unitSize - 1) / unitSize : 0;
    forecast.memoryBytes = bytesAtWork(options, rowBytes * std::min(unitSize, fronts));
    if (units) {
        const std::size_t begin = std::min(units->begin * unitSize, fronts);
        const std::size_t end = std::min(units->end, forecast.unitCount) * unitSize;
        const std::size_t gathered = std::clamp(end, begin, fronts) - begin;
        forecast.rayCount = gathered * sampleCount;
        forecast.diskBytes = gathered * rowBytes;
        return forecast;
    }
    const std::size_t gathered = fronts + (pilot.meetsBacks ? countDoubleSided(scene) : 0);
    // Arrays have room for all backs as soon as there is one.
    const std::size_t receivers = pilot.meetsBacks ? 2 * fronts : fronts;
    const std::size_t hitBytes = gathered * rowBytes;
    const std::size_t hitsInMemory = std::min(hitBytes, options.memoryBytes);
    forecast.rayCount = gathered * sampleCount;
    forecast.memoryBytes += transferBytes(options, fronts, receivers) + hitsInMemory;
    forecast.diskBytes = toFiles ? hitBytes : hitBytes - hitsInMemory;
    return forecast;
}

}  // namespace prt
