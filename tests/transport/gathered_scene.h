#pragma once

#include <span>
#include <utility>
#include <vector>

#include "prt/basis/sh.h"
#include "prt/transport/bounce.h"
#include "prt/transport/gather.h"

namespace prt::test {

/// The parts of a bake laid open: one band of direct transfer and the matrix of hits, for one-sided
/// surfaces.
struct GatheredScene {
    RayScene rays;
    Receivers receivers;
    std::vector<float> direct;
    HitMatrix hits{std::size_t(1) << 30, {}};

    GatheredScene(const Scene& scene, std::size_t sampleCount, std::uint64_t seed = 1)
        : rays(scene), receivers(placeReceivers(scene, rays)), direct(receivers.fronts.size()) {
        const GatherKernels kernels = selectGatherKernels(detectIsa());
        const SamplePattern pattern(padToLanes(sampleCount));
        const GatherScene gatherScene{scene, rays, receivers};
        Gatherer gatherer(gatherScene, kernels, pattern, {1, sampleCount, seed, true});
        HitSlab slab;
        for (std::uint32_t i = 0; i < direct.size(); ++i)
            gatherer.gather(i, std::span(direct).subspan(i, 1), slab);
        hits.addSlab(std::move(slab));
    }

    /// What `source`, gathered at every receiver, comes to with bounces: [receiver][channel].
    std::vector<float> bounce(const std::vector<float>& source, int bounceCount) const {
        CoefficientTable total(source.size(), 3, sizeof(float));
        const ProgressCallback none;
        addBounces(hits, {makeTable(1, source), {}}, selectGatherKernels(detectIsa()),
                   {.bounceCount = bounceCount, .progress = none}, total);
        return copyRows<float>(total);
    }
};

}  // namespace prt::test
