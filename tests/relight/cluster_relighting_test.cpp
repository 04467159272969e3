#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <tuple>
#include <vector>

#include "prt/base/random.h"
#include "prt/relight/relighter.h"
#include "tests/support/instruction_sets.h"

namespace prt {
namespace {

constexpr Transport kTransport = Transport::shadowed;

double randomSigned(RandomStream& random) {
    return 2.0 * random.nextUnitDouble() - 1.0;
}

Lighting makeRandomLighting(int bandCount, std::uint64_t seed) {
    RandomStream random(seed, 0);
    Lighting lighting(bandCount);
    for (Vec3d& coefficient : lighting.coefficients)
        coefficient = Vec3d(randomSigned(random), randomSigned(random), randomSigned(random));
    return lighting;
}

/// Numbers that stand for fractions, but for the first of a row with clusters.
template <class Stored>
CoefficientTable makeNumbers(const std::vector<std::uint32_t>& clusters,
                             const std::vector<std::uint32_t>& componentCounts,
                             std::size_t columnCount, double largest, RandomStream& random) {
    std::vector<Stored> rows;
    for (const std::uint32_t k : clusters) {
        rows.push_back(static_cast<Stored>(k));
        for (std::size_t p = 1; p < columnCount; ++p)
            rows.push_back(p <= componentCounts[k]
                               ? static_cast<Stored>(largest * random.nextUnitDouble())
                               : Stored{0});
    }
    return makeTable(columnCount, rows);
}

StoredTable makeBases(TransferEncoding encoding, std::size_t rowCount, std::size_t dimension,
                      RandomStream& random) {
    StoredTable table;
    table.encoding = encoding;
    std::vector<float> floats(rowCount * dimension);
    for (float& value : floats)
        value = static_cast<float>(randomSigned(random));
    if (encoding == TransferEncoding::float32) {
        table.numbers = makeTable(dimension, floats);
        return table;
    }
    std::vector<std::uint16_t> integers;
    for (const float value : floats)
        integers.push_back(static_cast<std::uint16_t>(65535.0f * std::abs(value)));
    table.numbers = makeTable(dimension, integers);
    for (std::size_t i = 0; i < dimension; ++i) {
        table.scale.push_back(random.nextUnitFloat() + 0.5f);
        table.bias.push_back(static_cast<float>(randomSigned(random)));
    }
    return table;
}

struct AssetShape {
    TransferEncoding encoding = TransferEncoding::unorm8;
    int channelCount = 1;
    int bandCount = 4;
    std::size_t receiverCount = 0;
    std::vector<std::uint32_t> componentCounts{};
    TransferEncoding basesEncoding = TransferEncoding::float32;
};

CompressedTransfer makeTransfer(const AssetShape& shape,
                                const std::vector<std::uint32_t>& clusters) {
    RandomStream random(20260102, shape.receiverCount);
    CompressedTransfer transfer;
    transfer.bandCount = shape.bandCount;
    transfer.receiverCount = shape.receiverCount;
    CompressedLayer layer;
    layer.transport = kTransport;
    layer.channelCount = shape.channelCount;
    layer.bases.emplace();
    layer.bases->componentCounts = shape.componentCounts;
    layer.bases->vectors =
        makeBases(shape.basesEncoding, layer.bases->firstVectors().back(),
                  coefficientsPerReceiver(shape.bandCount, shape.channelCount), random);
    layer.table.encoding = shape.encoding;
    const std::size_t columnCount = 1 + layer.bases->componentCount();
    switch (shape.encoding) {
        case TransferEncoding::float32:
            layer.table.numbers =
                makeNumbers<float>(clusters, shape.componentCounts, columnCount, 1.0, random);
            break;
        case TransferEncoding::unorm16:
            layer.table.numbers = makeNumbers<std::uint16_t>(clusters, shape.componentCounts,
                                                             columnCount, 65535.0, random);
            break;
        case TransferEncoding::unorm8:
            layer.table.numbers = makeNumbers<std::uint8_t>(clusters, shape.componentCounts,
                                                            columnCount, 255.0, random);
            break;
    }
    transfer.layers.push_back(std::move(layer));
    return transfer;
}

/// Any cluster for any receiver.
CompressedTransfer makeRandomTransfer(const AssetShape& shape) {
    RandomStream random(7, shape.receiverCount);
    std::vector<std::uint32_t> clusters(shape.receiverCount);
    for (std::uint32_t& k : clusters)
        k = random.nextBits() % static_cast<std::uint32_t>(shape.componentCounts.size());
    return makeTransfer(shape, clusters);
}

struct Exact {
    double radiance = 0.0;
    double magnitude = 0.0;  ///< sum of the absolute values of all that is added up
};

/// Σ_i (b_k0i + Σ_p w_p b_kpi) L_i in double, receiver by receiver, from the numbers as stored.
class SlowRelighter {
  public:
    explicit SlowRelighter(const CompressedTransfer& transfer)
        : layer_(transfer.layers.front()),
          coefficientCount_(static_cast<std::size_t>(shCoefficientCount(transfer.bandCount))),
          rows_(expandTable(layer_.table)),
          vectors_(expandTable(layer_.bases->vectors)),
          first_(layer_.bases->firstVectors()),
          clusters_(transfer.receiverCount) {
        readClusters(layer_, 0, clusters_);
    }

    Exact relight(const Lighting& lighting, std::size_t receiver, int color) const {
        const std::uint32_t k = clusters_[receiver];
        Exact exact;
        for (std::size_t p = 0; p <= layer_.bases->componentCounts[k]; ++p) {
            const double weight =
                p == 0 ? 1.0 : rows_[receiver * layer_.table.numbers.columnCount() + p];
            const std::size_t dimension = layer_.bases->vectors.numbers.columnCount();
            const float* vector = &vectors_[(first_[k] + p) * dimension];
            if (layer_.channelCount == 3)
                vector += static_cast<std::size_t>(color) * coefficientCount_;
            for (std::size_t i = 0; i < lighting.coefficients.size(); ++i) {
                const double product = weight * vector[i] * lighting.coefficients[i][color];
                const double bias = layer_.bases->vectors.bias.empty()
                                        ? 0.0
                                        : 2.0 * std::abs(layer_.bases->vectors.bias[i] *
                                                         lighting.coefficients[i][color]);
                exact.radiance += product;
                exact.magnitude += std::abs(product) + weight * bias;
            }
        }
        return exact;
    }

  private:
    const CompressedLayer& layer_;
    std::size_t coefficientCount_;
    std::vector<float> rows_;
    std::vector<float> vectors_;
    std::vector<std::size_t> first_;
    std::vector<std::uint32_t> clusters_;
};

/// The rounding, at worst, of a sum over coefficients and then over components in float, when the
/// factors are rounded too.
double roundingBound(std::size_t coefficientCount, std::size_t componentCount, double magnitude) {
    constexpr double kHalfUlp = 0x1p-24;
    return static_cast<double>(coefficientCount + componentCount + 10) * kHalfUlp * magnitude;
}

void expectRelit(const CompressedTransfer& transfer, const Lighting& lighting,
                 std::span<const Vec3f> radiance) {
    const SlowRelighter slow(transfer);
    const std::size_t componentCount = transfer.layers.front().bases->componentCount();
    for (std::size_t receiver = 0; receiver < transfer.receiverCount; ++receiver) {
        for (int color = 0; color < 3; ++color) {
            const Exact exact = slow.relight(lighting, receiver, color);
            ASSERT_NEAR(
                radiance[receiver][color], exact.radiance,
                roundingBound(lighting.coefficients.size(), componentCount, exact.magnitude))
                << "receiver " << receiver << ", colour " << color;
        }
    }
}

std::vector<Vec3f> relight(const CompressedTransfer& transfer, const Lighting& lighting) {
    std::vector<Vec3f> radiance(transfer.receiverCount);
    Relighter(transfer, kTransport).relight(lighting, radiance);
    return radiance;
}

bool sameBits(std::span<const Vec3f> a, std::span<const Vec3f> b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

const std::vector<std::vector<std::uint32_t>> kComponentCounts = {
    {8},                        // principal components of all
    {0, 0, 0, 0, 0},            // vector quantisation
    {8, 8, 8, 8},               //
    {3, 0, 15, 1, 2, 7, 4, 0},  // adaptive
    std::vector<std::uint32_t>(100, 3),
};

class ClustersOfEncoding
    : public testing::TestWithParam<std::tuple<TransferEncoding, int /*channelCount*/>> {
  protected:
    AssetShape shapeOf(std::size_t receiverCount,
                       std::vector<std::uint32_t> componentCounts) const {
        AssetShape shape;
        std::tie(shape.encoding, shape.channelCount) = GetParam();
        shape.receiverCount = receiverCount;
        shape.componentCounts = std::move(componentCounts);
        return shape;
    }
};

TEST_P(ClustersOfEncoding, GiveTheSumOfProductsForAnyCounts) {
    const Lighting lighting = makeRandomLighting(4, 7);
    for (const std::vector<std::uint32_t>& componentCounts : kComponentCounts) {
        for (const std::size_t receiverCount : {1, 15, 16, 17, 259, 4095, 4097}) {
            SCOPED_TRACE(std::to_string(componentCounts.size()) + " clusters, " +
                         std::to_string(receiverCount) + " receivers");
            const CompressedTransfer transfer =
                makeRandomTransfer(shapeOf(receiverCount, componentCounts));
            expectRelit(transfer, lighting, relight(transfer, lighting));
        }
    }
}

TEST_P(ClustersOfEncoding, GiveTheSumOfProductsOnEveryInstructionSet) {
    AssetShape shape = shapeOf(515, {3, 0, 15, 1, 2, 7, 4, 0, 1, 1, 1, 1, 1, 1, 1, 1});
    shape.basesEncoding = TransferEncoding::unorm16;
    const CompressedTransfer transfer = makeRandomTransfer(shape);
    const Relighter relighter(transfer, kTransport);
    const Lighting lighting = makeRandomLighting(4, 7);
    onEveryInstructionSet([&] {
        std::vector<Vec3f> radiance(515);
        relighter.relight(lighting, radiance);
        expectRelit(transfer, lighting, radiance);
    });
}

TEST_P(ClustersOfEncoding, LeaveHigherBandsUnusedWhenTheLightHasFewer) {
    const CompressedTransfer transfer = makeRandomTransfer(shapeOf(133, {2, 0, 5}));
    for (int bandCount = 0; bandCount <= 4; ++bandCount) {
        SCOPED_TRACE(bandCount);
        const Lighting lighting = makeRandomLighting(bandCount, 11);
        expectRelit(transfer, lighting, relight(transfer, lighting));
    }
}

TEST_P(ClustersOfEncoding, GiveTheSameBitsWholeAndInParts) {
    constexpr std::size_t kReceiverCount = 2 * kRelightPartSize + 1003;
    const CompressedTransfer transfer = makeRandomTransfer(shapeOf(kReceiverCount, {2, 0, 5}));
    const Relighter relighter(transfer, kTransport);
    const Lighting lighting = makeRandomLighting(4, 5);
    const std::vector<Vec3f> whole = relight(transfer, lighting);
    for (const std::size_t partSize : {kRelightPartSize, 2 * kRelightPartSize}) {
        std::vector<Vec3f> parts(kReceiverCount);
        for (std::size_t begin = 0; begin < kReceiverCount; begin += partSize) {
            const std::size_t count = std::min(partSize, kReceiverCount - begin);
            relighter.relight(lighting, begin, std::span(parts).subspan(begin, count));
        }
        EXPECT_TRUE(sameBits(whole, parts)) << "parts of " << partSize;
    }
    const Vec3f untouched(-12345.0f);
    std::vector<Vec3f> few(8, untouched);
    relighter.relight(lighting, kRelightPartSize, std::span(few).first(5));
    EXPECT_TRUE(sameBits(std::span(few).first(5), std::span(whole).subspan(kRelightPartSize, 5)));
    EXPECT_EQ(few[5], untouched);
}

// Large enough to be written past the caches, to memory that begins anywhere.
TEST_P(ClustersOfEncoding, WriteLargeResultsToAnyAddressAndNothingBeside) {
    constexpr std::size_t kReceiverCount = 180'007;
    constexpr std::size_t kMargin = 16;
    const Vec3f untouched(-12345.0f);
    const CompressedTransfer transfer =
        makeRandomTransfer(shapeOf(kReceiverCount, {1, 0, 1, 2, 1, 1}));
    const Relighter relighter(transfer, kTransport);
    const Lighting lighting = makeRandomLighting(1, 3);
    std::vector<Vec3f> expected;
    for (std::size_t offset = 0; offset < kMargin; offset += 5) {
        SCOPED_TRACE(offset);
        std::vector<Vec3f> memory(kReceiverCount + 2 * kMargin, untouched);
        const auto radiance = std::span(memory).subspan(offset, kReceiverCount);
        relighter.relight(lighting, radiance);
        if (offset == 0) {
            expectRelit(transfer, lighting, radiance);
            expected.assign(radiance.begin(), radiance.end());
        }
        ASSERT_TRUE(sameBits(radiance, expected));
        for (std::size_t i = 0; i < offset; ++i)
            ASSERT_EQ(memory[i], untouched) << i;
        for (std::size_t i = offset + kReceiverCount; i < memory.size(); ++i)
            ASSERT_EQ(memory[i], untouched) << i;
    }
}

TEST_P(ClustersOfEncoding, GiveTheSameBitsInAnyOrderOfClusters) {
    constexpr std::uint32_t kClusterCount = 50;
    constexpr std::size_t kReceiverCount = 5000;
    const CompressedTransfer transfer =
        makeRandomTransfer(shapeOf(kReceiverCount, std::vector<std::uint32_t>(kClusterCount, 3)));

    // Cluster k becomes the one at 7 k mod 50, and takes its vectors along.
    CompressedTransfer reordered = transfer;
    CompressedLayer& layer = reordered.layers.front();
    const auto placeOf = [](std::size_t k) { return k * 7 % kClusterCount; };
    const std::size_t clusterLength = 4 * layer.bases->vectors.numbers.columnCount();
    const std::vector<float> vectors = expandTable(layer.bases->vectors);
    std::vector<float> moved(vectors.size());
    for (std::size_t k = 0; k < kClusterCount; ++k)
        std::copy_n(&vectors[k * clusterLength], clusterLength, &moved[placeOf(k) * clusterLength]);
    layer.bases->vectors.numbers = makeTable(layer.bases->vectors.numbers.columnCount(), moved);
    const auto renumber = [&](auto rows) {
        for (std::size_t i = 0; i < rows.size(); i += layer.table.numbers.columnCount())
            rows[i] = static_cast<typename decltype(rows)::value_type>(
                placeOf(static_cast<std::size_t>(rows[i])));
        layer.table.numbers = makeTable(layer.table.numbers.columnCount(), rows);
    };
    if (layer.table.encoding == TransferEncoding::float32)
        renumber(copyRows<float>(layer.table.numbers));
    else if (layer.table.encoding == TransferEncoding::unorm16)
        renumber(copyRows<std::uint16_t>(layer.table.numbers));
    else
        renumber(copyRows<std::uint8_t>(layer.table.numbers));

    const Lighting lighting = makeRandomLighting(4, 21);
    EXPECT_TRUE(sameBits(relight(transfer, lighting), relight(reordered, lighting)));
}

// The first sum is over blocks of sixteen, the second over receivers one by one.
TEST_P(ClustersOfEncoding, GiveAReceiverTheSameBitsAmongManyAndAlone) {
    const CompressedTransfer many = makeRandomTransfer(shapeOf(64, {7}));
    CompressedTransfer alone = many;
    alone.receiverCount = 1;
    CoefficientTable& numbers = alone.layers.front().table.numbers;
    const auto keepFirst = [&](auto rows) {
        rows.resize(numbers.columnCount());
        numbers = makeTable(numbers.columnCount(), rows);
    };
    const TransferEncoding encoding = std::get<0>(GetParam());
    if (encoding == TransferEncoding::float32)
        keepFirst(copyRows<float>(numbers));
    else if (encoding == TransferEncoding::unorm16)
        keepFirst(copyRows<std::uint16_t>(numbers));
    else
        keepFirst(copyRows<std::uint8_t>(numbers));
    const Lighting lighting = makeRandomLighting(4, 23);
    const std::vector<Vec3f> together = relight(many, lighting);
    EXPECT_TRUE(sameBits(std::span(together).first(1), relight(alone, lighting)));
}

TEST_P(ClustersOfEncoding, AreExactlyBlackInDarkness) {
    const CompressedTransfer transfer = makeRandomTransfer(shapeOf(100, {2, 0, 5}));
    for (const Vec3f& value : relight(transfer, Lighting(4)))
        EXPECT_EQ(value, Vec3f(0.0f));
}

std::string paramName(const testing::TestParamInfo<std::tuple<TransferEncoding, int>>& info) {
    const auto& [encoding, channelCount] = info.param;
    return std::string(encodingName(encoding)) + (channelCount == 1 ? "Grey" : "Coloured");
}

INSTANTIATE_TEST_SUITE_P(All, ClustersOfEncoding,
                         testing::Combine(testing::Values(TransferEncoding::float32,
                                                          TransferEncoding::unorm16,
                                                          TransferEncoding::unorm8),
                                          testing::Values(1, 3)),
                         paramName);

TEST(ClusterRelighting, ServesSixtyFiveThousandClustersOfFewReceivers) {
    AssetShape shape;
    shape.encoding = TransferEncoding::unorm16;
    shape.bandCount = 1;
    shape.receiverCount = 9000;
    shape.componentCounts.assign(65536, 2);
    shape.componentCounts.back() = 4;
    std::vector<std::uint32_t> clusters(shape.receiverCount);
    for (std::size_t i = 0; i < clusters.size(); ++i)
        clusters[i] = 65535 - static_cast<std::uint32_t>(i * 7);
    const CompressedTransfer transfer = makeTransfer(shape, clusters);
    const Lighting lighting = makeRandomLighting(1, 7);
    expectRelit(transfer, lighting, relight(transfer, lighting));
}

TEST(ClusterRelighting, TransferBytesCountVectorsWeightsAndPlaces) {
    AssetShape shape;
    shape.receiverCount = 18;
    shape.componentCounts = {8};
    const Relighter relighter(makeRandomTransfer(shape), kTransport);
    const std::size_t vectors = 16 * 16 * 4 + 2 * 4;  // a block of 16, and where they begin
    const std::size_t block = 16 * 8 + 16 * 2 + 4;    // weights, places, cluster
    const std::size_t single = 8 + 2 + 4;
    EXPECT_EQ(relighter.transferBytes(), vectors + block + 2 * single);
}

TEST(ClusterRelighting, AnAssetWithoutReceiversIsRelitToNothing) {
    AssetShape shape;
    shape.componentCounts = {2, 2};
    const Relighter relighter(makeTransfer(shape, {}), kTransport);
    relighter.relight(makeRandomLighting(4, 1), {});
    EXPECT_EQ(relighter.receiverCount(), 0u);
}

}  // namespace
}  // namespace prt
