#include "prt/transport/transfer_matrices.h"

#include <new>
#include <string>

#include "prt/base/error.h"
#include "prt/basis/sh.h"
#include "prt/transport/bake.h"
#include "prt/transport/matrix_bake.h"
#include "prt/transport/receivers.h"

namespace prt {
namespace {

void checkOptions(const TransferMatrixOptions& options) {
    const auto require = [](bool holds, const std::string& message) {
        if (!holds) throw Error(ErrorCode::invalidOption, message);
    };
    checkGatherRanges(options.bandCount, options.sampleCount);
    checkMatrixBands(options.incidentBandCount, options.bandCount);
    require(options.bounceCount >= 0 || options.bounceCount == kInfiniteBounces,
            "the number of bounces must not be negative");
    require(options.bounceCount == 0 || options.reflection || options.incidentBandCount >= 2,
            "bounces need at least two bands of incident radiance");
    require(!options.isa || *options.isa <= detectIsa(),
            "this machine does not have the instruction set " +
                std::string(isaName(options.isa.value_or(Isa::sse4))));
}

}  // namespace

void checkMatrixBands(int incidentBandCount, int bandCount) {
    if (incidentBandCount >= 1 && bandCount >= 1 &&
        incidentBandCount + bandCount - 1 <= kMaxBandCount)
        return;
    throw Error(ErrorCode::invalidOption, "the bands of incident radiance and of light, " +
                                              std::to_string(incidentBandCount) + " and " +
                                              std::to_string(bandCount) +
                                              ", must be at least 1 each and at most " +
                                              std::to_string(kMaxBandCount + 1) + " together");
}

TransferMatrices bakeTransferMatrices(const Scene& scene, const TransferMatrixOptions& options,
                                      TransferMatrixStats* stats) {
    checkOptions(options);
    const RayScene rays(scene, {options.isa, options.threadCount});
    const Receivers receivers = placeReceivers(scene, rays);
    const GatherKernels kernels = selectGatherKernels(options.isa.value_or(detectIsa()));
    const SamplePattern pattern(padToLanes(static_cast<std::size_t>(options.sampleCount)));
    const VisibilityMatrix visibilityMatrix(options.incidentBandCount, options.bandCount);
    const SurfaceReflection reflection =
        options.reflection ? options.reflection : lambertReflection(scene);
    const GatherScene gatherScene{scene, rays, receivers};
    const MatrixGatherScene shared{gatherScene,      kernels,    pattern,
                                   visibilityMatrix, reflection, options.seed};

    const MatrixBakeOptions bakeOptions{.bounceCount = options.bounceCount,
                                        .threadCount = options.threadCount,
                                        .tables = options.storage,
                                        .progress = options.progress};
    TransferMatrices result{options.incidentBandCount,
                            options.bandCount,
                            receivers.frontOfVertex,
                            options.bounceCount == 0 ? 1 : 3,
                            {}};
    MatrixBake bake(shared, bakeOptions);
    try {
        result.matrices = bake.gatherVisible();
        if (options.bounceCount != 0) result.matrices = bake.addBounces(result.matrices);
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::outOfMemory, "the matrices need more memory than there is", {},
                    "use fewer bands or a smaller scene");
    }
    if (stats) {
        *stats = {bake.visibleCounts(), receivers.fronts.size()};
        stats->counts += bake.bounceCounts();
    }
    return result;
}

}  // namespace prt
