#include "prt/transport/gather.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <array>
#include <bit>
#include <string>

#include "prt/base/error.h"
#include "prt/base/random.h"
#include "prt/basis/sh.h"
#include "prt/scene/surface_color.h"
#include "prt/transport/stopwatch.h"

namespace prt {
namespace {

constexpr std::uint32_t kEmptySlot = 0xffffffffu;

/// Three entries a hit at most, in a table at most half full.
std::size_t slotCountFor(std::size_t hitCount) {
    return std::bit_ceil(6 * hitCount + 1);
}

/// One albedo a mesh, where neither a texture nor vertex colours vary it.
std::vector<std::optional<Vec3f>> findUniformAlbedos(const Scene& scene) {
    std::vector<std::optional<Vec3f>> albedos(scene.meshes.size());
    for (std::size_t i = 0; i < albedos.size(); ++i) {
        const Mesh& mesh = scene.meshes[i];
        const bool varies = scene.materials[mesh.material].baseColorTexture || !mesh.colors.empty();
        if (!varies && mesh.triangleCount() > 0)
            albedos[i] = evaluateAlbedo(scene, {i, 0, 0.0f, 0.0f});
    }
    return albedos;
}

void requireInRange(int value, int low, int high, const std::string& name) {
    if (value >= low && value <= high) return;
    throw Error(ErrorCode::invalidOption, name + " must lie between " + std::to_string(low) +
                                              " and " + std::to_string(high) + ", not " +
                                              std::to_string(value));
}

}  // namespace

void checkGatherRanges(int bandCount, int sampleCount) {
    constexpr int kMinSampleCount = 16;
    constexpr int kMaxSampleCount = 65536;
    requireInRange(bandCount, 1, kMaxBandCount, "the number of bands");
    requireInRange(sampleCount, kMinSampleCount, kMaxSampleCount, "the number of samples");
}

GatherCounts& GatherCounts::operator+=(const GatherCounts& other) {
    rayCount += other.rayCount;
    hitCount += other.hitCount;
    invalidRayCount += other.invalidRayCount;
    traceSeconds += other.traceSeconds;
    accumulateSeconds += other.accumulateSeconds;
    return *this;
}

Gatherer::Gatherer(const GatherScene& scene, const GatherKernels& kernels,
                   const SamplePattern& pattern, const GatherOptions& options)
    : scene_(scene),
      kernels_(kernels),
      pattern_(pattern),
      options_(options),
      uniformAlbedo_(findUniformAlbedos(scene.scene)),
      rays_(options.sampleCount) {
    if (options.keepHits) entryOfSlot_.assign(slotCountFor(options.sampleCount), kEmptySlot);
    firstTriangle_.push_back(0);
    for (const Mesh& mesh : scene.scene.meshes)
        firstTriangle_.push_back(firstTriangle_.back() + mesh.triangleCount());
}

void Gatherer::gather(std::uint32_t receiver, std::span<float> transfer, HitSlab& slab) {
    const std::size_t frontCount = scene_.receivers.fronts.size();
    const Receiver& site = receiver < frontCount ? scene_.receivers.fronts[receiver]
                                                 : scene_.receivers.backs[receiver - frontCount];
    {
        const Stopwatch watch(counts_.accumulateSeconds);
        RandomStream random(options_.seed, site.randomStream);
        const std::uint32_t seedX = random.nextBits();
        kernels_.sampleDirections(pattern_, {seedX, random.nextBits(), site.normal}, rays_);
        rays_.restart(site.origin);
    }
    {
        const Stopwatch watch(counts_.traceSeconds);
        counts_.rayCount += rays_.size();
        counts_.invalidRayCount += scene_.rays.findOccluded(rays_);
        if (options_.keepHits) findHits();
    }
    {
        const Stopwatch watch(counts_.accumulateSeconds);
        // Directions are cosine-distributed, so T_i = E[V y_i] [Pharr23, 13.6].
        kernels_.sumVisible(rays_, options_.bandCount, transfer);
        for (float& coefficient : transfer)
            coefficient /= static_cast<float>(options_.sampleCount);
        if (options_.keepHits) appendRow(receiver, slab);
    }
}

/// Looks for the closest surface along blocked rays only: the others have none.
void Gatherer::findHits() {
    blockedRays_.clear();
    for (std::uint32_t i = 0; i < rays_.size(); ++i)
        if (rays_.tFar[i] < 0.0f) blockedRays_.push_back(i);
    hits_.resize(blockedRays_.size());
    scene_.rays.findClosest(rays_, blockedRays_, hits_);
    counts_.hitCount += hits_.size();
}

void Gatherer::appendRow(std::uint32_t receiver, HitSlab& slab) {
    const std::size_t rowBegin = slab.entries.size();
    slotMask_ = static_cast<std::uint32_t>(slotCountFor(hits_.size()) - 1);
    for (const Hit& hit : hits_)
        if (!hit.escaped)
            hwy::Prefetch(&scene_.receivers.frontsOfTriangle[sceneTriangle(hit.point)]);
    for (const Hit& hit : hits_)
        addHit(hit, slab, rowBegin);
    for (const std::uint32_t slot : usedSlots_)
        entryOfSlot_[slot] = kEmptySlot;
    usedSlots_.clear();
    slab.receivers.push_back(receiver);
    slab.rowEnds.push_back(static_cast<std::uint32_t>(slab.entries.size()));
}

std::size_t Gatherer::sceneTriangle(const SurfacePoint& point) const {
    return firstTriangle_[point.mesh] + point.triangle;
}

Vec3f Gatherer::albedoAt(const SurfacePoint& point) const {
    const std::optional<Vec3f>& uniform = uniformAlbedo_[point.mesh];
    return uniform ? *uniform : evaluateAlbedo(scene_.scene, point);
}

void Gatherer::addHit(const Hit& hit, HitSlab& slab, std::size_t rowBegin) {
    if (hit.escaped) return;  // not finite, or lost between the two queries: blocked, and dark
    const Mesh& mesh = scene_.scene.meshes[hit.point.mesh];
    const Material& material = scene_.scene.materials[mesh.material];
    if (hit.backFace && !material.doubleSided)
        return;  // the inside of a one-sided surface reflects nothing (C11)

    const Vec3f albedo = albedoAt(hit.point) / static_cast<float>(options_.sampleCount);
    const std::array<float, 3> corners = {1.0f - hit.point.u - hit.point.v, hit.point.u,
                                          hit.point.v};
    const std::array<std::uint32_t, 3>& fronts =
        scene_.receivers.frontsOfTriangle[sceneTriangle(hit.point)];
    for (std::size_t k = 0; k < 3; ++k)
        addEntry(hit.backFace ? backReceiver(scene_.receivers, fronts[k]) : fronts[k],
                 albedo * corners[k], slab, rowBegin);
}

/// Adds to the row's entry for this receiver, or begins one.
void Gatherer::addEntry(std::uint32_t receiver, const Vec3f& weight, HitSlab& slab,
                        std::size_t rowBegin) {
    std::uint32_t slot = receiver * 0x9e3779b9u & slotMask_;
    for (; entryOfSlot_[slot] != kEmptySlot; slot = (slot + 1) & slotMask_) {
        BounceEntry& entry = slab.entries[rowBegin + entryOfSlot_[slot]];
        if (entry.receiver != receiver) continue;
        entry.weight += weight;
        return;
    }
    entryOfSlot_[slot] = static_cast<std::uint32_t>(slab.entries.size() - rowBegin);
    usedSlots_.push_back(slot);
    slab.entries.push_back({receiver, weight});
}

}  // namespace prt
