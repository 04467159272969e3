// Bibliography
//   [Sloan02]  Precomputed radiance transfer: the transfer matrix
#include "prt/transport/transfer_matrices.h"

#include <algorithm>
#include <mutex>
#include <numbers>
#include <string>

#include "prt/base/error.h"
#include "prt/base/random.h"
#include "prt/basis/sh.h"
#include "prt/parallel/parallel_for.h"
#include "prt/transport/receivers.h"
#include "prt/transport/stopwatch.h"
#include "prt/transport/visibility_matrix.h"

namespace prt {
namespace {

// Receivers a thread takes at a time.
constexpr std::size_t kReceiversPerTask = 64;

void checkOptions(const TransferMatrixOptions& options) {
    checkGatherRanges(options.bandCount, options.sampleCount);
    checkGatherRanges(options.incidentBandCount, options.sampleCount);
    if (options.incidentBandCount + options.bandCount - 1 > kMaxBandCount)
        throw Error(ErrorCode::invalidOption,
                    "the bands of incident radiance and of light must not be more than " +
                        std::to_string(kMaxBandCount + 1) + " together");
    if (options.isa && *options.isa > detectIsa())
        throw Error(ErrorCode::invalidOption, "this machine does not have the instruction set " +
                                                  std::string(isaName(*options.isa)));
}

/// What all receivers share.
struct SharedParts {
    const TransferMatrixOptions& options;
    const RayScene& rays;
    GatherKernels kernels;
    SamplePattern pattern;
    VisibilityMatrix visibilityMatrix;
};

/// Makes matrices one after the other. One of them serves one thread.
class MatrixGatherer {
  public:
    explicit MatrixGatherer(const SharedParts& shared)
        : shared_(shared),
          rays_(shared.pattern.reversedX.size()),
          visibility_(static_cast<std::size_t>(
              shCoefficientCount(shared.visibilityMatrix.visibilityBandCount()))),
          scratch_(shared.visibilityMatrix.elementCount()) {}

    /// @param matrix  [i][j], written
    void gather(const Receiver& site, std::span<float> matrix) {
        {
            const Stopwatch watch(counts_.accumulateSeconds);
            RandomStream random(shared_.options.seed, site.randomStream);
            const std::uint32_t seedX = random.nextBits();
            shared_.kernels.sampleUniformDirections(shared_.pattern,
                                                    {seedX, random.nextBits(), site.normal}, rays_);
            rays_.restart(site.origin);
        }
        {
            const Stopwatch watch(counts_.traceSeconds);
            counts_.rayCount += rays_.size();
            counts_.invalidRayCount += shared_.rays.findOccluded(rays_);
        }
        const Stopwatch watch(counts_.accumulateSeconds);
        // v_k = 2π E[V y_k], for uniform directions have the density 1/2π.
        shared_.kernels.sumVisible(rays_, shared_.visibilityMatrix.visibilityBandCount(),
                                   visibility_);
        const float weight = 2.0f * std::numbers::pi_v<float> / static_cast<float>(rays_.size());
        for (float& coefficient : visibility_)
            coefficient *= weight;
        shared_.visibilityMatrix.make(visibility_, site.normal, scratch_, matrix);
    }

    const GatherCounts& counts() const { return counts_; }

  private:
    const SharedParts& shared_;
    RayStream rays_;
    std::vector<float> visibility_;
    std::vector<float> scratch_;
    GatherCounts counts_;
};

}  // namespace

TransferMatrices bakeTransferMatrices(const Scene& scene, const TransferMatrixOptions& options,
                                      TransferMatrixStats* stats) {
    checkOptions(options);
    const RayScene rays(scene, {options.isa, options.threadCount});
    const Receivers receivers = placeReceivers(scene, rays);
    const SharedParts shared{
        options, rays, selectGatherKernels(options.isa.value_or(detectIsa())),
        SamplePattern(padToLanes(static_cast<std::size_t>(options.sampleCount))),
        VisibilityMatrix(options.incidentBandCount, options.bandCount)};

    const std::size_t elementCount = shared.visibilityMatrix.elementCount();
    TransferMatrices result{
        options.incidentBandCount, options.bandCount, receivers.frontOfVertex,
        CoefficientTable(receivers.fronts.size(), elementCount, sizeof(float), options.storage)};
    TransferMatrixStats report{{}, receivers.fronts.size()};
    std::mutex reporting;
    parallelFor(receivers.fronts.size(), {options.threadCount, kReceiversPerTask},
                [&](std::size_t begin, std::size_t end) {
                    MatrixGatherer gatherer(shared);
                    std::vector<float> rows((end - begin) * elementCount);
                    for (std::size_t i = begin; i < end; ++i)
                        gatherer.gather(
                            receivers.fronts[i],
                            std::span(rows).subspan((i - begin) * elementCount, elementCount));
                    result.matrices.writeRows(begin, std::span<const float>(rows));
                    const std::lock_guard lock(reporting);
                    report.counts += gatherer.counts();
                });
    if (stats) *stats = report;
    return result;
}

}  // namespace prt
