// The baker against a path tracer that shares the scene and the rays with it, and nothing of its
// integration: vertex by vertex and coefficient by coefficient, and over all vertices (B3).
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "prt/basis/sh.h"
#include "prt/render/path_tracer.h"
#include "prt/scene/procedural.h"
#include "prt/transport/bake.h"
#include "prt/transport/receivers.h"
#include "tests/support/chi_square.h"
#include "tests/support/scenes.h"

namespace prt {
namespace {

using test::makeFurnishedRoom;

constexpr int kBandCount = 3;
constexpr std::size_t kRowSize = 3 * shCoefficientCount(kBandCount);
constexpr int kPathCount = 4096;

/// Mean over several bakes, each from other random numbers, and the variance of that mean.
struct BakedTransfer {
    std::vector<double> mean = {};
    std::vector<double> variance = {};
};

BakedTransfer bakeManyTimes(const Scene& scene, int bounceCount) {
    constexpr int kBakeCount = 16;
    BakedTransfer baked;
    for (int i = 0; i < kBakeCount; ++i) {
        BakeOptions options;
        options.bandCount = kBandCount;
        options.sampleCount = 2048;
        options.bounceCount = bounceCount;
        options.seed = 100 + static_cast<std::uint64_t>(i);
        const TransferField field = bakeTransfer(scene, options);
        const std::vector<float> coefficients =
            copyRows<float>(field.findLayer(Transport::interreflected)->coefficients);
        baked.mean.resize(field.receiverCount * kRowSize);
        baked.variance.resize(baked.mean.size());
        for (std::size_t k = 0; k < baked.mean.size(); ++k) {
            const auto value = static_cast<double>(coefficients[k]);
            baked.mean[k] += value / kBakeCount;
            baked.variance[k] += value * value / kBakeCount;
        }
    }
    for (std::size_t k = 0; k < baked.mean.size(); ++k)
        baked.variance[k] = (baked.variance[k] - baked.mean[k] * baked.mean[k]) / (kBakeCount - 1);
    return baked;
}

std::vector<PathOrigin> originsOf(const std::vector<Receiver>& receivers) {
    std::vector<PathOrigin> origins;
    for (const Receiver& receiver : receivers)
        origins.push_back({receiver.origin, receiver.normal});
    return origins;
}

std::vector<PathOrigin> originsOfVertices(const std::vector<Receiver>& receivers,
                                          const std::vector<std::uint32_t>& receiverOfVertex) {
    std::vector<PathOrigin> origins;
    for (const std::uint32_t receiver : receiverOfVertex)
        origins.push_back({receivers[receiver].origin, receivers[receiver].normal});
    return origins;
}

TransferEstimate tracePaths(const Scene& scene, int bounceCount) {
    const RayScene rays(scene);
    const Receivers receivers = placeReceivers(scene, rays);
    const std::vector<PathOrigin> fronts =
        originsOfVertices(receivers.fronts, receivers.frontOfVertex);
    const std::vector<PathOrigin> backs =
        originsOfVertices(receivers.backs, receivers.frontOfVertex);
    PathTracerOptions options;
    options.seed = 3;
    options.walk.bounceCount = bounceCount == kInfiniteBounces ? kUnlimitedBounces : bounceCount;
    options.walk.vertexFronts = fronts;
    options.walk.vertexBacks = backs;
    return estimateTransfer(scene, rays, kBandCount, originsOf(receivers.fronts), kPathCount,
                            options);
}

class BakerAgainstPathTracer : public testing::TestWithParam<int> {};

TEST_P(BakerAgainstPathTracer, EveryVertexAndCoefficientAgrees) {
    const Scene scene = makeFurnishedRoom();
    const BakedTransfer baked = bakeManyTimes(scene, GetParam());
    const TransferEstimate traced = tracePaths(scene, GetParam());
    ASSERT_EQ(baked.mean.size(), traced.mean.size());

    // One in a hundred runs would have a |z| above this among so many (Šidák).
    constexpr double kLargestZ = 4.7;
    std::size_t acceptedCount = 0, testCount = 0;
    for (std::size_t k = 0; k < kRowSize; ++k) {
        double sum = 0.0, squareSum = 0.0;
        double count = 0.0;
        for (std::size_t i = k; i < baked.mean.size(); i += kRowSize) {
            const double variance = baked.variance[i] + traced.variance[i];
            if (variance == 0.0) {  // no path comes to anything
                EXPECT_EQ(baked.mean[i], traced.mean[i]);
                continue;
            }
            const double z = (baked.mean[i] - traced.mean[i]) / std::sqrt(variance);
            acceptedCount += std::abs(z) <= kLargestZ ? 1 : 0;
            ++testCount;
            sum += z;
            squareSum += z * z;
            count += 1.0;
        }
        // What no single vertex shows, all of them do: a common shift, or a wrong spread.
        EXPECT_LE(std::abs(sum), 4.5 * std::sqrt(count)) << "coefficient " << k;
        const auto [low, high] = test::chiSquareBand(count);
        EXPECT_GE(squareSum, low) << "coefficient " << k;
        EXPECT_LE(squareSum, high) << "coefficient " << k;
    }
    EXPECT_GE(static_cast<double>(acceptedCount), 0.9975 * static_cast<double>(testCount));
}

INSTANTIATE_TEST_SUITE_P(Bounces, BakerAgainstPathTracer, testing::Values(0, 1, kInfiniteBounces));

}  // namespace
}  // namespace prt
