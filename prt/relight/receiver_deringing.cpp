// Bibliography
//   [Sloan17]  Deringing spherical harmonics
#include "prt/relight/receiver_deringing.h"

#include <algorithm>
#include <span>

#include "prt/base/assert.h"

namespace prt {
namespace {

/// Receivers are judged in parts of as many, so that their bands take little memory.
constexpr std::size_t kPartSize = kRelightPartSize;

/// The lighting as one light a band, each without the others.
std::vector<Lighting> splitBands(const Lighting& lighting) {
    std::vector<Lighting> bands;
    for (int l = 0; l < lighting.bandCount; ++l) {
        Lighting band(l + 1);
        for (int i = shCoefficientCount(l); i < shCoefficientCount(l + 1); ++i)
            band.coefficients[static_cast<std::size_t>(i)] =
                lighting.coefficients[static_cast<std::size_t>(i)];
        bands.push_back(band);
    }
    return bands;
}

/// The first λ from the given one on that is enough for every receiver, one after the other.
///
/// @param bands      the light, split
/// @param allowance  by how much each channel may be negative
double raiseLambda(const Relighter& relighter, std::span<const Lighting> bands,
                   const Vec3d& allowance, double lambda) {
    std::vector<std::vector<Vec3f>> radiance(bands.size());
    std::vector<double> bandRadiance(bands.size());
    for (std::size_t begin = 0; begin < relighter.receiverCount(); begin += kPartSize) {
        const std::size_t count = std::min(kPartSize, relighter.receiverCount() - begin);
        for (std::size_t l = 0; l < bands.size(); ++l) {
            radiance[l].resize(count);
            relighter.relight(bands[l], begin, radiance[l]);
        }
        for (std::size_t receiver = 0; receiver < count; ++receiver) {
            for (int channel = 0; channel < 3; ++channel) {
                for (std::size_t l = 0; l < bands.size(); ++l)
                    bandRadiance[l] = static_cast<double>(radiance[l][receiver][channel]);
                bandRadiance[0] += allowance[channel];
                if (bands[0].coefficients[0][channel] > 0.0 && bandRadiance[0] > 0.0)
                    lambda = findLeastLambda(bandRadiance, lambda);
            }
        }
    }
    return lambda;
}

}  // namespace

std::vector<double> deringingFactors(const Relighter& relighter, const Lighting& lighting,
                                     const ReceiverDeringingOptions& options) {
    PRT_ASSERT(lighting.bandCount >= 1, "there is at least one band");
    PRT_ASSERT(options.tolerance >= 0.0, "what is allowed is not negative");
    constexpr double kY00 = 0.28209479177387814;  // 1 / (2 sqrt(pi))
    const Vec3d allowance = lighting.coefficients[0] * (kY00 * options.tolerance);

    // Smoothing for one receiver may turn another negative; so judge all of them once more.
    const std::vector<Lighting> bands = splitBands(lighting);
    constexpr int kMaxRoundCount = 100;
    double lambda = 0.0;
    for (int round = 0; round < kMaxRoundCount; ++round) {
        const double last = lambda;
        lambda = raiseLambda(relighter, bands, allowance, lambda);
        if (lambda == last) break;
    }
    return laplacianFactors(lambda, lighting.bandCount);
}

}  // namespace prt
