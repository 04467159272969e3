#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "prt/transport/bake.h"
#include "prt/transport/bake_plan.h"
#include "prt/transport/bounce.h"
#include "prt/transport/checkpoint.h"
#include "prt/transport/gather.h"
#include "prt/transport/gather_unit.h"

namespace prt {

/// Shadowed transfer of every receiver that is needed, and the hits of their rays.
struct GatheredLight {
    /// Nothing yet, with room for all receivers of a scene.
    GatheredLight(const GatherScene& scene, int bandCount, const MemoryPlan& memory);

    DirectTransfer direct;
    HitMatrix hits;
    GatherCounts counts;
};

/// Gathers at all fronts, and then at those backs of double-sided surfaces that rays have met, and
/// at those that these meet in turn: a stage each, cut into units of a size that depends on
/// nothing but the work.
class GatherPass {
  public:
    /// @param checkpoint  finished units are kept there and found again; may be null
    GatherPass(const GatherScene& scene, const BakeOptions& options, Isa isa,
               Checkpoint* checkpoint);

    /// @throws Error  notFound naming the units of fronts that the checkpoint lacks, if
    ///                options.checkpoint.requireFronts
    void gatherAll(GatheredLight& light);

    std::size_t frontUnitCount() const { return fronts_.unitCount(); }
    /// Makes some of the fronts' units, those that the checkpoint lacks.
    void makeFrontUnits(UnitRange units);
    /// Those that no file of the checkpoint holds.
    std::vector<std::size_t> missingFrontUnits() const;

    /// How many units the checkpoint had already.
    std::size_t resumedUnitCount() const { return resumedUnitCount_; }

  private:
    /// All receivers of a stage, and the name of its units.
    struct Stage {
        std::string name;
        std::vector<std::uint32_t> receivers;
        std::size_t receiversPerUnit = 1;

        std::size_t unitCount() const;
        UnitKey key(std::size_t unit) const;
        std::span<const std::uint32_t> receiversOf(std::size_t unit) const;
    };
    enum class BackState : std::uint8_t { unseen, needed, gathered };

    Stage makeStage(std::string name, std::vector<std::uint32_t> receivers) const;
    Stage makeFrontStage() const;
    GatherUnitShape shapeOf(std::span<const std::uint32_t> receivers) const;
    void requireFrontUnits() const;
    void gatherStage(const Stage& stage, GatheredLight& light);
    GatherUnit provideUnit(const Stage& stage, std::size_t index, ProgressReporter& reporter);
    bool loadUnit(const Stage& stage, std::size_t index, GatherUnit& unit) const;
    GatherUnit makeUnit(const Stage& stage, std::size_t index, ProgressReporter& reporter) const;
    void finishUnit(const Stage& stage, std::size_t index, GatherUnit unit, GatheredLight& light);
    void keepTransfer(std::span<const std::uint32_t> receivers, std::span<const float> transfer,
                      DirectTransfer& direct) const;
    EntryLoader entryLoader(const UnitKey& key) const;
    std::vector<std::uint32_t> takeNeededBacks() const;

    const GatherScene& scene_;
    const BakeOptions& options_;
    GatherOptions gatherOptions_;
    GatherKernels kernels_;
    SamplePattern pattern_;
    Checkpoint* checkpoint_;
    Stage fronts_;
    std::mutex finishing_;
    std::vector<BackState> backs_;
    std::atomic<std::size_t> resumedUnitCount_{0};
};

}  // namespace prt
