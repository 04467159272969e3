// Layers of matrices are compressed as those of vectors are; what differs is what is seen.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "prt/basis/sh.h"
#include "prt/basis/sh_rotation.h"
#include "prt/compress/compress_transfer.h"
#include "prt/compress/compression_error.h"
#include "prt/compress/light_error_weights.h"
#include "prt/math/quadrature.h"
#include "prt/math/transform.h"
#include "tests/support/sample_vectors.h"

namespace prt {
namespace {

constexpr int kBandCount = 3;
constexpr int kIncidentBandCount = 2;
constexpr std::size_t kColumnCount = 9;
constexpr std::size_t kRowCount = 4;
constexpr std::size_t kMatrixSize = kRowCount * kColumnCount;

/// Matrices of receivers at which light arrives.
TransferLayer makeLayer(int channelCount, std::size_t receiverCount) {
    TransferLayer layer{channelCount == 1 ? Transport::glossyShadowed : Transport::glossy,
                        channelCount,
                        {},
                        kIncidentBandCount};
    const std::size_t rowLength = coefficientsPerReceiver(kBandCount, layer);
    std::vector<float> rows = makeClouds({.count = receiverCount,
                                          .dimension = rowLength,
                                          .cloudCount = 10,
                                          .subspaceDimension = 3,
                                          .spread = 1.0,
                                          .noise = 0.3});
    for (std::size_t i = 0; i < rows.size(); i += kMatrixSize)
        rows[i] += 10.0f;
    layer.coefficients = makeTable(rowLength, rows);
    return layer;
}

/// Light that comes mostly from the lowest bands.
std::vector<Vec3d> makeLight() {
    RandomStream random(5, 6);
    std::vector<Vec3d> light;
    for (int i = 0; i < shCoefficientCount(kBandCount); ++i) {
        const double size = std::pow(10.0, -shDegree(i));
        light.emplace_back(size * drawNormal(random), size * drawNormal(random),
                           size * drawNormal(random));
    }
    light[0] = {3.0, 2.0, 1.0};
    return light;
}

/// A light of one channel turned to many sides, by a rule that integrates squares exactly.
struct TurnedLight {
    double weight = 0.0;  ///< of all, the sum is 1
    std::vector<double> coefficients;
};

std::vector<TurnedLight> turnLight(const std::vector<Vec3d>& light, int channel) {
    std::vector<double> own;
    for (const Vec3d& coefficient : light)
        own.push_back(coefficient[channel]);
    const int turnCount = 4 * kBandCount;
    std::vector<TurnedLight> turned;
    for (const QuadratureNode& node : gaussLegendre(2 * kBandCount))
        for (int i = 0; i < turnCount * turnCount; ++i) {
            const double step = 2.0 * std::numbers::pi / turnCount;
            const Mat3d rotation = rotationZ(step * (i / turnCount)) *
                                   rotationY(std::acos(node.position)) *
                                   rotationZ(step * (i % turnCount));
            turned.push_back(
                {node.weight / (2.0 * turnCount * turnCount), std::vector<double>(own.size())});
            rotateSh(rotation, kBandCount, std::span<const double>(own),
                     std::span(turned.back().coefficients));
        }
    return turned;
}

/// M L of one matrix.
std::vector<double> receive(const float* matrix, const std::vector<double>& light) {
    std::vector<double> incident(kRowCount);
    for (std::size_t i = 0; i < kRowCount; ++i)
        for (std::size_t j = 0; j < kColumnCount; ++j)
            incident[i] += static_cast<double>(matrix[i * kColumnCount + j]) * light[j];
    return incident;
}

/// ∫ (Σ_i l_i y_i)² dω over the sphere.
double integrateSquare(const std::vector<double>& incident) {
    static const std::vector<SphereNode> nodes = sphereQuadrature(2 * (kIncidentBandCount - 1));
    double sum = 0.0;
    for (const SphereNode& node : nodes) {
        const double radiance = reconstructSh(incident, kIncidentBandCount, node.direction);
        sum += node.weight * radiance * radiance;
    }
    return sum;
}

TEST(MatrixCompression, WhatIsSeenIsTheErrorOfIncidentRadianceUnderTheLightTurnedAtRandom) {
    constexpr double kTolerance = 1e-6;  // of the error: weights are floats
    const std::vector<Vec3d> light = makeLight();
    for (const int channelCount : {1, 3}) {
        const TransferLayer layer = makeLayer(channelCount, 12);
        const CompressedLayer stored =
            compressLayer(layer, kBandCount, {.encoding = TransferEncoding::unorm8});
        const std::vector<float> rows = expandLayer(stored);
        const std::vector<float> truth = copyRows<float>(layer.coefficients);
        std::vector<float> errors;
        for (std::size_t k = 0; k < rows.size(); ++k)
            errors.push_back(rows[k] - truth[k]);

        // All that comes in does so from the hemisphere.
        double square = 0.0, mean = 0.0;
        std::size_t count = 0;
        for (int channel = 0; channel < 3; ++channel)
            for (std::size_t begin = 0; begin < rows.size();
                 begin += static_cast<std::size_t>(channelCount) * kMatrixSize) {
                const std::size_t matrix =
                    begin +
                    (channelCount == 3 ? static_cast<std::size_t>(channel) : 0) * kMatrixSize;
                for (const TurnedLight& turned : turnLight(light, channel)) {
                    const double share = turned.weight / (2.0 * std::numbers::pi);
                    square +=
                        share * integrateSquare(receive(&errors[matrix], turned.coefficients));
                    mean += share * std::sqrt(4.0 * std::numbers::pi) *
                            receive(&truth[matrix], turned.coefficients)[0];
                }
                ++count;
            }
        const auto matrixCount = static_cast<double>(count);
        const double expected = std::sqrt(square / matrixCount) / (mean / matrixCount);
        EXPECT_GT(expected, 1e-4);
        EXPECT_NEAR(measureCompressionError(stored, layer, light).seen, expected,
                    kTolerance * expected);
    }
}

TEST(MatrixCompression, ErrorsWeighAsTheCoefficientOfTheLightThatTheyMeet) {
    const std::vector<Vec3d> light = makeLight();
    for (const int channelCount : {1, 3}) {
        const auto channels = static_cast<std::size_t>(channelCount);
        const std::vector<float> ofVectors =
            weighRows(light, channels * kColumnCount, channelCount, 0);
        const std::vector<float> ofMatrices =
            weighRows(light, channels * kMatrixSize, channelCount, kIncidentBandCount);
        ASSERT_EQ(ofMatrices.size(), channels * kMatrixSize);
        for (std::size_t k = 0; k < ofMatrices.size(); ++k)
            EXPECT_EQ(ofMatrices[k], ofVectors[k / kMatrixSize * kColumnCount + k % kColumnCount]);
    }
    EXPECT_TRUE(weighRows({}, kMatrixSize, 1, kIncidentBandCount).empty());
}

CompressOptions withClusters(std::size_t clusterCount, std::size_t componentCount,
                             const std::vector<Vec3d>& light = {}) {
    CompressOptions options{.encoding = TransferEncoding::unorm8};
    options.clusters = {
        .clusterCount = clusterCount, .componentCount = componentCount, .light = light};
    return options;
}

TEST(MatrixCompression, EveryMethodKeepsTheKindAndTellsItsError) {
    constexpr double kRoughly = 0.7;  // few vectors for clouds in so many dimensions
    CompressOptions ofSize, ofError;
    ofSize.budget = {.bytesPerReceiver = 24.0};
    ofError.budget = {.maxError = 0.02};
    ofError.clusters.emplace().light = makeLight();
    for (const int channelCount : {1, 3}) {
        const TransferLayer layer = makeLayer(channelCount, 700);
        CompressedTransfer transfer{kBandCount, 700, {}, {}};
        for (const CompressOptions& options :
             {CompressOptions{.encoding = TransferEncoding::float32},
              CompressOptions{.encoding = TransferEncoding::unorm16},
              CompressOptions{.encoding = TransferEncoding::unorm8}, withClusters(1, 7),
              withClusters(20, 0), withClusters(10, 3), ofSize, ofError}) {
            const CompressedLayer stored = compressLayer(layer, kBandCount, options);
            EXPECT_EQ(stored.transport, layer.transport);
            EXPECT_EQ(stored.channelCount, channelCount);
            EXPECT_EQ(stored.incidentBandCount, kIncidentBandCount);
            EXPECT_TRUE(isComplete(transfer, stored));
            const CompressionError error = measureCompressionError(stored, layer, makeLight());
            EXPECT_LT(error.relativeRmse, kRoughly);
            EXPECT_EQ(stored.largestError, stored.bases ? static_cast<float>(error.largest) : 0.0f);
            const CompressionBudget budget = options.budget.value_or(CompressionBudget{});
            if (budget.maxError > 0.0) {
                EXPECT_LE(error.seen, budget.maxError);
            }
            if (budget.bytesPerReceiver > 0.0) {
                EXPECT_LE(countBytesPerReceiver(stored), budget.bytesPerReceiver);
            }
            transfer.layers = {stored};
            const TransferField field = expandTransfer(transfer);
            EXPECT_EQ(field.layers[0].incidentBandCount, kIncidentBandCount);
        }
    }
}

// Of one cluster the components are the best for what they are chosen by.
TEST(MatrixCompression, WeighingByALightLowersWhatIsSeenAndRaisesTheRest) {
    const std::vector<Vec3d> light = makeLight();
    const TransferLayer layer = makeLayer(3, 2000);
    const auto measure = [&](const CompressOptions& options) {
        return measureCompressionError(compressLayer(layer, kBandCount, options), layer, light);
    };
    const CompressionError plain = measure(withClusters(1, 6));
    const CompressionError weighed = measure(withClusters(1, 6, light));
    EXPECT_LT(weighed.seen, 0.9 * plain.seen);
    EXPECT_GT(weighed.rmse, 1.02 * plain.rmse);
}

}  // namespace
}  // namespace prt
