// Bibliography
//   [Sloan02]  Precomputed radiance transfer: the transfer matrix and its bounces
#include "prt/transport/transfer_matrices.h"

#include <algorithm>
#include <mutex>
#include <new>
#include <string>

#include "prt/base/error.h"
#include "prt/basis/sh.h"
#include "prt/parallel/parallel_for.h"
#include "prt/transport/matrix_gatherer.h"
#include "prt/transport/receivers.h"

namespace prt {
namespace {

// Receivers a thread takes at a time.
constexpr std::size_t kReceiversPerTask = 64;

void checkOptions(const TransferMatrixOptions& options) {
    const auto require = [](bool holds, const std::string& message) {
        if (!holds) throw Error(ErrorCode::invalidOption, message);
    };
    checkGatherRanges(options.bandCount, options.sampleCount);
    checkGatherRanges(options.incidentBandCount, options.sampleCount);
    require(options.incidentBandCount + options.bandCount - 1 <= kMaxBandCount,
            "the bands of incident radiance and of light must not be more than " +
                std::to_string(kMaxBandCount + 1) + " together");
    require(options.bounceCount >= 0, "the number of bounces must not be negative");
    require(options.bounceCount == 0 || options.reflection || options.incidentBandCount >= 2,
            "bounces need at least two bands of incident radiance");
    require(!options.isa || *options.isa <= detectIsa(),
            "this machine does not have the instruction set " +
                std::string(isaName(options.isa.value_or(Isa::sse4))));
}

/// Backs that are seen: those of double-sided surfaces.
std::vector<bool> findDoubleSided(const Scene& scene, const Receivers& receivers) {
    std::vector<bool> doubleSided(receivers.backs.size());
    std::size_t vertex = 0;
    for (const Mesh& mesh : scene.meshes) {
        const bool isDoubleSided = scene.materials[mesh.material].doubleSided;
        for (std::size_t i = 0; i < mesh.vertexCount(); ++i, ++vertex)
            if (isDoubleSided) doubleSided[receivers.frontOfVertex[vertex]] = true;
    }
    return doubleSided;
}

/// Gathers at all receivers, again and again.
class MatrixPasses {
  public:
    MatrixPasses(const MatrixGatherScene& shared, const TransferMatrixOptions& options)
        : shared_(shared),
          options_(options),
          elementCount_(shared.visibilityMatrix.elementCount()),
          backIsSeen_(findDoubleSided(shared.scene.scene, shared.scene.receivers)) {}

    /// Without bounces, at the fronts. @param matrices  a row is [i][j], written
    void gatherVisible(CoefficientTable& matrices) {
        forReceivers(
            matrices.rowCount(), [&](MatrixGatherer& gatherer, std::size_t begin, std::size_t end) {
                std::vector<float> rows((end - begin) * elementCount_);
                for (std::size_t i = begin; i < end; ++i)
                    gatherer.gatherVisible(
                        static_cast<std::uint32_t>(i),
                        std::span(rows).subspan((i - begin) * elementCount_, elementCount_));
                matrices.writeRows(begin, std::span<const float>(rows));
            });
    }

    /// With bounces. @param matrices  a row is [channel][i][j], written
    void gatherBounces(CoefficientTable& matrices) {
        std::vector<float> sources = gatherAll({});
        for (int bounce = 1; bounce < options_.bounceCount; ++bounce)
            sources = gatherAll(sources);
        const std::size_t length = 3 * elementCount_;
        forReceivers(matrices.rowCount(), [&](MatrixGatherer& gatherer, std::size_t begin,
                                              std::size_t end) {
            std::vector<float> rows((end - begin) * length);
            for (std::size_t i = begin; i < end; ++i)
                gather(gatherer, i, sources, std::span(rows).subspan((i - begin) * length, length));
            matrices.writeRows(begin, std::span<const float>(rows));
        });
    }

    const GatherCounts& counts() const { return counts_; }

  private:
    /// Matrices of fronts and backs, one bounce after `sources`.
    std::vector<float> gatherAll(std::span<const float> sources) {
        const Receivers& receivers = shared_.scene.receivers;
        const std::size_t frontCount = receivers.fronts.size();
        const std::size_t length = 3 * elementCount_;
        std::vector<float> matrices((frontCount + receivers.backs.size()) * length + kLaneMultiple);
        forReceivers(frontCount + receivers.backs.size(), [&](MatrixGatherer& gatherer,
                                                              std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                if (i < frontCount || backIsSeen_[i - frontCount])
                    gather(gatherer, i, sources, std::span(matrices).subspan(i * length, length));
        });
        return matrices;
    }

    /// @param sources  empty: no light is reflected
    /// @param matrix   [channel][i][j], written
    void gather(MatrixGatherer& gatherer, std::size_t receiver, std::span<const float> sources,
                std::span<float> matrix) const {
        const auto index = static_cast<std::uint32_t>(receiver);
        gatherer.gatherVisible(index, matrix.first(elementCount_));
        std::copy_n(matrix.begin(), elementCount_, matrix.begin() + std::ptrdiff_t(elementCount_));
        std::copy_n(matrix.begin(), elementCount_,
                    matrix.begin() + std::ptrdiff_t(2 * elementCount_));
        if (!sources.empty()) gatherer.addReflected(index, sources, matrix);
    }

    template <class Work>
    void forReceivers(std::size_t count, Work work) {
        const std::string stage =
            passCount_ == 0 ? "trace" : "bounce " + std::to_string(passCount_);
        ++passCount_;
        ProgressReporter reporter(options_.progress, stage, "receivers", count);
        parallelFor(count, {options_.threadCount, kReceiversPerTask},
                    [&](std::size_t begin, std::size_t end) {
                        MatrixGatherer gatherer(shared_);
                        work(gatherer, begin, end);
                        reporter.advance(end - begin);
                        const std::lock_guard lock(counting_);
                        counts_ += gatherer.counts();
                    });
    }

    const MatrixGatherScene& shared_;
    const TransferMatrixOptions& options_;
    std::size_t elementCount_;
    std::vector<bool> backIsSeen_;
    int passCount_ = 0;
    std::mutex counting_;
    GatherCounts counts_;
};

}  // namespace

TransferMatrices bakeTransferMatrices(const Scene& scene, const TransferMatrixOptions& options,
                                      TransferMatrixStats* stats) {
    checkOptions(options);
    const RayScene rays(scene, {options.isa, options.threadCount});
    const Receivers receivers = placeReceivers(scene, rays);
    const GatherKernels kernels = selectGatherKernels(options.isa.value_or(detectIsa()));
    const SamplePattern pattern(padToLanes(static_cast<std::size_t>(options.sampleCount)));
    const VisibilityMatrix visibilityMatrix(options.incidentBandCount, options.bandCount);
    const Reflection reflection =
        options.reflection ? options.reflection : lambertReflection(scene);
    const GatherScene gatherScene{scene, rays, receivers};
    const MatrixGatherScene shared{gatherScene,      kernels,    pattern,
                                   visibilityMatrix, reflection, options.seed};

    const int channelCount = options.bounceCount > 0 ? 3 : 1;
    TransferMatrices result{
        options.incidentBandCount, options.bandCount, receivers.frontOfVertex, channelCount,
        CoefficientTable(receivers.fronts.size(),
                         static_cast<std::size_t>(channelCount) * visibilityMatrix.elementCount(),
                         sizeof(float), options.storage)};
    MatrixPasses passes(shared, options);
    try {
        if (options.bounceCount > 0)
            passes.gatherBounces(result.matrices);
        else
            passes.gatherVisible(result.matrices);
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::outOfMemory, "the matrices need more memory than there is", {},
                    "use fewer bands or a smaller scene");
    }
    if (stats) *stats = {passes.counts(), receivers.fronts.size()};
    return result;
}

}  // namespace prt
