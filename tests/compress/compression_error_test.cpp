#include "prt/compress/compression_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "prt/basis/sh.h"
#include "prt/basis/sh_rotation.h"
#include "prt/compress/compress_transfer.h"
#include "prt/math/quadrature.h"
#include "prt/math/transform.h"
#include "tests/support/sample_vectors.h"

namespace prt {
namespace {

constexpr int kBandCount = 3;
constexpr std::size_t kCoefficientCount = 9;

/// Transfer of receivers that mostly see the light, with columns of different size as bands have.
TransferField makeField(int channelCount, std::size_t receiverCount) {
    TransferField field;
    field.bandCount = kBandCount;
    field.receiverCount = receiverCount;
    const std::size_t rowLength = coefficientsPerReceiver(kBandCount, channelCount);
    std::vector<float> rows = makeClouds({.count = receiverCount,
                                          .dimension = rowLength,
                                          .cloudCount = 10,
                                          .subspaceDimension = 3,
                                          .spread = 1.0,
                                          .noise = 0.3});
    for (std::size_t i = 0; i < rows.size(); i += kCoefficientCount)
        rows[i] += 10.0f;
    field.layers = {{Transport::shadowed, channelCount, makeTable(rowLength, rows)}};
    return field;
}

/// Light that comes mostly from the lowest bands.
std::vector<Vec3d> makeLight() {
    RandomStream random(5, 6);
    std::vector<Vec3d> light;
    for (int l = 0; l < kBandCount; ++l)
        for (int m = -l; m <= l; ++m) {
            const double size = std::pow(10.0, -l);
            light.emplace_back(size * drawNormal(random), size * drawNormal(random),
                               size * drawNormal(random));
        }
    light[0] = {3.0, 2.0, 1.0};
    return light;
}

CompressedTransfer compressTo(const TransferField& field, std::size_t componentCount,
                              const std::vector<Vec3d>& light = {}) {
    CompressOptions options{.encoding = TransferEncoding::unorm8};
    options.clusters = {.clusterCount = 10, .componentCount = componentCount, .light = light};
    return compressTransfer(field, options);
}

/// What the vectors give under a light turned to many sides, [rotation][receiver and channel]; by a
/// rule that integrates squares of it exactly.
struct TurnedRadiance {
    std::vector<double> weights;  ///< of the rotations, sum 1
    std::vector<std::vector<double>> radiance;
};

TurnedRadiance relightTurned(const std::vector<float>& rows, const std::vector<Vec3d>& light,
                             std::size_t channelCount) {
    const int turnCount = 4 * kBandCount;
    TurnedRadiance result;
    for (const QuadratureNode& node : gaussLegendre(2 * kBandCount))
        for (int i = 0; i < turnCount * turnCount; ++i) {
            const double step = 2.0 * std::numbers::pi / turnCount;
            const Mat3d rotation = rotationZ(step * (i / turnCount)) *
                                   rotationY(std::acos(node.position)) *
                                   rotationZ(step * (i % turnCount));
            result.weights.push_back(node.weight / (2.0 * turnCount * turnCount));
            std::vector<double>& radiance = result.radiance.emplace_back();
            for (int channel = 0; channel < 3; ++channel) {
                std::vector<double> own, turned(light.size());
                for (const Vec3d& coefficient : light)
                    own.push_back(coefficient[channel]);
                rotateSh(rotation, kBandCount, std::span<const double>(own), std::span(turned));
                const std::size_t first =
                    channelCount == 3 ? static_cast<std::size_t>(channel) * kCoefficientCount : 0;
                for (std::size_t row = 0; row < rows.size();
                     row += channelCount * kCoefficientCount) {
                    double sum = 0.0;
                    for (std::size_t j = 0; j < kCoefficientCount; ++j)
                        sum += rows[row + first + j] * turned[j];
                    radiance.push_back(sum);
                }
            }
        }
    return result;
}

TEST(CompressionError, AsSeenIsThatOfTheRadianceUnderTheLightTurnedAtRandom) {
    constexpr double kTolerance = 1e-6;  // of the error: weights are floats
    const std::vector<Vec3d> light = makeLight();
    for (const int channelCount : {1, 3}) {
        const TransferField field = makeField(channelCount, 60);
        const CompressedTransfer compressed = compressTo(field, 2);
        const auto channels = static_cast<std::size_t>(channelCount);
        const TurnedRadiance stored =
            relightTurned(expandLayer(compressed.layers[0]), light, channels);
        const TurnedRadiance truth =
            relightTurned(copyRows<float>(field.layers[0].coefficients), light, channels);
        double squares = 0.0, mean = 0.0;
        for (std::size_t r = 0; r < truth.weights.size(); ++r)
            for (std::size_t i = 0; i < truth.radiance[r].size(); ++i) {
                const double share =
                    truth.weights[r] / static_cast<double>(truth.radiance[r].size());
                squares += share * std::pow(stored.radiance[r][i] - truth.radiance[r][i], 2.0);
                mean += share * truth.radiance[r][i];
            }
        const double expected = std::sqrt(squares) / mean;
        EXPECT_GT(expected, 1e-3);
        EXPECT_NEAR(measureCompressionError(compressed.layers[0], field.layers[0], light).seen,
                    expected, kTolerance * expected);
        EXPECT_EQ(measureCompressionError(compressed.layers[0], field.layers[0]).seen, 0.0);
    }
}

TEST(CompressionError, IsTheSameAgainstTheFieldAndAgainstItsFloats) {
    const TransferField field = makeField(3, 100);
    const CompressedTransfer compressed = compressTo(field, 3);
    const CompressedTransfer floats =
        compressTransfer(field, {.encoding = TransferEncoding::float32});
    const CompressionError a =
        measureCompressionError(compressed.layers[0], field.layers[0], makeLight());
    const CompressionError b =
        measureCompressionError(compressed.layers[0], floats.layers[0], makeLight());
    EXPECT_EQ(a.rmse, b.rmse);
    EXPECT_EQ(a.relativeRmse, b.relativeRmse);
    EXPECT_EQ(a.largest, b.largest);
    EXPECT_EQ(a.seen, b.seen);
}

TEST(CompressionError, WeighingByALightLowersWhatIsSeenAndRaisesTheRest) {
    const std::vector<Vec3d> light = makeLight();
    for (const int channelCount : {1, 3}) {
        const TransferField field = makeField(channelCount, 2000);
        const auto measure = [&](const CompressedTransfer& compressed) {
            return measureCompressionError(compressed.layers[0], field.layers[0], light);
        };
        const CompressionError plain = measure(compressTo(field, 3));
        const CompressionError weighed = measure(compressTo(field, 3, light));
        EXPECT_LT(weighed.seen, 0.8 * plain.seen);
        EXPECT_GT(weighed.rmse, 1.05 * plain.rmse);
    }
}

TEST(CompressionError, ALayerNamesTheLargestThatReadingBackGives) {
    const TransferField field = makeField(3, 5000);
    const CompressedTransfer compressed = compressTo(field, 2);
    const CompressionError error = measureCompressionError(compressed.layers[0], field.layers[0]);
    EXPECT_GT(error.largest, 0.0);
    EXPECT_EQ(compressed.layers[0].largestError, static_cast<float>(error.largest));
    EXPECT_EQ(compressTransfer(field).layers[0].largestError, 0.0f) << "rounding is not named";
}

}  // namespace
}  // namespace prt
