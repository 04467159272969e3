#include "prt/transport/gather_pass.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "prt/base/error.h"
#include "prt/basis/sh.h"
#include "prt/parallel/parallel_for.h"

namespace prt {
namespace {

// What one thread takes where a file is written afterwards; and how many files there should be at
// most, unless each would lose much work with the process.
constexpr std::size_t kRaysPerUnit = std::size_t(1) << 19;
constexpr std::size_t kMaxRaysPerUnit = std::size_t(1) << 24;
constexpr std::size_t kUnitCountAim = 8192;

// A sentence names no more ranges of units than this.
constexpr std::size_t kListedRanges = 20;

/// "3, 5 to 7, 12".
std::string listUnits(const std::vector<std::size_t>& units) {
    std::string text;
    std::size_t rangeCount = 0;
    for (std::size_t i = 0; i < units.size(); ++rangeCount) {
        std::size_t last = i;
        while (last + 1 < units.size() && units[last + 1] == units[last] + 1)
            ++last;
        if (rangeCount == kListedRanges)
            return text + " and " + std::to_string(units.size() - i) + " more";
        text += (text.empty() ? "" : ", ") + std::to_string(units[i]);
        if (last > i) text += " to " + std::to_string(units[last]);
        i = last + 1;
    }
    return text;
}

}  // namespace

GatherOptions gatherOptionsOf(const BakeOptions& options) {
    return {options.bandCount, padToLanes(static_cast<std::size_t>(options.sampleCount)),
            options.seed, options.transport == Transport::interreflected};
}

std::size_t receiversPerUnit(std::size_t receiverCount, std::size_t sampleCount) {
    const std::size_t rays =
        std::clamp(receiverCount * sampleCount / kUnitCountAim, kRaysPerUnit, kMaxRaysPerUnit);
    return std::max<std::size_t>(rays / sampleCount, 1);
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
        checkpoint_ ? receiversPerUnit(receivers.size(), gatherOptions_.sampleCount)
                    : kReceiversPerSlab;
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
    light.receiverCount = scene_.receivers.fronts.size();
    if (light.receiverCount > 0) gatherStage(fronts_, light);
    for (int wave = 1;; ++wave) {
        const Stage backs = makeStage("backs-" + std::to_string(wave), takeNeededBacks());
        if (backs.receivers.empty()) break;
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
    if (stage.receivers.front() >= light.receiverCount) light.receiverCount *= 2;
    light.directTransfer.resize(light.receiverCount * shapeOf({}).coefficientCount);

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
    const std::size_t n = shapeOf(receivers).coefficientCount;
    for (std::size_t i = 0; i < receivers.size(); ++i)
        std::copy_n(unit.transfer.data() + i * n, n,
                    light.directTransfer.data() + receivers[i] * n);

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
