#include "prt/relight/receiver_transfer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "prt/base/error.h"
#include "prt/base/random.h"
#include "prt/relight/relighter.h"
#include "tests/support/clustered_layers.h"

namespace prt {
namespace {

constexpr int kBandCount = 4;
constexpr std::size_t kReceiverCount = 70;

/// Of sums of some hundred products in float, each of at most 1.
constexpr double kRounding = 2e-5;

constexpr std::array kEncodings = {TransferEncoding::float32, TransferEncoding::unorm16,
                                   TransferEncoding::unorm8};

/// A layer in each form in which it can be stored.
std::vector<CompressedTransfer> makeForms(Transport transport) {
    std::vector<CompressedTransfer> forms;
    for (const TransferEncoding encoding : kEncodings) {
        RandomStream random(3, 5);
        CompressedLayer layer = test::makeLayerKind(transport, kBandCount);
        layer.table = test::makeRandomTable(encoding, kReceiverCount,
                                            coefficientsPerReceiver(kBandCount, layer), random);
        forms.push_back({kBandCount, kReceiverCount, {}, {layer}});
        forms.push_back({kBandCount,
                         kReceiverCount,
                         {},
                         {test::makeClusteredLayer(transport, kBandCount, kReceiverCount,
                                                   {.weights = encoding})}});
    }
    return forms;
}

Lighting makeRandomLighting(int bandCount) {
    RandomStream random(8, 2);
    Lighting lighting(bandCount);
    for (Vec3d& coefficient : lighting.coefficients)
        for (int channel = 0; channel < 3; ++channel)
            coefficient[channel] = 2.0 * random.nextUnitDouble() - 1.0;
    return lighting;
}

Vec3d sumProducts(const Lighting& transfer, const Lighting& lighting) {
    Vec3d sum(0.0);
    for (std::size_t i = 0; i < lighting.coefficients.size(); ++i)
        sum += transfer.coefficients[i] * lighting.coefficients[i];
    return sum;
}

TEST(ReceiverTransfer, OfVectorsRelightsAsTheLayerDoesInEveryForm) {
    const Lighting lighting = makeRandomLighting(kBandCount);
    int checkCount = 0;
    for (const Transport transport : {Transport::shadowed, Transport::interreflected}) {
        for (const CompressedTransfer& transfer : makeForms(transport)) {
            std::vector<Vec3f> radiance(kReceiverCount);
            Relighter(transfer, transport).relight(lighting, radiance);
            for (const std::size_t receiver : {0, 1, 37, 69}) {
                const Lighting expanded = expandReceiver(transfer, transport, receiver);
                const Vec3d difference =
                    sumProducts(expanded, lighting) - Vec3d(radiance[receiver]);
                EXPECT_LT(difference.length(), kRounding) << receiver;
                ++checkCount;
            }
        }
    }
    EXPECT_EQ(checkCount, 2 * 6 * 4);
}

TEST(ReceiverTransfer, OfMatricesIsThatOfTheOpenPlaneBehindThem) {
    constexpr std::array<double, 3> kOpenPlane = {0.282094792, 0.325735008, 0.157695783};  // (C6)
    constexpr std::size_t kReceiver = 41;
    const auto columnCount = static_cast<std::size_t>(shCoefficientCount(kBandCount));
    for (const Transport transport : {Transport::glossyShadowed, Transport::glossy}) {
        for (const CompressedTransfer& transfer : makeForms(transport)) {
            const CompressedLayer& layer = transfer.layers.front();
            const std::vector<float> all = expandLayer(layer);
            const Lighting expanded = expandReceiver(transfer, transport, kReceiver);
            for (int color = 0; color < 3; ++color) {
                const auto rowCount =
                    static_cast<std::size_t>(shCoefficientCount(layer.incidentBandCount));
                const auto channelCount = static_cast<std::size_t>(layer.channelCount);
                const std::size_t channel =
                    kReceiver * channelCount + (channelCount == 3 ? std::size_t(color) : 0);
                for (std::size_t j = 0; j < columnCount; ++j) {
                    double expected = 0.0;
                    for (int l = 0; l < layer.incidentBandCount; ++l) {
                        const std::size_t row =
                            channel * rowCount + static_cast<std::size_t>(shIndex(l, 0));
                        expected += kOpenPlane[static_cast<std::size_t>(l)] *
                                    static_cast<double>(all[row * columnCount + j]);
                    }
                    EXPECT_NEAR(expanded.coefficients[j][color], expected, kRounding);
                }
            }
        }
    }
}

TEST(ReceiverTransfer, TowardsAnEyeIsWhatTheReceiverSends) {
    const Vec3f baseColor(0.9f, 0.5f, 0.2f), eye(0.5f, 2.0f, 3.0f);
    const Lighting lighting = makeRandomLighting(kBandCount);
    RandomStream random(4, 4);
    std::vector<ReceiverSurface> receivers(kReceiverCount);
    for (ReceiverSurface& receiver : receivers)
        receiver.surface = {random.nextUnitFloat(), 0.3f + 0.7f * random.nextUnitFloat()};
    for (const CompressedTransfer& transfer : makeForms(Transport::glossy)) {
        const GltfViewTable views({.bandCount = transfer.layers.front().incidentBandCount,
                                   .levelCount = 4,
                                   .viewCount = 4});
        const GlossyRelighter relighter(transfer, Transport::glossy, receivers, views);
        std::vector<ExitRadiance> radiance(kReceiverCount);
        relighter.relight(lighting, eye, 0, radiance);
        for (const std::size_t receiver : {0, 1, 37, 69}) {
            const Vec3d sent(baseColor * radiance[receiver].perBaseColor +
                             radiance[receiver].constant);
            const Lighting expanded = expandReceiver(relighter, eye, receiver, baseColor);
            EXPECT_LT((sumProducts(expanded, lighting) - sent).length(), kRounding) << receiver;
            EXPECT_GT(sent.length(), 100.0 * kRounding) << receiver;
        }
    }
}

TEST(ReceiverTransfer, OfALayerThatIsMissingIsRefused) {
    const CompressedTransfer transfer = makeForms(Transport::shadowed).front();
    EXPECT_THROW(expandReceiver(transfer, Transport::glossy, 0), Error);
}

}  // namespace
}  // namespace prt
