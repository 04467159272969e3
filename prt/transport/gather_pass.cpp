#include "prt/transport/gather_pass.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "prt/base/error.h"
#include "prt/basis/sh.h"
#include "prt/parallel/parallel_for.h"
#include "prt/transport/runs.h"

namespace prt {
namespace {

// A sentence names no more ranges of units than this.
constexpr std::size_t kListedRanges = 20;

/// "3, 5 to 7, 12".
std::string listUnits(std::span<const std::size_t> units) {
    std::string text;
    std::size_t rangeCount = 0;
    std::size_t listedCount = 0;
    forRuns(units, [&](std::size_t first, std::size_t count) {
        if (++rangeCount > kListedRanges) return;
        text += (text.empty() ? "" : ", ") + std::to_string(units[first]);
        if (count > 1) text += " to " + std::to_string(units[first + count - 1]);
        listedCount += count;
    });
    if (listedCount == units.size()) return text;
    return text + " and " + std::to_string(units.size() - listedCount) + " more";
}

}  // namespace

GatheredLight::GatheredLight(const GatherScene& scene, int bandCount, const MemoryPlan& memory)
    : hits(memory.hitBytes, memory.tables.scratchFolder) {
    const auto coefficientCount = static_cast<std::size_t>(shCoefficientCount(bandCount));
    const auto makeTable = [&](std::size_t receiverCount) {
        return CoefficientTable(receiverCount, coefficientCount, sizeof(float), memory.tables);
    };
    direct.fronts = makeTable(scene.receivers.fronts.size());
    direct.backs = makeTable(scene.receivers.backs.size());
}

std::size_t GatherPass::Stage::unitCount() const {
    return (receivers.size() + receiversPerUnit - 1) / receiversPerUnit;
}

UnitKey GatherPass::Stage::key(std::size_t unit) const {
    const std::size_t begin = unit * receiversPerUnit;
    return {name, static_cast<std::uint32_t>(unit), begin, begin + receiversOf(unit).size()};
}

std::span<const std::uint32_t> GatherPass::Stage::receiversOf(std::size_t unit) const {
    const std::size_t begin = unit * receiversPerUnit;
    return std::span(receivers).subspan(begin,
                                        std::min(receiversPerUnit, receivers.size() - begin));
}

GatherPass::GatherPass(const GatherScene& scene, const BakeOptions& options, Isa isa,
                       Checkpoint* checkpoint)
    : scene_(scene),
      options_(options),
      gatherOptions_(gatherOptionsOf(options)),
      kernels_(selectGatherKernels(isa)),
      pattern_(gatherOptions_.sampleCount),
      checkpoint_(checkpoint),
      fronts_(makeFrontStage()),
      backs_(scene.receivers.backs.size()) {}

GatherPass::Stage GatherPass::makeStage(std::string name,
                                        std::vector<std::uint32_t> receivers) const {
    const std::size_t unitSize =
        receiversPerUnit(receivers.size(), gatherOptions_.sampleCount, checkpoint_ != nullptr);
    return {std::move(name), std::move(receivers), unitSize};
}

GatherPass::Stage GatherPass::makeFrontStage() const {
    std::vector<std::uint32_t> fronts(scene_.receivers.fronts.size());
    std::iota(fronts.begin(), fronts.end(), 0u);
    return makeStage("fronts", std::move(fronts));
}

GatherUnitShape GatherPass::shapeOf(std::span<const std::uint32_t> receivers) const {
    return {receivers, static_cast<std::size_t>(shCoefficientCount(gatherOptions_.bandCount)),
            gatherOptions_.keepHits,
            scene_.receivers.fronts.size() + scene_.receivers.backs.size()};
}

void GatherPass::gatherAll(GatheredLight& light) {
    if (options_.checkpoint.requireFronts) requireFrontUnits();
    if (!fronts_.receivers.empty()) gatherStage(fronts_, light);
    for (int wave = 1;; ++wave) {
        const Stage backs = makeStage("backs-" + std::to_string(wave), takeNeededBacks());
        if (backs.receivers.empty()) break;
        light.direct.isFromBacks = true;
        gatherStage(backs, light);
    }
    light.hits.sortSlabs();
}

void GatherPass::makeFrontUnits(UnitRange units) {
    units.end = std::min(units.end, fronts_.unitCount());
    units.begin = std::min(units.begin, units.end);
    std::size_t receiverCount = 0;
    for (std::size_t index = units.begin; index < units.end; ++index)
        receiverCount += fronts_.receiversOf(index).size();
    ProgressReporter reporter(options_.progress, "trace", "rays",
                              receiverCount * gatherOptions_.sampleCount);
    parallelFor(units.end - units.begin, {options_.threadCount, 1},
                [&](std::size_t begin, std::size_t end) {
                    for (std::size_t i = begin; i < end; ++i)
                        provideUnit(fronts_, units.begin + i, reporter);
                });
}

std::vector<std::size_t> GatherPass::missingFrontUnits() const {
    std::vector<std::size_t> missing;
    for (std::size_t index = 0; index < fronts_.unitCount(); ++index)
        if (!checkpoint_->contains(fronts_.key(index))) missing.push_back(index);
    return missing;
}

void GatherPass::requireFrontUnits() const {
    const std::vector<std::size_t> missing = missingFrontUnits();
    if (missing.empty()) return;
    throw Error(ErrorCode::notFound,
                "of " + std::to_string(fronts_.unitCount()) +
                    " units these are missing: " + listUnits(missing),
                checkpoint_->folder().string(), "make them with prt bake --units");
}

void GatherPass::gatherStage(const Stage& stage, GatheredLight& light) {
    ProgressReporter reporter(options_.progress, "trace", "rays",
                              stage.receivers.size() * gatherOptions_.sampleCount);
    parallelFor(stage.unitCount(), {options_.threadCount, 1},
                [&](std::size_t begin, std::size_t end) {
                    for (std::size_t index = begin; index < end; ++index)
                        finishUnit(stage, index, provideUnit(stage, index, reporter), light);
                });
}

/// A unit from the checkpoint, or else a new one.
GatherUnit GatherPass::provideUnit(const Stage& stage, std::size_t index,
                                   ProgressReporter& reporter) {
    GatherUnit unit;
    if (!loadUnit(stage, index, unit)) return makeUnit(stage, index, reporter);
    ++resumedUnitCount_;
    reporter.advance(stage.receiversOf(index).size() * gatherOptions_.sampleCount);
    return unit;
}

bool GatherPass::loadUnit(const Stage& stage, std::size_t index, GatherUnit& unit) const {
    if (!checkpoint_) return false;
    return checkpoint_->load(stage.key(index), [&](std::span<const std::byte> payload) {
        unit = readGatherUnit(payload, shapeOf(stage.receiversOf(index)));
    });
}

GatherUnit GatherPass::makeUnit(const Stage& stage, std::size_t index,
                                ProgressReporter& reporter) const {
    const GatherUnitShape shape = shapeOf(stage.receiversOf(index));
    Gatherer gatherer(scene_, kernels_, pattern_, gatherOptions_);
    GatherUnit unit;
    unit.transfer.resize(shape.receivers.size() * shape.coefficientCount);
    for (std::size_t i = 0; i < shape.receivers.size(); ++i) {
        gatherer.gather(
            shape.receivers[i],
            std::span(unit.transfer).subspan(i * shape.coefficientCount, shape.coefficientCount),
            unit.slab);
        reporter.advance(gatherOptions_.sampleCount);
    }
    unit.counts = gatherer.counts();
    if (checkpoint_) checkpoint_->store(stage.key(index), encodeGatherUnit(unit, shape));
    return unit;
}

void GatherPass::finishUnit(const Stage& stage, std::size_t index, GatherUnit unit,
                            GatheredLight& light) {
    const std::span<const std::uint32_t> receivers = stage.receiversOf(index);
    keepTransfer(receivers, unit.transfer, light.direct);

    const std::size_t frontCount = scene_.receivers.fronts.size();
    const std::lock_guard lock(finishing_);
    light.counts += unit.counts;
    if (!gatherOptions_.keepHits) return;
    for (const std::uint32_t receiver : receivers)
        if (receiver >= frontCount) backs_[receiver - frontCount] = BackState::gathered;
    for (const BounceEntry& entry : unit.slab.entries)
        if (entry.receiver >= frontCount &&
            backs_[entry.receiver - frontCount] == BackState::unseen)
            backs_[entry.receiver - frontCount] = BackState::needed;
    light.hits.addSlab(std::move(unit.slab),
                       checkpoint_ ? entryLoader(stage.key(index)) : EntryLoader());
}

/// @param receivers  all fronts or all backs
void GatherPass::keepTransfer(std::span<const std::uint32_t> receivers,
                              std::span<const float> transfer, DirectTransfer& direct) const {
    const std::size_t frontCount = scene_.receivers.fronts.size();
    const bool isBack = receivers.front() >= frontCount;
    CoefficientTable& table = isBack ? direct.backs : direct.fronts;
    const std::size_t n = table.columnCount();
    forRuns(receivers, [&](std::size_t first, std::size_t count) {
        table.writeRows(receivers[first] - (isBack ? frontCount : 0),
                        transfer.subspan(first * n, count * n));
    });
}

/// Reads the rows of a finished unit again from its file.
EntryLoader GatherPass::entryLoader(const UnitKey& key) const {
    return [checkpoint = checkpoint_, key,
            shape = shapeOf({})](std::span<const std::uint32_t> receivers) {
        GatherUnitShape own = shape;
        own.receivers = receivers;
        std::vector<BounceEntry> entries;
        checkpoint->load(key, [&](std::span<const std::byte> payload) {
            entries = readGatherUnit(payload, own).slab.entries;
        });
        return entries;
    };
}

std::vector<std::uint32_t> GatherPass::takeNeededBacks() const {
    std::vector<std::uint32_t> wave;
    for (std::uint32_t i = 0; i < backs_.size(); ++i)
        if (backs_[i] == BackState::needed) wave.push_back(backReceiver(scene_.receivers, i));
    return wave;
}

}  // namespace prt
