#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "prt/scene/scene.h"
#include "prt/trace/ray_scene.h"
#include "prt/transport/hit_matrix.h"
#include "prt/transport/receivers.h"

namespace prt {

/// What the rays of one receiver brought, or of many.
struct GatherCounts {
    std::uint64_t rayCount = 0;
    std::uint64_t hitCount = 0;
    std::uint64_t invalidRayCount = 0;
    double traceSeconds = 0.0;
    double accumulateSeconds = 0.0;

    GatherCounts& operator+=(const GatherCounts& other);
};

struct GatherOptions {
    int bandCount = 5;
    std::size_t sampleCount = 1024;  ///< a multiple of kLaneMultiple
    std::uint64_t seed = 1;
    bool keepHits = true;  ///< for bounces
};

/// Checks what users ask of a gather: 1 … kMaxBandCount bands, 16 … 65536 rays a receiver.
///
/// @throws Error  invalidOption
void checkGatherRanges(int bandCount, int sampleCount);

/// What all receivers' gathers share.
struct GatherScene {
    const Scene& scene;
    const RayScene& rays;
    const Receivers& receivers;
};

/// Number of a receiver's other side in the bounce matrix: backs are numbered after all fronts.
inline std::uint32_t backReceiver(const Receivers& receivers, std::uint32_t front) {
    return static_cast<std::uint32_t>(receivers.fronts.size()) + front;
}

/// Gathers light at receivers, one after the other: rays over the hemisphere, the sum
/// of y_i over those that escape, and a row of the bounce matrix from those that do
/// not. One of them serves one thread.
class Gatherer {
  public:
    Gatherer(const GatherScene& scene, const GatherKernels& kernels, const SamplePattern& pattern,
             const GatherOptions& options);

    /// @param receiver  a front, or backReceiver() of one
    /// @param transfer  n² coefficients of shadowed transfer (C6), written
    /// @param slab      given the receiver's row, if hits are kept
    void gather(std::uint32_t receiver, std::span<float> transfer, HitSlab& slab);

    const GatherCounts& counts() const { return counts_; }

  private:
    void findHits();
    void appendRow(std::uint32_t receiver, HitSlab& slab);
    Vec3f albedoAt(const SurfacePoint& point) const;
    std::size_t sceneTriangle(const SurfacePoint& point) const;
    void addHit(const Hit& hit, HitSlab& slab, std::size_t rowBegin);
    void addEntry(std::uint32_t receiver, const Vec3f& weight, HitSlab& slab, std::size_t rowBegin);

    const GatherScene& scene_;
    const GatherKernels& kernels_;
    const SamplePattern& pattern_;
    GatherOptions options_;
    std::vector<std::size_t> firstTriangle_;           // of each mesh, scene-wide
    std::vector<std::optional<Vec3f>> uniformAlbedo_;  // of meshes that have the same everywhere
    RayStream rays_;
    std::vector<std::uint32_t> blockedRays_;
    std::vector<Hit> hits_;
    // A hash table from a receiver to its entry in the row at work.
    std::vector<std::uint32_t> entryOfSlot_;
    std::vector<std::uint32_t> usedSlots_;
    std::uint32_t slotMask_ = 0;
    GatherCounts counts_;
};

}  // namespace prt
