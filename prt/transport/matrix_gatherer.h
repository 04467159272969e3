#pragma once

#include <array>
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
    const SurfaceReflection& reflection;
    std::uint64_t seed = 1;
};

/// The front, or the back with that number (backReceiver).
inline const Receiver& receiverSite(const Receivers& receivers, std::uint32_t receiver) {
    const std::size_t frontCount = receivers.fronts.size();
    return receiver < frontCount ? receivers.fronts[receiver]
                                 : receivers.backs[receiver - frontCount];
}

/// Some coefficients of the light: columns of a matrix.
struct ColumnRange {
    std::size_t begin = 0;
    std::size_t end = 0;

    std::size_t count() const { return end - begin; }
};

/// What comes in at surfaces, for some columns of light.
struct MatrixSources {
    /// [row][channel][i][column − columns.begin]: front i has row i. Behind them come kLaneMultiple
    /// numbers that mean nothing.
    const float* values = nullptr;
    ColumnRange columns{};
    std::span<const std::uint32_t> rowOfBack{};  ///< kNoRow: that side sends nothing
};

inline constexpr std::uint32_t kNoRow = 0xffffffffu;

/// Makes transfer matrices one after the other, of rays uniform over each receiver's hemisphere.
/// One of them serves one thread.
class MatrixGatherer {
  public:
    explicit MatrixGatherer(const MatrixGatherScene& shared);

    /// The light that comes straight. @param matrix  [i][j], written
    void gatherVisible(std::uint32_t receiver, std::span<float> matrix);

    /// The light that surfaces send on along the same rays, added: each column by itself, and so
    /// the same whichever are made at once.
    ///
    /// @param receiver  that gatherVisible was called for last
    /// @param matrix    [channel][i][column − sources.columns.begin]
    void addReflected(std::uint32_t receiver, const MatrixSources& sources,
                      std::span<float> matrix);

    /// Adds the backs that the rays of gatherVisible have met: those of the corners there.
    ///
    /// @param backs  back i lies behind front i
    void appendBacksMet(std::vector<std::uint32_t>& backs);

    const GatherCounts& counts() const { return counts_; }

  private:
    void findHits();
    bool reflects(const Hit& hit) const;
    const std::array<std::uint32_t, 3>& frontsAt(const Hit& hit) const;
    void prefetchSources(const Hit& hit, const MatrixSources& sources) const;
    void findRadiance(const Hit& hit, const Vec3f& direction, const MatrixSources& sources,
                      std::size_t stride);

    const MatrixGatherScene& shared_;
    std::size_t rowCount_;
    std::vector<std::size_t> firstTriangle_;  // of each mesh, scene-wide
    RayStream rays_;
    std::vector<float> visibility_;
    std::vector<float> scratch_;
    std::vector<std::uint32_t> blockedRays_;
    std::vector<Hit> hits_;
    // Rows of light coefficients are padded in these.
    std::vector<float> response_;        // [channel][i] of a surface, towards the receiver
    std::vector<float> cornerResponse_;  // times the weight of a corner
    std::vector<float> radiance_;        // [channel][j] that it sends there
    std::vector<float> basis_;           // y_i at the receiver
    std::vector<float> reflected_;       // [channel][i][j] of all rays
    GatherCounts counts_;
};

}  // namespace prt
