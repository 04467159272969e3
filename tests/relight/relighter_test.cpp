#include "prt/relight/relighter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "prt/base/error.h"
#include "prt/base/random.h"
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

template <class Stored, class NextValue>
CoefficientTable makeTableOf(std::size_t rowCount, std::size_t columnCount, NextValue nextValue) {
    std::vector<Stored> values(rowCount * columnCount);
    for (Stored& value : values)
        value = static_cast<Stored>(nextValue());
    return makeTable(columnCount, values);
}

CoefficientTable makeRandomTable(std::size_t rowCount, std::size_t columnCount,
                                 TransferEncoding encoding, RandomStream& random) {
    switch (encoding) {
        case TransferEncoding::unorm16:
            return makeTableOf<std::uint16_t>(rowCount, columnCount,
                                              [&] { return random.nextBits() >> 16; });
        case TransferEncoding::unorm8:
            return makeTableOf<std::uint8_t>(rowCount, columnCount,
                                             [&] { return random.nextBits() >> 24; });
        case TransferEncoding::float32:
            break;
    }
    return makeTableOf<float>(rowCount, columnCount, [&] { return randomSigned(random); });
}

CompressedTransfer makeRandomTransfer(int bandCount, int channelCount, TransferEncoding encoding,
                                      std::size_t receiverCount) {
    CompressedTransfer transfer;
    transfer.bandCount = bandCount;
    transfer.receiverCount = receiverCount;
    CompressedLayer layer;
    layer.transport = kTransport;
    layer.channelCount = channelCount;
    layer.table.encoding = encoding;
    const auto rowCount = static_cast<std::size_t>(channelCount * shCoefficientCount(bandCount));
    RandomStream random(20260101, receiverCount);
    layer.table.numbers = makeRandomTable(receiverCount, rowCount, encoding, random);
    if (encoding != TransferEncoding::float32) {
        for (std::size_t row = 0; row < rowCount; ++row) {
            layer.table.scale.push_back(random.nextUnitFloat() + 0.1f);
            layer.table.bias.push_back(static_cast<float>(randomSigned(random)));
        }
    }
    transfer.layers.push_back(layer);
    return transfer;
}

template <class Stored>
double storedValue(const CompressedLayer& layer, std::size_t index) {
    std::vector<Stored> row(layer.table.numbers.columnCount());
    layer.table.numbers.readRow(index / row.size(), std::span(row));
    return static_cast<double>(row[index % row.size()]);
}

struct Exact {
    double radiance = 0.0;
    double magnitude = 0.0;  ///< sum of the absolute values of all that is added up
};

/// C7 as it is written down, in double, from the layer as it is stored.
Exact relightSlowly(const CompressedTransfer& transfer, const Lighting& lighting,
                    std::size_t receiver, int color) {
    const CompressedLayer& layer = transfer.layers.front();
    const auto n = static_cast<std::size_t>(shCoefficientCount(transfer.bandCount));
    const std::size_t channel = layer.channelCount == 3 ? static_cast<std::size_t>(color) : 0;
    Exact exact;
    for (std::size_t i = 0; i < lighting.coefficients.size(); ++i) {
        const std::size_t row = channel * n + i;
        const std::size_t index = receiver * n * static_cast<std::size_t>(layer.channelCount) + row;
        double bias = 0.0;
        double value = 0.0;
        if (layer.table.encoding == TransferEncoding::float32) {
            value = storedValue<float>(layer, index);
        } else if (layer.table.encoding == TransferEncoding::unorm16) {
            bias = layer.table.bias[row];
            value = layer.table.scale[row] * storedValue<std::uint16_t>(layer, index) / 65535.0;
        } else {
            bias = layer.table.bias[row];
            value = layer.table.scale[row] * storedValue<std::uint8_t>(layer, index) / 255.0;
        }
        const double light = lighting.coefficients[i][color];
        exact.radiance += (bias + value) * light;
        exact.magnitude += (std::abs(bias) + std::abs(value)) * std::abs(light);
    }
    return exact;
}

/// The rounding of a sum of n products in float, at worst, when the factors are rounded too.
double roundingBound(std::size_t termCount, double magnitude) {
    constexpr double kHalfUlp = 0x1p-24;
    return static_cast<double>(termCount + 4) * kHalfUlp * magnitude;
}

void expectRelit(const CompressedTransfer& transfer, const Lighting& lighting,
                 std::span<const Vec3f> radiance, std::size_t receiverStep) {
    for (std::size_t receiver = 0; receiver < transfer.receiverCount; receiver += receiverStep) {
        for (int color = 0; color < 3; ++color) {
            const Exact exact = relightSlowly(transfer, lighting, receiver, color);
            ASSERT_NEAR(radiance[receiver][color], exact.radiance,
                        roundingBound(lighting.coefficients.size(), exact.magnitude))
                << "receiver " << receiver << ", colour " << color;
        }
    }
}

bool sameBits(std::span<const Vec3f> a, std::span<const Vec3f> b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

class RelighterOfEncoding
    : public testing::TestWithParam<std::tuple<TransferEncoding, int /*channelCount*/>> {
  protected:
    CompressedTransfer makeTransfer(int bandCount, std::size_t receiverCount) const {
        const auto& [encoding, channelCount] = GetParam();
        return makeRandomTransfer(bandCount, channelCount, encoding, receiverCount);
    }
};

TEST_P(RelighterOfEncoding, GivesTheSumOfProductsForAnyBandAndReceiverCount) {
    for (int bandCount = 1; bandCount <= kMaxBandCount; ++bandCount) {
        for (const std::size_t receiverCount : {1, 15, 16, 17, 255, 259}) {
            SCOPED_TRACE(std::to_string(bandCount) + " bands, " + std::to_string(receiverCount) +
                         " receivers");
            const CompressedTransfer transfer = makeTransfer(bandCount, receiverCount);
            const Lighting lighting = makeRandomLighting(bandCount, 7);
            std::vector<Vec3f> radiance(receiverCount);
            Relighter(transfer, kTransport).relight(lighting, radiance);
            expectRelit(transfer, lighting, radiance, 1);
        }
    }
}

TEST_P(RelighterOfEncoding, LeavesHigherBandsUnusedWhenTheLightHasFewer) {
    const CompressedTransfer transfer = makeTransfer(5, 33);
    const Relighter relighter(transfer, kTransport);
    std::vector<Vec3f> radiance(33);
    for (int bandCount = 0; bandCount <= 5; ++bandCount) {
        SCOPED_TRACE(bandCount);
        const Lighting lighting = makeRandomLighting(bandCount, 11);
        relighter.relight(lighting, radiance);
        expectRelit(transfer, lighting, radiance, 1);
    }
}

// Large enough to be written past the caches, to memory that begins anywhere.
TEST_P(RelighterOfEncoding, WritesLargeResultsToAnyAddressAndNothingBeside) {
    constexpr std::size_t kReceiverCount = 180'007;
    constexpr std::size_t kMargin = 16;
    constexpr std::size_t kPrimeStep = 13;
    const Vec3f untouched(-12345.0f);
    const CompressedTransfer transfer = makeTransfer(1, kReceiverCount);
    const Relighter relighter(transfer, kTransport);
    const Lighting lighting = makeRandomLighting(1, 3);
    for (std::size_t offset = 0; offset < 16; offset += 5) {
        SCOPED_TRACE(offset);
        std::vector<Vec3f> memory(kReceiverCount + 2 * kMargin, untouched);
        const auto radiance = std::span(memory).subspan(offset, kReceiverCount);
        relighter.relight(lighting, radiance);
        expectRelit(transfer, lighting, radiance, kPrimeStep);
        for (std::size_t i = 0; i < memory.size(); ++i) {
            const bool isResult = i >= offset && i < offset + kReceiverCount;
            ASSERT_EQ(memory[i] == untouched, !isResult) << i;
        }
    }
}

TEST_P(RelighterOfEncoding, GivesTheSameBitsWholeAndInParts) {
    constexpr std::size_t kReceiverCount = 2 * kRelightPartSize + 1003;
    const CompressedTransfer transfer = makeTransfer(4, kReceiverCount);
    const Relighter relighter(transfer, kTransport);
    const Lighting lighting = makeRandomLighting(4, 5);
    std::vector<Vec3f> whole(kReceiverCount);
    relighter.relight(lighting, whole);

    for (const std::size_t partSize : {kRelightPartSize, 2 * kRelightPartSize}) {
        std::vector<Vec3f> parts(kReceiverCount);
        for (std::size_t begin = 0; begin < kReceiverCount; begin += partSize) {
            const std::size_t count = std::min(partSize, kReceiverCount - begin);
            relighter.relight(lighting, begin, std::span(parts).subspan(begin, count));
        }
        EXPECT_TRUE(sameBits(whole, parts)) << "parts of " << partSize;
    }
}

TEST_P(RelighterOfEncoding, PartsThatEndInsideABlockLeaveTheRestAlone) {
    const CompressedTransfer transfer = makeTransfer(3, kRelightPartSize + 64);
    const Relighter relighter(transfer, kTransport);
    const Lighting lighting = makeRandomLighting(3, 5);
    std::vector<Vec3f> whole(kRelightPartSize + 64);
    relighter.relight(lighting, whole);

    const Vec3f untouched(-12345.0f);
    std::vector<Vec3f> part(8, untouched);
    relighter.relight(lighting, kRelightPartSize, std::span(part).first(5));
    EXPECT_TRUE(sameBits(std::span(part).first(5), std::span(whole).subspan(kRelightPartSize, 5)));
    EXPECT_EQ(part[5], untouched);
}

TEST_P(RelighterOfEncoding, GivesTheSumOfProductsOnEveryInstructionSet) {
    const CompressedTransfer transfer = makeTransfer(5, 35);
    const Relighter relighter(transfer, kTransport);
    const Lighting lighting = makeRandomLighting(5, 7);
    onEveryInstructionSet([&] {
        std::vector<Vec3f> radiance(35);
        relighter.relight(lighting, radiance);
        expectRelit(transfer, lighting, radiance, 1);
    });
}

// A22.
TEST_P(RelighterOfEncoding, IsLinearInTheLight) {
    constexpr double kLinearity = 1e-5;
    constexpr double kFirst = 0.75;
    constexpr double kSecond = -2.5;
    const CompressedTransfer transfer = makeTransfer(5, 100);
    const Relighter relighter(transfer, kTransport);
    const Lighting first = makeRandomLighting(5, 1);
    const Lighting second = makeRandomLighting(5, 2);
    Lighting sum(5);
    for (std::size_t i = 0; i < sum.coefficients.size(); ++i)
        sum.coefficients[i] = first.coefficients[i] * kFirst + second.coefficients[i] * kSecond;

    std::vector<Vec3f> litByFirst(100), litBySecond(100), litBySum(100);
    relighter.relight(first, litByFirst);
    relighter.relight(second, litBySecond);
    relighter.relight(sum, litBySum);
    for (std::size_t r = 0; r < 100; ++r) {
        for (int color = 0; color < 3; ++color) {
            const double expected = kFirst * litByFirst[r][color] + kSecond * litBySecond[r][color];
            const double scale = relightSlowly(transfer, sum, r, color).magnitude;
            EXPECT_NEAR(litBySum[r][color], expected, kLinearity * scale);
        }
    }
}

TEST_P(RelighterOfEncoding, DarknessIsExactlyBlack) {
    const CompressedTransfer transfer = makeTransfer(4, 20);
    std::vector<Vec3f> radiance(20, Vec3f(1.0f));
    Relighter(transfer, kTransport).relight(Lighting(4), radiance);
    for (const Vec3f& value : radiance)
        EXPECT_EQ(value, Vec3f(0.0f));
}

TEST_P(RelighterOfEncoding, GivesTheSameBitsFromManyThreads) {
    const CompressedTransfer transfer = makeTransfer(3, 500);
    const Relighter relighter(transfer, kTransport);
    const Lighting lighting = makeRandomLighting(3, 9);
    std::vector<Vec3f> alone(500);
    relighter.relight(lighting, alone);
    std::vector<std::vector<Vec3f>> together(4, std::vector<Vec3f>(500));
    std::vector<std::thread> threads;
    for (std::vector<Vec3f>& radiance : together)
        threads.emplace_back([&] { relighter.relight(lighting, radiance); });
    for (std::thread& thread : threads)
        thread.join();
    for (const std::vector<Vec3f>& radiance : together)
        EXPECT_TRUE(sameBits(alone, radiance));
}

std::string encodingParamName(
    const testing::TestParamInfo<std::tuple<TransferEncoding, int>>& info) {
    const auto& [encoding, channelCount] = info.param;
    return std::string(encodingName(encoding)) + (channelCount == 1 ? "Grey" : "Coloured");
}

INSTANTIATE_TEST_SUITE_P(All, RelighterOfEncoding,
                         testing::Combine(testing::Values(TransferEncoding::float32,
                                                          TransferEncoding::unorm16,
                                                          TransferEncoding::unorm8),
                                          testing::Values(1, 3)),
                         encodingParamName);

// T-22: the shading of linearly interpolated transfer is the interpolated shading.
TEST(Relighter, ShadingOfInterpolatedTransferIsInterpolatedShading) {
    constexpr std::size_t kCoefficientCount = 25;
    constexpr double kWeights[3] = {0.5, 0.3125, 0.1875};  // sum to 1, exact in float
    CompressedTransfer transfer = makeRandomTransfer(5, 1, TransferEncoding::float32, 3);
    CompressedLayer& layer = transfer.layers.front();
    std::vector<float> rows = expandLayer(layer);
    for (std::size_t i = 0; i < kCoefficientCount; ++i) {
        double interpolated = 0.0;
        for (std::size_t corner = 0; corner < 3; ++corner)
            interpolated +=
                kWeights[corner] * storedValue<float>(layer, corner * kCoefficientCount + i);
        rows.push_back(static_cast<float>(interpolated));
    }
    layer.table.numbers = makeTable(kCoefficientCount, rows);
    transfer.receiverCount = 4;

    const Lighting lighting = makeRandomLighting(5, 13);
    std::vector<Vec3f> radiance(4);
    Relighter(transfer, kTransport).relight(lighting, radiance);
    for (int color = 0; color < 3; ++color) {
        double expected = 0.0;
        double magnitude = 0.0;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            expected += kWeights[corner] * radiance[corner][color];
            magnitude += relightSlowly(transfer, lighting, corner, color).magnitude;
        }
        EXPECT_NEAR(radiance[3][color], expected, roundingBound(kCoefficientCount, magnitude));
    }
}

TEST(Relighter, RelightsTheLayerThatIsAskedFor) {
    CompressedTransfer transfer = makeRandomTransfer(2, 1, TransferEncoding::float32, 5);
    CompressedLayer coloured = makeRandomTransfer(2, 3, TransferEncoding::unorm8, 5).layers.front();
    coloured.transport = Transport::interreflected;
    transfer.layers.push_back(coloured);
    const Lighting lighting = makeRandomLighting(2, 1);
    std::vector<Vec3f> radiance(5);
    Relighter(transfer, Transport::shadowed).relight(lighting, radiance);
    expectRelit(transfer, lighting, radiance, 1);
    Relighter(transfer, Transport::interreflected).relight(lighting, radiance);
    transfer.layers.erase(transfer.layers.begin());
    expectRelit(transfer, lighting, radiance, 1);
}

TEST(Relighter, RefusesALayerThatTheAssetLacksAndNamesThoseItHas) {
    const CompressedTransfer transfer = makeRandomTransfer(2, 1, TransferEncoding::float32, 5);
    try {
        const Relighter relighter(transfer, Transport::interreflected);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::invalidOption);
        EXPECT_NE(error.message().find(transportName(Transport::interreflected)),
                  std::string::npos);
        EXPECT_NE(error.hint().find(transportName(Transport::shadowed)), std::string::npos);
    }
}

TEST(Relighter, TransferBytesCountWholeBlocksInTheStoredPrecision) {
    const Relighter floats(makeRandomTransfer(5, 1, TransferEncoding::float32, 17), kTransport);
    EXPECT_EQ(floats.transferBytes(), 2u * 16u * 25u * 4u);
    const Relighter shorts(makeRandomTransfer(3, 3, TransferEncoding::unorm16, 16), kTransport);
    EXPECT_EQ(shorts.transferBytes(), 16u * 27u * 2u);
    EXPECT_EQ(shorts.receiverCount(), 16u);
    EXPECT_EQ(shorts.bandCount(), 3);
}

TEST(Relighter, AnAssetWithoutReceiversIsRelitToNothing) {
    const Relighter relighter(makeRandomTransfer(3, 1, TransferEncoding::unorm8, 0), kTransport);
    relighter.relight(makeRandomLighting(3, 1), {});
    EXPECT_EQ(relighter.transferBytes(), 0u);
}

TEST(Relighter, LivesOnWhenMoved) {
    const CompressedTransfer transfer = makeRandomTransfer(2, 1, TransferEncoding::unorm16, 5);
    const Lighting lighting = makeRandomLighting(2, 1);
    Relighter first(transfer, kTransport);
    Relighter second = std::move(first);
    first = std::move(second);
    std::vector<Vec3f> radiance(5);
    first.relight(lighting, radiance);
    expectRelit(transfer, lighting, radiance, 1);
}

}  // namespace
}  // namespace prt
