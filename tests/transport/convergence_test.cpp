// How fast the bake's error falls with its rays, over many seeds (B1).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "prt/base/random.h"
#include "prt/basis/sh.h"
#include "prt/basis/zonal.h"
#include "prt/math/frame.h"
#include "prt/math/sampling.h"
#include "prt/scene/procedural.h"
#include "prt/trace/ray_scene.h"
#include "prt/transport/gather.h"
#include "tests/support/scenes.h"

namespace prt {
namespace {

using test::assembleScene;
using test::makePatch;

constexpr int kSeedCount = 128;
constexpr std::array kSampleCounts = {64, 256, 1024, 4096, 16384};
const Vec3f kNormal = Vec3f(0.48f, 0.6f, 0.64f);

/// The gather of the patch's first vertex and of nothing else in the scene.
class PatchGather {
  public:
    explicit PatchGather(const Scene& scene)
        : scene_(scene), rays_(scene), receivers_(placeReceivers(scene, rays_)) {}

    std::vector<float> gather(int sampleCount, std::uint64_t seed) const {
        const auto count = static_cast<std::size_t>(sampleCount);
        const SamplePattern pattern(count);
        const GatherScene gatherScene{scene_, rays_, receivers_};
        Gatherer gatherer(gatherScene, kernels_, pattern, {3, count, seed, false});
        std::vector<float> transfer(9);
        HitSlab noHits;
        gatherer.gather(receivers_.frontOfVertex[0], transfer, noHits);
        return transfer;
    }

    const RayScene& rays() const { return rays_; }

  private:
    const Scene& scene_;
    RayScene rays_;
    Receivers receivers_;
    GatherKernels kernels_ = selectGatherKernels(detectIsa());
};

/// Root mean square over seeds and coefficients of what a sampler misses the truth by.
template <class Estimate>
double rmsError(const std::vector<double>& truth, const Estimate& estimate) {
    double sum = 0.0;
    for (std::uint64_t seed = 1; seed <= kSeedCount; ++seed) {
        const std::vector<float> transfer = estimate(seed);
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const double difference = static_cast<double>(transfer[i]) - truth[i];
            sum += difference * difference;
        }
    }
    return std::sqrt(sum / (kSeedCount * static_cast<double>(truth.size())));
}

/// Slope of log error over log sample count, by least squares.
double convergenceSlope(const PatchGather& patch, const std::vector<double>& truth) {
    double sumX = 0.0, sumY = 0.0, sumXx = 0.0, sumXy = 0.0;
    for (const int sampleCount : kSampleCounts) {
        const double x = std::log(sampleCount);
        const double y = std::log(
            rmsError(truth, [&](std::uint64_t seed) { return patch.gather(sampleCount, seed); }));
        sumX += x;
        sumY += y;
        sumXx += x * x;
        sumXy += x * y;
    }
    const auto n = static_cast<double>(kSampleCounts.size());
    return (n * sumXy - sumX * sumY) / (n * sumXx - sumX * sumX);
}

/// A ball above the patch, aside of its normal.
Scene makeOccludedPatch() {
    return assembleScene(
        {{makePatch({0, 0, 0}, kNormal, 1e-3f)}, {makeSphere(Vec3f(0.2f, 1.4f, 1.0f), 0.8f, 48)}});
}

std::vector<double> gatherTruth(const PatchGather& patch) {
    constexpr std::uint64_t kTruthSeeds = 32;
    std::vector<double> mean(9);
    for (std::uint64_t seed = 0; seed < kTruthSeeds; ++seed) {
        const std::vector<float> transfer = patch.gather(65536, 1000 + seed);
        for (std::size_t i = 0; i < mean.size(); ++i)
            mean[i] += static_cast<double>(transfer[i]) / static_cast<double>(kTruthSeeds);
    }
    return mean;
}

/// The same estimate from independent random numbers, as a yardstick.
std::vector<float> estimatePlainly(const RayScene& rays, int sampleCount, std::uint64_t seed) {
    RandomStream random(seed, 0);
    std::vector<double> sums(9);
    std::vector<double> values(9);
    for (int i = 0; i < sampleCount; ++i) {
        const float u = unitFloatFromBits(random.nextBits());
        const Vec3f direction = frameFromNormal(kNormal).worldFromLocal(
            sampleCosineHemisphere(u, unitFloatFromBits(random.nextBits())));
        if (rays.isOccluded({kNormal * 1e-4f, direction})) continue;
        evaluateSh(Vec3d(direction), 3, values);
        for (std::size_t k = 0; k < 9; ++k)
            sums[k] += values[k] / sampleCount;
    }
    return {sums.begin(), sums.end()};
}

TEST(Convergence, WithoutOcclusionErrorFallsFasterThanOneOverTheRays) {
    const Scene scene = assembleScene({{makePatch({0, 0, 0}, kNormal, 1e-3f)}});
    std::vector<float> closedForm(9);
    unshadowedTransfer(kNormal, 3, closedForm);
    EXPECT_LE(convergenceSlope(PatchGather(scene), {closedForm.begin(), closedForm.end()}), -1.30);
}

TEST(Convergence, WithOcclusionErrorFallsFasterThanRandomNumbersWould) {
    const Scene scene = makeOccludedPatch();
    const PatchGather patch(scene);
    const std::vector<double> truth = gatherTruth(patch);
    EXPECT_LE(convergenceSlope(patch, truth), -0.70);

    const auto random = [&](int sampleCount) {
        return rmsError(truth, [&](std::uint64_t seed) {
            return estimatePlainly(patch.rays(), sampleCount, seed);
        });
    };
    const double ours =
        rmsError(truth, [&](std::uint64_t seed) { return patch.gather(1024, seed); });
    EXPECT_GE(random(1024), 4.0 * ours);
    // The yardstick itself: error of independent numbers falls as 1/√N.
    EXPECT_NEAR(std::log(random(1024) / random(64)) / std::log(16.0), -0.5, 0.05);
}

}  // namespace
}  // namespace prt
