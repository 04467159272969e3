#include "prt/transport/bake.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include "prt/base/error.h"
#include "prt/base/resident_memory.h"
#include "prt/basis/sh.h"
#include "prt/parallel/parallel_for.h"
#include "prt/transport/bake_plan.h"
#include "prt/transport/bake_settings.h"
#include "prt/transport/bounce.h"
#include "prt/transport/gather_pass.h"
#include "prt/transport/matrix_bake.h"
#include "prt/transport/transfer_matrices.h"
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
    if (isGlossy(options.transport)) checkMatrixBands(options.incidentBandCount, options.bandCount);
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

/// How surfaces reflect, where that is asked.
SurfaceReflection chooseReflection(const Scene& scene, const BakeOptions& options) {
    if (options.transport != Transport::glossy || options.reflection || options.bounceCount == 0)
        return options.reflection;
    return gltfReflection(scene, std::make_shared<GltfViewTable>(
                                     GltfViewTableOptions{.bandCount = options.incidentBandCount}));
}

/// All that stands ready before the first ray.
struct ReadyBake {
    ReadyBake(const Scene& source, const BakeOptions& options)
        : isa(options.isa.value_or(detectIsa())),
          checkpoint(openCheckpoint(source, options, isa)),
          rays(source, {options.isa, options.threadCount}),
          receivers(placeReceivers(source, rays)),
          scene{source, rays, receivers},
          gather(scene, options, isa, checkpoint.get()),
          reflection(chooseReflection(source, options)) {}

    Isa isa;
    std::unique_ptr<Checkpoint> checkpoint;  // before the rest, for it may refuse
    RayScene rays;
    Receivers receivers;
    GatherScene scene;
    GatherPass gather;
    SurfaceReflection reflection;
};

BakePlan announcePlan(const ReadyBake& ready, const BakeOptions& options,
                      std::optional<UnitRange> units = {}) {
    BakePlan plan = planBake(ready.scene, options, ready.isa, units);
    if (options.announce) options.announce(plan.forecast);
    return plan;
}

void reportRays(const GatherCounts& counts, const BakeOptions& options, BakeStats& report) {
    report.traceSeconds += counts.traceSeconds / resolveThreadCount(options.threadCount);
    report.rayCount += counts.rayCount;
    report.hitCount += counts.hitCount;
    report.invalidRayCount += counts.invalidRayCount;
}

/// Adds shadowed transfer, and interreflected if light bounces.
void bakeVectors(ReadyBake& ready, const BakeOptions& options, const MemoryPlan& memory,
                 TransferField& field, BakeStats& report) {
    // Trace every ray, once.
    GatheredLight light(ready.scene, options.bandCount, memory);
    ready.gather.gatherAll(light);
    reportRays(light.counts, options, report);
    report.accumulateSeconds +=
        light.counts.accumulateSeconds / resolveThreadCount(options.threadCount);
    report.hitBytes = light.hits.entryBytes();
    report.resumedUnitCount = ready.gather.resumedUnitCount();

    // Let the light bounce.
    CoefficientTable total;
    if (hasBounces(options.transport)) {
        const Clock::time_point bounceBegin = Clock::now();
        total = CoefficientTable(field.receiverCount, coefficientsPerReceiver(options.bandCount, 3),
                                 sizeof(float), memory.tables);
        report.bounceCount =
            addBounces(light.hits, light.direct, selectGatherKernels(report.isa),
                       {options.bounceCount, options.threadCount, memory.blocksAtOnce,
                        options.progress, ready.checkpoint.get()},
                       total);
        report.bounceSeconds = secondsSince(bounceBegin);
    }
    field.layers.push_back({Transport::shadowed, 1, std::move(light.direct.fronts)});
    if (hasBounces(options.transport))
        field.layers.push_back({Transport::interreflected, 3, std::move(total)});
}

/// Adds the matrices of light that is visible, and those with bounces if light bounces.
void bakeMatrices(const ReadyBake& ready, const BakeOptions& options, const MatrixPlan& plan,
                  TransferField& field, BakeStats& report) {
    const GatherKernels kernels = selectGatherKernels(ready.isa);
    const SamplePattern pattern(padToLanes(static_cast<std::size_t>(options.sampleCount)));
    const VisibilityMatrix visibilityMatrix(options.incidentBandCount, options.bandCount);
    const MatrixGatherScene shared{ready.scene,      kernels,          pattern,
                                   visibilityMatrix, ready.reflection, options.seed};
    const bool bounces = hasBounces(options.transport);
    const MatrixBakeOptions bakeOptions{.bounceCount = bounces ? options.bounceCount : 0,
                                        .threadCount = options.threadCount,
                                        .columnsAtOnce = plan.columnsAtOnce,
                                        .tables = plan.tables,
                                        .progress = options.progress,
                                        .checkpoint = ready.checkpoint.get()};
    MatrixBake bake(shared, bakeOptions);
    CoefficientTable visible = bake.gatherVisible();
    CoefficientTable total;
    if (bounces) total = bake.addBounces(visible);
    field.layers.push_back(
        {Transport::glossyShadowed, 1, std::move(visible), options.incidentBandCount});
    if (bounces)
        field.layers.push_back({Transport::glossy, 3, std::move(total), options.incidentBandCount});

    const int threadCount = resolveThreadCount(options.threadCount);
    reportRays(bake.visibleCounts(), options, report);
    reportRays(bake.bounceCounts(), options, report);
    report.accumulateSeconds += bake.visibleCounts().accumulateSeconds / threadCount;
    report.bounceSeconds += bake.bounceCounts().accumulateSeconds / threadCount;
    report.bounceCount = std::max(report.bounceCount, bake.bounceCount());
    report.resumedUnitCount += bake.resumedUnitCount();
}

TransferField bakeRays(const Scene& scene, const BakeOptions& options, BakeStats& report) {
    const Clock::time_point buildBegin = Clock::now();
    ReadyBake ready(scene, options);
    report.buildSeconds = secondsSince(buildBegin);
    report.receiverCount = ready.receivers.fronts.size();
    const BakePlan plan = announcePlan(ready, options);

    TransferField field{options.bandCount, report.receiverCount, ready.receivers.frontOfVertex, {}};
    bakeVectors(ready, options, plan.memory, field, report);
    if (isGlossy(options.transport)) {
        releaseFreeMemory();  // that of the hits
        bakeMatrices(ready, options, plan.matrices, field, report);
    }
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

bool hasBounces(Transport transport) {
    return transport == Transport::interreflected || transport == Transport::glossy;
}

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
    if (isGlossy(options.transport))
        throw Error(ErrorCode::invalidOption, "glossy transport is not made in shares");
    return withinMemory([&] {
        ReadyBake ready(scene, options);
        announcePlan(ready, options, units);
        ready.gather.makeFrontUnits(units);
        return UnitReport{ready.gather.frontUnitCount(), ready.gather.missingFrontUnits().size(),
                          ready.checkpoint->warnings()};
    });
}

}  // namespace prt
