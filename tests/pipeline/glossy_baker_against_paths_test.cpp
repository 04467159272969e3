// Transfer matrices against random walks under the same bands: the light is band-limited and so is
// every BRDF, f(ω_i, ω_o) cos θ_i = Σ f_i(ω_o) y_i(ω_i), and nothing but noise may differ. The
// walks share the scene, the rays and the BRDFs' coefficients with the baker, and none of its
// integration.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "prt/base/random.h"
#include "prt/basis/sh.h"
#include "prt/math/frame.h"
#include "prt/math/sampling.h"
#include "prt/scene/procedural.h"
#include "prt/transport/receivers.h"
#include "prt/transport/transfer_matrices.h"
#include "tests/support/chi_square.h"
#include "tests/support/scenes.h"

namespace prt {
namespace {

constexpr int kIncidentBandCount = 3;
constexpr int kBandCount = 3;
constexpr std::size_t kRowCount = shCoefficientCount(kIncidentBandCount);
constexpr std::size_t kColumnCount = shCoefficientCount(kBandCount);
constexpr std::size_t kPathCount = 8192;
constexpr int kBakeCount = 16;

/// A floor and a wall with lobes, a metal sheet and a metal ball.
Scene makeGlossyRoom() {
    Scene scene = test::makeFurnishedRoom();
    for (const auto& [material, metallic, roughness] :
         {std::tuple(0u, 0.0f, 0.4f), std::tuple(1u, 0.5f, 0.6f), std::tuple(3u, 1.0f, 0.5f),
          std::tuple(4u, 1.0f, 0.3f)}) {
        scene.materials[material].metallicFactor = metallic;
        scene.materials[material].roughnessFactor = roughness;
    }
    return scene;
}

/// One channel's light in bands, and a lobe that each receiver reflects it by.
std::array<double, kColumnCount> makeLight() {
    return {1.0, 0.4, -0.3, 0.5, 0.2, -0.25, 0.3, 0.1, -0.2};
}
std::array<double, kRowCount> makeLobe() {
    return {0.3, 0.1, 0.45, -0.1, 0.05, 0.1, 0.2, -0.15, 0.1};
}

double evaluateBands(std::span<const double> coefficients, int bandCount, const Vec3f& direction) {
    return reconstructSh(std::vector<double>(coefficients.begin(), coefficients.end()), bandCount,
                         Vec3d(direction).normalized());
}

/// Means of what receivers reflect, [receiver][channel], and behind them of the sum over receivers:
/// bounces bring the noise of one receiver to many, so its variance does not follow from theirs.
struct Estimate {
    std::vector<double> mean{};
    std::vector<double> variance{};  ///< of the mean
    std::size_t sampleCount = 0;

    /// @param exits  of all receivers
    void add(std::vector<double> exits) {
        const std::size_t size = exits.size();
        exits.resize(size + 3);
        for (std::size_t k = 0; k < size; ++k)
            exits[size + k % 3] += exits[k];
        mean.resize(exits.size());
        variance.resize(exits.size());
        for (std::size_t k = 0; k < exits.size(); ++k) {
            mean[k] += exits[k];
            variance[k] += exits[k] * exits[k];
        }
        ++sampleCount;
    }

    void finish() {
        const auto count = static_cast<double>(sampleCount);
        for (std::size_t k = 0; k < mean.size(); ++k) {
            mean[k] /= count;
            variance[k] = (variance[k] / count - mean[k] * mean[k]) / (count - 1.0);
        }
    }
};

Estimate bakeManyTimes(const Scene& scene, const SurfaceReflection& reflection, int bounceCount) {
    const auto light = makeLight();
    const auto lobe = makeLobe();
    Estimate estimate;
    for (int i = 0; i < kBakeCount; ++i) {
        const TransferMatrices baked =
            bakeTransferMatrices(scene, {.incidentBandCount = kIncidentBandCount,
                                         .bandCount = kBandCount,
                                         .bounceCount = bounceCount,
                                         .reflection = reflection,
                                         .seed = 100 + static_cast<std::uint64_t>(i)});
        const std::size_t receiverCount = baked.matrices.rowCount();
        std::vector<double> exits(3 * receiverCount);
        std::vector<float> matrix(baked.matrices.columnCount());
        for (std::size_t receiver = 0; receiver < receiverCount; ++receiver) {
            baked.matrices.readRow(receiver, std::span(matrix));
            for (std::size_t channel = 0; channel < 3; ++channel)
                for (std::size_t e = 0; e < kRowCount * kColumnCount; ++e)
                    exits[3 * receiver + channel] +=
                        lobe[e / kColumnCount] * light[e % kColumnCount] *
                        static_cast<double>(
                            matrix[(channel * kRowCount * kColumnCount + e) % matrix.size()]);
        }
        estimate.add(std::move(exits));
    }
    estimate.finish();
    return estimate;
}

/// Walks from receiver to receiver in directions uniform over their hemispheres.
class BandLimitedWalks {
  public:
    BandLimitedWalks(const Scene& scene, const SurfaceReflection& reflection, int bounceCount)
        : scene_(scene),
          rays_(scene),
          receivers_(placeReceivers(scene, rays_)),
          offsets_(vertexOffsets(scene)),
          reflection_(reflection),
          bounceCount_(bounceCount) {}

    Estimate walk() const {
        std::vector<std::vector<double>> exits(kPathCount);
        for (std::size_t receiver = 0; receiver < receivers_.fronts.size(); ++receiver) {
            const std::vector<Vec3d> ofPaths = walkFrom(receiver);
            for (std::size_t path = 0; path < kPathCount; ++path)
                for (int channel = 0; channel < 3; ++channel)
                    exits[path].push_back(ofPaths[path][channel]);
        }
        Estimate estimate;
        for (std::vector<double>& ofReceivers : exits)
            estimate.add(std::move(ofReceivers));
        estimate.finish();
        return estimate;
    }

  private:
    struct Walker {
        const Receiver* site;
        std::array<double, 3 * kRowCount> response;  // of the site, back along the path
        Vec3d weight{1.0};
        Vec3d exit{0.0};
        bool isDone = false;
    };

    std::vector<Vec3d> walkFrom(std::size_t receiver) const {
        RandomStream random(7, receiver);
        std::vector<Walker> walkers(kPathCount);
        for (Walker& walker : walkers) {
            walker.site = &receivers_.fronts[receiver];
            const auto lobe = makeLobe();
            for (std::size_t k = 0; k < walker.response.size(); ++k)
                walker.response[k] = lobe[k % kRowCount];
        }
        for (int bounce = 0; bounce <= bounceCount_; ++bounce)
            step(walkers, bounce == bounceCount_, random);
        std::vector<Vec3d> exits;
        for (const Walker& walker : walkers)
            exits.push_back(walker.exit);
        return exits;
    }

    void step(std::vector<Walker>& walkers, bool isLast, RandomStream& random) const {
        RayStream stream(walkers.size());
        for (std::size_t i = 0; i < walkers.size(); ++i) {
            Walker& walker = walkers[i];
            const float u = random.nextUnitFloat();
            const Vec3f local = sampleUniformHemisphere(u, random.nextUnitFloat());
            for (std::size_t channel = 0; channel < 3; ++channel)
                walker.weight[static_cast<int>(channel)] *=
                    2.0 * std::numbers::pi *
                    evaluateBands(
                        std::span(walker.response).subspan(channel * kRowCount, kRowCount),
                        kIncidentBandCount, local);
            stream.setRay(i, walker.site->origin,
                          frameFromNormal(walker.site->normal).worldFromLocal(local));
        }
        std::vector<std::uint32_t> all(walkers.size());
        std::iota(all.begin(), all.end(), 0u);
        std::vector<Hit> hits(walkers.size());
        rays_.findClosest(stream, all, hits);
        const auto light = makeLight();
        for (std::size_t i = 0; i < walkers.size(); ++i) {
            const Vec3f direction(stream.directionX[i], stream.directionY[i], stream.directionZ[i]);
            if (!walkers[i].isDone && hits[i].escaped)
                walkers[i].exit = walkers[i].weight * evaluateBands(light, kBandCount, direction);
            walkers[i].isDone |=
                hits[i].escaped || isLast || !arrive(walkers[i], hits[i], direction, random);
        }
    }

    /// Goes on from a corner of the triangle; false from a back that reflects nothing.
    bool arrive(Walker& walker, const Hit& hit, const Vec3f& direction,
                RandomStream& random) const {
        const Mesh& mesh = scene_.meshes[hit.point.mesh];
        if (hit.backFace && !scene_.materials[mesh.material].doubleSided) return false;
        const float choice = random.nextUnitFloat();
        const std::size_t corner = choice < hit.point.u                 ? 1
                                   : choice < hit.point.u + hit.point.v ? 2
                                                                        : 0;
        const std::uint32_t front =
            receivers_.frontOfVertex[offsets_[hit.point.mesh] +
                                     mesh.indices[3 * hit.point.triangle + corner]];
        walker.site = hit.backFace ? &receivers_.backs[front] : &receivers_.fronts[front];
        std::array<float, 3 * kRowCount> response{};
        reflection_(hit.point, frameFromNormal(walker.site->normal).localFromWorld(-direction),
                    response);
        std::copy(response.begin(), response.end(), walker.response.begin());
        return true;
    }

    const Scene& scene_;
    RayScene rays_;
    Receivers receivers_;
    std::vector<std::size_t> offsets_;
    const SurfaceReflection& reflection_;
    int bounceCount_;
};

class GlossyBakerAgainstPaths : public testing::TestWithParam<int> {};

TEST_P(GlossyBakerAgainstPaths, EveryReceiverReflectsTheSame) {
    const Scene scene = makeGlossyRoom();
    const auto table = std::make_shared<GltfViewTable>(
        GltfViewTableOptions{.bandCount = kIncidentBandCount,
                             .levelCount = 11,
                             .quadrature = {.polarNodeCount = 32, .azimuthNodeCount = 16}});
    const SurfaceReflection reflection = gltfReflection(scene, table);
    const Estimate baked = bakeManyTimes(scene, reflection, GetParam());
    const Estimate walked = BandLimitedWalks(scene, reflection, GetParam()).walk();
    ASSERT_EQ(baked.mean.size(), walked.mean.size());
    const std::size_t size = baked.mean.size() - 3;
    const auto measureZ = [&](std::size_t k) {
        const double difference = baked.mean[k] - walked.mean[k];
        const double variance = baked.variance[k] + walked.variance[k];
        return variance > 0.0 ? difference / std::sqrt(variance) : difference;  // nothing comes in
    };
    for (std::size_t channel = 0; channel < 3; ++channel) {
        double squareSum = 0.0, count = 0.0, largest = 0.0;
        for (std::size_t k = channel; k < size; k += 3) {
            const double z = measureZ(k);
            squareSum += z * z;
            largest = std::max(largest, std::abs(z));
            count += z != 0.0 ? 1.0 : 0.0;
        }
        EXPECT_GT(count, 60.0);
        // Once in some ten thousand runs each; of so few bakes Student's distribution is wide.
        EXPECT_LE(largest, 5.5) << "channel " << channel;
        EXPECT_LE(std::abs(measureZ(size + channel)), 5.0) << "channel " << channel;
        const auto [low, high] = test::chiSquareBand(count);
        EXPECT_GE(squareSum, low) << "channel " << channel;
        EXPECT_LE(squareSum, high) << "channel " << channel;
    }
}

INSTANTIATE_TEST_SUITE_P(Bounces, GlossyBakerAgainstPaths, testing::Values(0, 1, 2));

}  // namespace
}  // namespace prt
