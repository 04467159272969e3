#include "prt/transport/bake.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <numeric>
#include <string>
#include <utility>

#include "prt/base/error.h"
#include "prt/basis/sh.h"
#include "prt/parallel/parallel_for.h"
#include "prt/transport/bounce.h"
#include "prt/transport/gather.h"
#include "prt/transport/unshadowed.h"

namespace prt {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kMinSampleCount = 16;
constexpr int kMaxSampleCount = 65536;
// A slab of the bounce matrix, and the work one thread takes at a time.
constexpr std::size_t kReceiversPerSlab = 128;

double secondsSince(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

void requireInRange(int value, int low, int high, const std::string& name) {
    if (value >= low && value <= high) return;
    throw Error(ErrorCode::invalidOption, name + " must lie between " + std::to_string(low) +
                                              " and " + std::to_string(high) + ", not " +
                                              std::to_string(value));
}

void checkOptions(const BakeOptions& options) {
    requireInRange(options.bandCount, 1, kMaxBandCount, "the number of bands");
    requireInRange(options.sampleCount, kMinSampleCount, kMaxSampleCount, "the number of samples");
    if (options.bounceCount < 0 && options.bounceCount != kInfiniteBounces)
        throw Error(ErrorCode::invalidOption, "the number of bounces must not be negative");
    if (options.isa && *options.isa > detectIsa())
        throw Error(ErrorCode::invalidOption, "this machine does not have the instruction set " +
                                                  std::string(isaName(*options.isa)));
}

/// Shadowed transfer of every receiver that is needed, and the hits of their rays.
struct GatheredLight {
    std::size_t receiverCount = 0;      // fronts, and backs if light comes from any
    std::vector<float> directTransfer;  // [receiver][coefficient]
    HitMatrix hits;
    GatherCounts counts;
};

/// Gathers at all fronts, and then at those backs of double-sided surfaces that rays have met, and
/// at those that these meet in turn.
class GatherPass {
  public:
    GatherPass(const GatherScene& scene, const BakeOptions& options, Isa isa, GatheredLight& light)
        : scene_(scene),
          options_(options),
          kernels_(selectGatherKernels(isa)),
          pattern_(padToLanes(static_cast<std::size_t>(options.sampleCount))),
          light_(light),
          backNeeded_(scene.receivers.backs.size()) {}

    void run() {
        std::vector<std::uint32_t> wave(scene_.receivers.fronts.size());
        std::iota(wave.begin(), wave.end(), 0u);
        light_.receiverCount = wave.size();
        for (; !wave.empty(); wave = takeNeededBacks())
            gatherWave(wave);
    }

  private:
    std::size_t coefficientCount() const {
        return static_cast<std::size_t>(shCoefficientCount(options_.bandCount));
    }

    void gatherWave(const std::vector<std::uint32_t>& receivers) {
        const bool keepHits = options_.transport == Transport::interreflected;
        const GatherOptions gatherOptions{options_.bandCount, pattern_.reversedX.size(),
                                          options_.seed, keepHits};
        if (receivers.front() >= light_.receiverCount) light_.receiverCount *= 2;
        light_.directTransfer.resize(light_.receiverCount * coefficientCount());

        ProgressReporter reporter(options_.progress, "trace", "rays",
                                  receivers.size() * gatherOptions.sampleCount);
        parallelFor(receivers.size(), {options_.threadCount, kReceiversPerSlab},
                    [&](std::size_t begin, std::size_t end) {
                        Gatherer gatherer(scene_, kernels_, pattern_, gatherOptions);
                        HitSlab slab;
                        for (std::size_t i = begin; i < end; ++i) {
                            gatherer.gather(receivers[i], transferOf(receivers[i]), slab);
                            reporter.advance(gatherOptions.sampleCount);
                        }
                        finishSlab(gatherer.counts(), std::move(slab));
                    });
    }

    std::span<float> transferOf(std::uint32_t receiver) {
        return std::span(light_.directTransfer)
            .subspan(receiver * coefficientCount(), coefficientCount());
    }

    void finishSlab(const GatherCounts& counts, HitSlab slab) {
        const std::size_t frontCount = scene_.receivers.fronts.size();
        const std::lock_guard lock(finishing_);
        light_.counts += counts;
        if (slab.receivers.empty()) return;
        for (const std::uint32_t receiver : slab.receivers)
            if (receiver >= frontCount) backNeeded_[receiver - frontCount] = BackState::gathered;
        for (const BounceEntry& entry : slab.entries)
            if (entry.receiver >= frontCount &&
                backNeeded_[entry.receiver - frontCount] == BackState::unseen)
                backNeeded_[entry.receiver - frontCount] = BackState::needed;
        light_.hits.addSlab(std::move(slab));
    }

    std::vector<std::uint32_t> takeNeededBacks() const {
        std::vector<std::uint32_t> wave;
        for (std::uint32_t i = 0; i < backNeeded_.size(); ++i)
            if (backNeeded_[i] == BackState::needed)
                wave.push_back(backReceiver(scene_.receivers, i));
        return wave;
    }

    enum class BackState : std::uint8_t { unseen, needed, gathered };

    const GatherScene& scene_;
    const BakeOptions& options_;
    GatherKernels kernels_;
    SamplePattern pattern_;
    GatheredLight& light_;
    std::mutex finishing_;
    std::vector<BackState> backNeeded_;
};

}  // namespace

TransferField bakeTransfer(const Scene& scene, const BakeOptions& options, BakeStats* stats) {
    checkOptions(options);
    BakeStats ownStats;
    BakeStats& report = stats ? *stats : ownStats;
    report = {};
    report.isa = options.isa.value_or(detectIsa());
    if (options.transport == Transport::unshadowed) {
        report.receiverCount = scene.vertexCount();
        return makeUnshadowedTransfer(scene, options.bandCount);
    }

    // Place the receivers in the scene.
    const Clock::time_point buildBegin = Clock::now();
    const RayScene rays(scene, {options.isa, options.threadCount});
    const Receivers receivers = placeReceivers(scene, rays);
    report.buildSeconds = secondsSince(buildBegin);

    // Trace every ray, once.
    GatheredLight light{0, {}, HitMatrix(options.memoryBytes, options.scratchFolder), {}};
    GatherPass({scene, rays, receivers}, options, report.isa, light).run();
    const int threadCount = resolveThreadCount(options.threadCount);
    report.traceSeconds = light.counts.traceSeconds / threadCount;
    report.accumulateSeconds = light.counts.accumulateSeconds / threadCount;
    report.rayCount = light.counts.rayCount;
    report.hitCount = light.counts.hitCount;
    report.invalidRayCount = light.counts.invalidRayCount;
    report.receiverCount = receivers.fronts.size();
    report.hitBytes = light.hits.entryBytes();

    TransferField field{options.bandCount, receivers.fronts.size(), receivers.frontOfVertex, {}};
    const auto coefficientCount = static_cast<std::size_t>(shCoefficientCount(options.bandCount));
    const std::size_t frontSize = field.receiverCount * coefficientCount;
    field.layers.push_back(
        {Transport::shadowed,
         1,
         {light.directTransfer.begin(),
          light.directTransfer.begin() + static_cast<std::ptrdiff_t>(frontSize)}});

    // Let the light bounce.
    if (options.transport == Transport::interreflected) {
        const Clock::time_point bounceBegin = Clock::now();
        TransferLayer layer{Transport::interreflected, 3, std::vector<float>(3 * frontSize)};
        report.bounceCount = addBounces(
            light.hits, light.directTransfer, selectGatherKernels(report.isa),
            {options.bandCount, options.bounceCount, options.threadCount, options.progress},
            layer.coefficients);
        field.layers.push_back(std::move(layer));
        report.bounceSeconds = secondsSince(bounceBegin);
    }
    return field;
}

}  // namespace prt
