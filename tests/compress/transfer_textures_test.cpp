#include "prt/compress/transfer_textures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "prt/base/random.h"

namespace prt {
namespace {

constexpr int kWidth = 17;
constexpr int kHeight = 5;
// Reading back rounds to a float once, and a range is a rounded difference: each at most this share
// of the largest number.
constexpr double kRounding = 1.5 * std::numeric_limits<float>::epsilon();

struct GridOptions {
    int bandCount = 5;
    int channelCount = 1;
    int width = kWidth;
    int height = kHeight;
    int narrowest = 20;  ///< the coefficient that varies least
};

/// Random transfer of texels. The narrowest coefficient is far from 0, so that it has the least
/// variance but not the least energy; of its channels the first varies most.
TransferLayer randomGrid(const GridOptions& options) {
    TransferLayer layer;
    layer.transport = Transport::interreflected;
    layer.channelCount = options.channelCount;
    const int coefficientCount = options.bandCount * options.bandCount;
    const std::size_t rowLength = coefficientsPerReceiver(options.bandCount, options.channelCount);
    std::vector<float> values(static_cast<std::size_t>(options.width * options.height) * rowLength);
    RandomStream random(3, 1);
    for (std::size_t k = 0; k < values.size(); ++k) {
        const int i = static_cast<int>(k) % coefficientCount;
        const auto channel =
            static_cast<float>(k % rowLength / static_cast<std::size_t>(coefficientCount));
        const float range = i == options.narrowest ? 0.001f / (1.0f + channel)
                                                   : 0.01f * static_cast<float>(1 + i % 7);
        const float middle = i == options.narrowest ? 0.5f : 0.02f * static_cast<float>(i % 3);
        values[k] = middle + range * (random.nextUnitFloat() - 0.5f);
    }
    layer.coefficients = makeTable(rowLength, values);
    return layer;
}

struct Column {
    double low = 0.0;
    double high = 0.0;
    double mean = 0.0;
    double variance = 0.0;
};

Column measureColumn(const std::vector<float>& values, std::size_t rowLength, std::size_t column) {
    Column result{values[column], values[column]};
    double sum = 0.0, squares = 0.0, count = 0.0;
    for (std::size_t k = column; k < values.size(); k += rowLength) {
        result.low = std::min<double>(result.low, values[k]);
        result.high = std::max<double>(result.high, values[k]);
        sum += values[k];
        squares += double{values[k]} * values[k];
        count += 1.0;
    }
    result.mean = sum / count;
    result.variance = squares / count - result.mean * result.mean;
    return result;
}

TransferTextures pack(const GridOptions& options) {
    return packTransferTextures(randomGrid(options), options.bandCount, options.width,
                                options.height);
}

std::size_t countBytes(const TransferTextures& textures) {
    std::size_t bytes = 0;
    for (std::size_t t = 0; t < textures.textureCount(); ++t)
        bytes += textures.texture(t).size();
    return bytes;
}

// [Kautz04]: 25 coefficients of 8 bits would be 1.5625 MB, 24 of them are 1.5 MB.
TEST(TransferTextures, FiveBandsOf256By256TexelsTakeSixTexturesAndOneAndAHalfMegabytes) {
    const TransferTextures textures = pack({.width = 256, .height = 256});
    EXPECT_EQ(textures.textureCount(), 6u);
    EXPECT_EQ(textures.texture(5).size(), 262144u);
    EXPECT_EQ(countBytes(textures), 1572864u);
}

TEST(TransferTextures, ThreeChannelsTakeThreeTimesAsMany) {
    const TransferTextures textures = pack({.channelCount = 3, .width = 64, .height = 16});
    EXPECT_EQ(textures.textureCount(), 18u);
    EXPECT_EQ(countBytes(textures), 3u * 64u * 16u * 24u);
}

TEST(TransferTextures, AnEvenNumberOfBandsLeavesNothingOut) {
    for (const int bandCount : {2, 4, 6}) {
        const TransferTextures textures = pack({.bandCount = bandCount, .narrowest = 1});
        EXPECT_FALSE(textures.leftOut.has_value());
        EXPECT_EQ(textures.coefficients.size(), static_cast<std::size_t>(bandCount * bandCount));
        EXPECT_EQ(4 * textures.textureCount(), textures.coefficients.size());
    }
}

TEST(TransferTextures, TheCoefficientOfTheLeastVarianceIsLeftOut) {
    for (const int narrowest : {0, 7, 24}) {
        const TransferTextures textures = pack({.narrowest = narrowest});
        ASSERT_TRUE(textures.leftOut.has_value());
        EXPECT_EQ(textures.leftOut->index, narrowest);
        EXPECT_EQ(textures.coefficients.size(), 24u);
        EXPECT_EQ(std::count(textures.coefficients.begin(), textures.coefficients.end(), narrowest),
                  0);
    }
}

// T-21 for all coefficients but one, of which the error is what the result states.
TEST(TransferTextures, AStoredCoefficientIsWithinItsRangeOver510) {
    for (const int channelCount : {1, 3}) {
        const GridOptions options{.channelCount = channelCount};
        const std::vector<float> values = copyRows<float>(randomGrid(options).coefficients);
        const TransferLayer back = unpackTransferTextures(pack(options));
        EXPECT_EQ(back.transport, Transport::interreflected);
        ASSERT_EQ(back.channelCount, channelCount);
        const std::vector<float> unpacked = copyRows<float>(back.coefficients);
        ASSERT_EQ(unpacked.size(), values.size());
        const std::size_t rowLength = coefficientsPerReceiver(5, channelCount);
        for (std::size_t column = 0; column < rowLength; ++column) {
            if (column % 25 == 20) continue;
            const Column range = measureColumn(values, rowLength, column);
            const double bound = (range.high - range.low) / 510.0 +
                                 kRounding * std::max(std::abs(range.low), std::abs(range.high));
            for (std::size_t k = column; k < values.size(); k += rowLength)
                ASSERT_NEAR(unpacked[k], values[k], bound) << "column " << column;
        }
    }
}

TEST(TransferTextures, TheErrorOfTheOneLeftOutIsAsStated) {
    const GridOptions options{.channelCount = 3};
    const std::vector<float> values = copyRows<float>(randomGrid(options).coefficients);
    const TransferTextures textures = pack(options);
    const std::vector<float> unpacked =
        copyRows<float>(unpackTransferTextures(textures).coefficients);
    const LeftOutCoefficient& leftOut = textures.leftOut.value();
    double squares = 0.0, largest = 0.0, variance = 0.0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const std::size_t column = channel * 25 + 20;
        variance += measureColumn(values, 75, column).variance / 3.0;
        for (std::size_t k = column; k < values.size(); k += 75) {
            ASSERT_EQ(unpacked[k], leftOut.mean[channel]);
            const double error = double{unpacked[k]} - values[k];
            squares += error * error;
            largest = std::max(largest, std::abs(error));
        }
    }
    const double count = 3.0 * kWidth * kHeight;
    constexpr double kSumRounding = 1e-12;  // of doubles, in another order
    EXPECT_NEAR(leftOut.rmse, std::sqrt(squares / count), kSumRounding);
    EXPECT_NEAR(leftOut.largestError, largest, kSumRounding);
    // No constant does better than the mean, to the rounding of a float near 0.5.
    EXPECT_NEAR(leftOut.rmse, std::sqrt(variance), 1e-7);
    EXPECT_GT(leftOut.rmse, 1e-4);
}

// What a shader fetches, computed from the definition.
TEST(TransferTextures, ATexelHoldsFourConsecutiveStoredCoefficients) {
    const GridOptions options{.channelCount = 3};
    const std::vector<float> values = copyRows<float>(randomGrid(options).coefficients);
    const TransferTextures textures = pack(options);
    for (std::size_t s = 0; s < 72; ++s) {
        const std::size_t channel = s / 24;
        const std::size_t column =
            channel * 25 + static_cast<std::size_t>(textures.coefficients[s % 24]);
        const Column range = measureColumn(values, 75, column);
        for (std::size_t y = 0; y < kHeight; ++y) {
            for (std::size_t x = 0; x < kWidth; ++x) {
                const std::size_t texel = y * kWidth + x;
                const double q =
                    255.0 * (values[texel * 75 + column] - range.low) / (range.high - range.low);
                const auto byte = std::to_integer<int>(
                    textures.texture(channel * 6 + s % 24 / 4)[texel * 4 + s % 4]);
                // Half a step, and the range's rounding to a float over 255 steps.
                ASSERT_NEAR(byte, q, 0.5 + 255.0 * kRounding * 100.0)
                    << s << " at " << x << ", " << y;
            }
        }
        EXPECT_EQ(textures.table.bias[s], static_cast<float>(range.low));
    }
}

TEST(TransferTextures, EqualTexelsComeBackExactly) {
    TransferLayer layer;
    layer.coefficients = makeTable(9, std::vector<float>(9 * 6, 0.28209479f));
    const TransferTextures textures = packTransferTextures(layer, 3, 3, 2);
    EXPECT_EQ(textures.textureCount(), 2u);
    EXPECT_EQ(textures.leftOut.value().rmse, 0.0);
    EXPECT_TRUE(unpackTransferTextures(textures).coefficients == layer.coefficients);
}

}  // namespace
}  // namespace prt
