#include "prt/transport/gather_kernels.h"

#include <gtest/gtest.h>
#include <hwy/aligned_allocator.h>

#include <cmath>

#include "prt/base/random.h"
#include "prt/basis/sh.h"
#include "prt/math/sampling.h"

namespace prt {
namespace {

constexpr std::size_t kSampleCount = 256;
// Series against the library's sine and cosine, and one rotation, in float.
constexpr float kDirectionTolerance = 2e-6f;
// A mean of 256 values around 1 in float, summed in another order.
constexpr float kSumTolerance = 1e-4f;

/// @param sample  by the kernel under test
/// @param map     what takes a point of the square to a direction about +z
void expectScrambledPoints(decltype(GatherKernels::sampleDirections) sample,
                           Vec3f (*map)(float, float)) {
    const SamplePattern pattern(kSampleCount);
    RayStream rays(kSampleCount);
    for (const Vec3f& normal :
         {Vec3f(0, 0, 1), Vec3f(0, 0, -1), Vec3f(1, 0, 0), Vec3f(0.6f, -0.64f, 0.48f)}) {
        const ReceiverSampling sampling{0x1234u, 0x98765432u, normal};
        sample(pattern, sampling, rays);
        for (std::uint32_t i = 0; i < kSampleCount; ++i) {
            const SquareBits point = sobolPoint(i);
            const Vec3f expected = map(unitFloatFromBits(owenScramble(point.x, sampling.seedX)),
                                       unitFloatFromBits(owenScramble(point.y, sampling.seedY)));
            const Vec3f direction(rays.directionX[i], rays.directionY[i], rays.directionZ[i]);
            EXPECT_NEAR(direction.length(), 1.0f, kDirectionTolerance);
            EXPECT_NEAR(direction.dot(normal), expected.z, kDirectionTolerance);
            // About +z the frame is the axes themselves.
            if (normal.z == 1.0f) {
                EXPECT_NEAR(direction.x, expected.x, kDirectionTolerance);
                EXPECT_NEAR(direction.y, expected.y, kDirectionTolerance);
            }
        }
    }
}

class GatherKernelsTest : public testing::TestWithParam<Isa> {
  protected:
    void SetUp() override {
        if (GetParam() > detectIsa()) GTEST_SKIP() << "this machine lacks the instruction set";
    }
    const GatherKernels kernels_ = selectGatherKernels(GetParam());
};

TEST_P(GatherKernelsTest, DirectionsAreTheScrambledPointsAboutTheNormal) {
    expectScrambledPoints(kernels_.sampleDirections, sampleCosineHemisphere);
}

TEST_P(GatherKernelsTest, UniformDirectionsAreTheScrambledPointsAboutTheNormal) {
    expectScrambledPoints(kernels_.sampleUniformDirections, sampleUniformHemisphere);
}

TEST_P(GatherKernelsTest, SumsTheBasisOverVisibleDirections) {
    const SamplePattern pattern(kSampleCount);
    RayStream rays(kSampleCount);
    kernels_.sampleDirections(pattern, {7u, 8u, Vec3f(0.6f, -0.64f, 0.48f)}, rays);
    rays.restart({0, 0, 0});
    for (std::size_t i = 0; i < kSampleCount; i += 3)
        rays.tFar[i] = -INFINITY;

    for (int bandCount = 1; bandCount <= kMaxBandCount; ++bandCount) {
        const auto n = static_cast<std::size_t>(shCoefficientCount(bandCount));
        std::vector<float> sums(n);
        kernels_.sumVisible(rays, bandCount, sums);
        std::vector<double> expected(n);
        std::vector<double> values(n);
        for (std::size_t i = 0; i < kSampleCount; ++i) {
            if (i % 3 == 0) continue;
            evaluateSh(Vec3d(static_cast<double>(rays.directionX[i]),
                             static_cast<double>(rays.directionY[i]),
                             static_cast<double>(rays.directionZ[i])),
                       bandCount, values);
            for (std::size_t k = 0; k < n; ++k)
                expected[k] += values[k];
        }
        for (std::size_t k = 0; k < n; ++k)
            EXPECT_NEAR(sums[k], expected[k], kSumTolerance) << "coefficient " << k;
    }
}

TEST_P(GatherKernelsTest, MultipliesARowOfTheBounceMatrix) {
    constexpr std::size_t kReceiverCount = 9;
    RandomStream random(3, 0);
    const std::vector<BounceEntry> row = {
        {2, {0.5f, 0.25f, 0.125f}}, {7, {0.1f, 0.2f, 0.3f}}, {0, {0.0f, 1.0f, 0.0f}}};
    for (int bandCount = 1; bandCount <= kMaxBandCount; ++bandCount) {
        BounceTransfer transfer{nullptr, static_cast<std::size_t>(shCoefficientCount(bandCount))};
        transfer.columnCount = padToLanes(3 * transfer.coefficientCount);
        const std::size_t stride = transfer.columnCount;
        const auto values = hwy::AllocateAligned<float>(kReceiverCount * stride);
        for (std::size_t i = 0; i < kReceiverCount * stride; ++i)
            values[i] = random.nextUnitFloat();
        transfer.values = values.get();
        const auto result = hwy::AllocateAligned<float>(stride);
        kernels_.multiplyRow(row, transfer, result.get());
        for (std::size_t i = 0; i < 3 * transfer.coefficientCount; ++i) {
            const auto channel = static_cast<int>(i / transfer.coefficientCount);
            float expected = 0.0f;
            for (const BounceEntry& entry : row)
                expected += entry.weight[channel] * values[entry.receiver * stride + i];
            EXPECT_NEAR(result[i], expected, 1e-6f) << bandCount << " bands, number " << i;
        }
    }
}

TEST_P(GatherKernelsTest, AddsProductsOfMatrices) {
    RandomStream random(5, 0);
    for (const std::size_t columnCount : {1u, 9u, 16u, 25u, 81u, 100u}) {
        constexpr std::size_t kRowCount = 7;
        const std::size_t stride = padToLanes(columnCount);
        const auto draw = [&](std::size_t count) {
            std::vector<float> numbers(count);
            for (float& number : numbers)
                number = random.nextUnitFloat();
            return numbers;
        };
        const std::vector<float> rows = draw(kRowCount * columnCount + kLaneMultiple);
        std::vector<float> factors = draw(kRowCount);
        factors[3] = 0.0f;
        const std::vector<float> before = draw(stride);
        std::vector<float> sums = before;
        kernels_.addProduct(factors, rows.data(), columnCount, sums.data());
        for (std::size_t j = 0; j < columnCount; ++j) {
            float expected = before[j];
            for (std::size_t i = 0; i < kRowCount; ++i)
                expected += factors[i] * rows[i * columnCount + j];
            EXPECT_NEAR(sums[j], expected, 2e-6f) << "column " << j << " of " << columnCount;
        }

        const std::vector<float> matrixBefore = draw(kRowCount * stride);
        std::vector<float> matrix = matrixBefore;
        kernels_.addOuterProduct(factors, before, matrix.data());
        for (std::size_t e = 0; e < matrix.size(); ++e)
            EXPECT_NEAR(matrix[e], matrixBefore[e] + factors[e / stride] * before[e % stride],
                        1e-6f);
    }
}

INSTANTIATE_TEST_SUITE_P(AllInstructionSets, GatherKernelsTest,
                         testing::Values(Isa::sse4, Isa::avx2, Isa::avx512),
                         [](const auto& parameter) {
                             return std::string(isaName(parameter.param));
                         });

}  // namespace
}  // namespace prt
