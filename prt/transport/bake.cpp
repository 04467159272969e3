#include "prt/transport/bake.h"

#include <chrono>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include "prt/base/error.h"
#include "prt/basis/sh.h"
#include "prt/parallel/parallel_for.h"
#include "prt/transport/bake_plan.h"
#include "prt/transport/bake_settings.h"
#include "prt/transport/bounce.h"
#include "prt/transport/gather_pass.h"
#include "prt/transport/unshadowed.h"

namespace prt {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

void checkOptions(const BakeOptions& options) {
    checkGatherRanges(options.bandCount, options.sampleCount);
    if (options.bounceCount < 0 && options.bounceCount != kInfiniteBounces)
        throw Error(ErrorCode::invalidOption, "the number of bounces must not be negative");
    if (options.isa && *options.isa > detectIsa())
        throw Error(ErrorCode::invalidOption, "this machine does not have the instruction set " +
                                                  std::string(isaName(*options.isa)));
}

std::unique_ptr<Checkpoint> openCheckpoint(const Scene& scene, const BakeOptions& options,
                                           Isa isa) {
    if (options.checkpoint.folder.empty()) return nullptr;
    return std::make_unique<Checkpoint>(options.checkpoint.folder, options.checkpoint.otherFolders,
                                        bakeSettings(scene, options, isa));
}

/// All that stands ready before the first ray.
struct ReadyBake {
    ReadyBake(const Scene& source, const BakeOptions& options)
        : isa(options.isa.value_or(detectIsa())),
          checkpoint(openCheckpoint(source, options, isa)),
          rays(source, {options.isa, options.threadCount}),
          receivers(placeReceivers(source, rays)),
          scene{source, rays, receivers},
          gather(scene, options, isa, checkpoint.get()) {}

    Isa isa;
    std::unique_ptr<Checkpoint> checkpoint;  // before the rest, for it may refuse
    RayScene rays;
    Receivers receivers;
    GatherScene scene;
    GatherPass gather;
};

MemoryPlan announcePlan(const ReadyBake& ready, const BakeOptions& options,
                        std::optional<UnitRange> units = {}) {
    const BakePlan plan = planBake(ready.scene, options, ready.isa, units);
    if (options.announce) options.announce(plan.forecast);
    return plan.memory;
}

void reportGather(const GatheredLight& light, const BakeOptions& options, BakeStats& report) {
    const int threadCount = resolveThreadCount(options.threadCount);
    report.traceSeconds = light.counts.traceSeconds / threadCount;
    report.accumulateSeconds = light.counts.accumulateSeconds / threadCount;
    report.rayCount = light.counts.rayCount;
    report.hitCount = light.counts.hitCount;
    report.invalidRayCount = light.counts.invalidRayCount;
    report.hitBytes = light.hits.entryBytes();
}

TransferField bakeRays(const Scene& scene, const BakeOptions& options, BakeStats& report) {
    const Clock::time_point buildBegin = Clock::now();
    ReadyBake ready(scene, options);
    report.buildSeconds = secondsSince(buildBegin);
    const MemoryPlan memory = announcePlan(ready, options);

    // Trace every ray, once.
    GatheredLight light(ready.scene, options.bandCount, memory);
    ready.gather.gatherAll(light);
    reportGather(light, options, report);
    report.resumedUnitCount = ready.gather.resumedUnitCount();
    report.receiverCount = ready.receivers.fronts.size();

    TransferField field{options.bandCount, report.receiverCount, ready.receivers.frontOfVertex, {}};
    // Let the light bounce.
    if (options.transport == Transport::interreflected) {
        const Clock::time_point bounceBegin = Clock::now();
        CoefficientTable total(field.receiverCount, coefficientsPerReceiver(options.bandCount, 3),
                               sizeof(float), memory.tables);
        report.bounceCount =
            addBounces(light.hits, light.direct, selectGatherKernels(report.isa),
                       {options.bounceCount, options.threadCount, memory.blocksAtOnce,
                        options.progress, ready.checkpoint.get()},
                       total);
        field.layers.push_back({Transport::interreflected, 3, std::move(total)});
        report.bounceSeconds = secondsSince(bounceBegin);
    }
    field.layers.insert(field.layers.begin(),
                        {Transport::shadowed, 1, std::move(light.direct.fronts)});
    if (ready.checkpoint) report.warnings = ready.checkpoint->warnings();
    return field;
}

/// Calls `work`, which may need more memory than there is.
template <class Work>
auto withinMemory(Work work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::outOfMemory, "the bake needs more memory than there is", {},
                    "allow it less, so that more goes to disk, or use a smaller scene");
    }
}

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
    return withinMemory([&] { return bakeRays(scene, options, report); });
}

UnitReport bakeUnits(const Scene& scene, const BakeOptions& options, UnitRange units) {
    checkOptions(options);
    if (options.checkpoint.folder.empty() || options.transport == Transport::unshadowed)
        throw Error(ErrorCode::invalidOption, "units are rays, kept in the folder of a checkpoint");
    return withinMemory([&] {
        ReadyBake ready(scene, options);
        announcePlan(ready, options, units);
        ready.gather.makeFrontUnits(units);
        return UnitReport{ready.gather.frontUnitCount(), ready.gather.missingFrontUnits().size(),
                          ready.checkpoint->warnings()};
    });
}

}  // namespace prt
