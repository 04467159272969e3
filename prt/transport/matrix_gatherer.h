#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "prt/transport/gather.h"
#include "prt/transport/reflection.h"
#include "prt/transport/visibility_matrix.h"

namespace prt {

/// What the gathers of all matrices share.
struct MatrixGatherScene {
    const GatherScene& scene;
    const GatherKernels& kernels;
    const SamplePattern& pattern;
    const VisibilityMatrix& visibilityMatrix;
    const Reflection& reflection;
    std::uint64_t seed = 1;
};

/// The front, or the back with that number (backReceiver).
inline const Receiver& receiverSite(const Receivers& receivers, std::uint32_t receiver) {
    const std::size_t frontCount = receivers.fronts.size();
    return receiver < frontCount ? receivers.fronts[receiver]
                                 : receivers.backs[receiver - frontCount];
}

/// Makes transfer matrices one after the other, of rays uniform over each receiver's hemisphere.
/// One of them serves one thread.
class MatrixGatherer {
  public:
    explicit MatrixGatherer(const MatrixGatherScene& shared);

    /// The light that comes straight. @param matrix  [i][j], written
    void gatherVisible(std::uint32_t receiver, std::span<float> matrix);

    /// The light that surfaces send on along the same rays, added.
    ///
    /// @param receiver  that gatherVisible was called for last
    /// @param sources   [receiver][channel][i][j], what comes in at surfaces: fronts, then backs if
    ///                  there are any; and kLaneMultiple numbers that mean nothing
    /// @param matrix    [channel][i][j]
    void addReflected(std::uint32_t receiver, std::span<const float> sources,
                      std::span<float> matrix);

    const GatherCounts& counts() const { return counts_; }

  private:
    void findHits();
    bool findRadiance(const Hit& hit, const Vec3f& direction, std::span<const float> sources);

    const MatrixGatherScene& shared_;
    std::size_t rowCount_;
    std::size_t columnCount_;
    std::vector<std::size_t> firstTriangle_;  // of each mesh, scene-wide
    RayStream rays_;
    std::vector<float> visibility_;
    std::vector<float> scratch_;
    std::vector<std::uint32_t> blockedRays_;
    std::vector<Hit> hits_;
    // Rows of light coefficients are padded here: stride_ apart.
    std::size_t stride_;
    std::vector<float> response_;        // [channel][i] of a surface, towards the receiver
    std::vector<float> cornerResponse_;  // times the weight of a corner
    std::vector<float> radiance_;        // [channel][j] that it sends there
    std::vector<float> basis_;           // y_i at the receiver
    std::vector<float> reflected_;       // [channel][i][j] of all rays
    GatherCounts counts_;
};

}  // namespace prt
