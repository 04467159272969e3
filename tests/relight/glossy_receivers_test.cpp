// Matrices of which it is known what they stand for.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>
#include <vector>

#include "prt/base/error.h"
#include "prt/basis/sh.h"
#include "prt/brdf/brdf.h"
#include "prt/math/frame.h"
#include "prt/relight/glossy_relighter.h"

namespace prt {
namespace {

constexpr int kBandCount = 5;
constexpr std::size_t kCoefficientCount = 25;

/// Directions of a fine grid over the sphere, and their share of it.
struct Direction {
    Vec3d toLight;
    double solidAngle = 0.0;
};

std::vector<Direction> sphereGrid() {
    constexpr int kRows = 120, kColumns = 120;
    std::vector<Direction> directions;
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column) {
            const double z = 2.0 * (row + 0.5) / kRows - 1.0;
            const double angle = 2.0 * std::numbers::pi * (column + 0.5) / kColumns;
            const double radius = std::sqrt(1.0 - z * z);
            directions.push_back({{radius * std::cos(angle), radius * std::sin(angle), z},
                                  4.0 * std::numbers::pi / (kRows * kColumns)});
        }
    return directions;
}

/// M_ij = ∫ y_i(R_x ω) V y_j(ω) dω for what is seen of the local frame's sphere. @return  [i][j]
template <class IsSeen>
std::vector<float> makeMatrix(const Vec3f& normal, const IsSeen& isSeen) {
    const Frame<double> frame = frameFromNormal(Vec3d(normal));
    std::vector<double> matrix(kCoefficientCount * kCoefficientCount);
    std::vector<double> local(kCoefficientCount), world(kCoefficientCount);
    for (const auto& [direction, solidAngle] : sphereGrid()) {
        if (!isSeen(direction)) continue;
        evaluateSh(direction, kBandCount, local);
        evaluateSh(frame.worldFromLocal(direction), kBandCount, world);
        for (std::size_t i = 0; i < kCoefficientCount; ++i)
            for (std::size_t j = 0; j < kCoefficientCount; ++j)
                matrix[i * kCoefficientCount + j] += local[i] * world[j] * solidAngle;
    }
    return {matrix.begin(), matrix.end()};
}

bool isUpward(const Vec3d& direction) {
    return direction.z > 0.0;
}

/// Layers of one matrix a receiver.
CompressedTransfer makeTransferOf(Transport transport, const std::vector<float>& matrices) {
    CompressedTransfer transfer;
    transfer.bandCount = kBandCount;
    transfer.receiverCount = matrices.size() / (kCoefficientCount * kCoefficientCount);
    CompressedLayer layer;
    layer.transport = transport;
    layer.incidentBandCount = kBandCount;
    layer.table.numbers = makeTable(kCoefficientCount * kCoefficientCount, matrices);
    transfer.layers.push_back(std::move(layer));
    return transfer;
}

Lighting whiteLight() {
    Lighting lighting(kBandCount);
    lighting.coefficients[0] = Vec3d(std::sqrt(4.0 * std::numbers::pi));
    return lighting;
}

Lighting anyLight() {
    Lighting lighting(kBandCount);
    for (std::size_t j = 0; j < kCoefficientCount; ++j) {
        const auto x = static_cast<double>(j);
        lighting.coefficients[j] = Vec3d(std::cos(x), std::sin(x), std::cos(2.0 * x));
    }
    return lighting;
}

ExitRadiance see(const CompressedTransfer& transfer, Transport transport,
                 const ReceiverSurface& receiver, const Lighting& lighting, const Vec3f& eye,
                 const GlossyRelightOptions& options = {}) {
    static const GltfViewTable views({.bandCount = kBandCount, .levelCount = 17, .viewCount = 24});
    ExitRadiance radiance;
    GlossyRelighter(transfer, transport, std::span(&receiver, 1), views, options)
        .relight(lighting, eye, 0, std::span(&radiance, 1));
    return radiance;
}

/// ∫ f_r cos θ_i dω_i, with none of the library's tables.
double integrateAlbedo(const Brdf& brdf, const Vec3d& view) {
    constexpr int kRows = 1000, kColumns = 400;
    double sum = 0.0;
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column) {
            const double z = (row + 0.5) / kRows;
            const double angle = 2.0 * std::numbers::pi * (column + 0.5) / kColumns;
            const double radius = std::sqrt(1.0 - z * z);
            const Vec3d incident(radius * std::cos(angle), radius * std::sin(angle), z);
            sum += evaluateBrdf(brdf, incident, view).x * z;
        }
    return sum * 2.0 * std::numbers::pi / (kRows * kColumns);
}

struct AlbedoCase {
    float cosine = 1.0f;
    MetallicRoughness surface;
};

TEST(GlossyReceivers, WhiteLightFromTheWholeSkyShowsTheDirectionalAlbedo) {
    constexpr double kHorizonFit = 0.02;  // of five bands
    const Vec3f normal = Vec3f(0.36f, 0.48f, -0.8f);
    const Frame<float> frame = frameFromNormal(normal);
    const auto open = makeTransferOf(Transport::glossy, makeMatrix(normal, isUpward));
    for (const AlbedoCase& albedoCase :
         {AlbedoCase{0.9f, {1.0f, 0.5f}}, AlbedoCase{0.4f, {1.0f, 0.8f}},
          AlbedoCase{0.7f, {0.0f, 0.6f}}, AlbedoCase{0.6f, {0.5f, 1.0f}}}) {
        const auto& [cosine, surface] = albedoCase;
        const Vec3f view(0.0f, std::sqrt(1.0f - cosine * cosine), cosine);
        const Vec3f position(1.0f, 2.0f, 3.0f);
        const Vec3f eye = position + frame.worldFromLocal(view) * 7.0f;
        const double albedo = integrateAlbedo(makeGltfBrdf(Vec3f(1.0f), surface), Vec3d(view));
        const ReceiverSurface receiver{position, normal, 0, surface};
        const ExitRadiance all = see(open, Transport::glossy, receiver, whiteLight(), eye);
        EXPECT_NEAR(all.perBaseColor.y + all.constant.y, albedo, kHorizonFit);
        EXPECT_GT(albedo, 0.5) << "nothing that could differ";
    }
}

TEST(GlossyReceivers, AMetalShowsALightWhereItsMirrorImageIs) {
    const std::array<Vec3f, 4> normals = {Vec3f(0.0f, 0.0f, 1.0f), Vec3f(0.0f, -0.6f, -0.8f),
                                          Vec3f(0.36f, 0.48f, 0.8f), Vec3f(-1.0f, 0.0f, 0.0f)};
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const Vec3f normal = normals[i];
        const Frame<float> frame = frameFromNormal(normal);
        const auto transfer = makeTransferOf(Transport::glossy, makeMatrix(normal, isUpward));
        const Vec3f toLight = Vec3f(0.6f * std::cos(2.0f * static_cast<float>(i)),
                                    0.6f * std::sin(2.0f * static_cast<float>(i)), 0.8f);
        Lighting lighting(kBandCount);
        std::vector<double> basis(kCoefficientCount);
        evaluateSh(Vec3d(frame.worldFromLocal(toLight)), kBandCount, basis);
        for (std::size_t j = 0; j < kCoefficientCount; ++j)
            lighting.coefficients[j] = Vec3d(basis[j]);
        const ReceiverSurface receiver{Vec3f(0.0f), normal, 0, MetallicRoughness{1.0f, 0.3f}};
        const auto brightness = [&](const Vec3f& view) {
            return see(transfer, Transport::glossy, receiver, lighting,
                       frame.worldFromLocal(view) * 2.0f)
                .perBaseColor.x;
        };
        const float mirrored = brightness({-toLight.x, -toLight.y, toLight.z});
        EXPECT_GT(mirrored, 1.5f * brightness(toLight));
        EXPECT_GT(mirrored, 1.5f * brightness({-toLight.y, toLight.x, toLight.z}));
        EXPECT_GT(mirrored, 1.5f * brightness({toLight.y, -toLight.x, toLight.z}));
    }
}

TEST(GlossyReceivers, ASplitReceiverTellsHowMuchOfTheEnvironmentIsSeen) {
    const Vec3f normal(0.0f, 0.6f, 0.8f);
    const Frame<float> frame = frameFromNormal(normal);
    const ReceiverSurface receiver{Vec3f(0.0f), normal, 0, MetallicRoughness{0.5f, 0.2f}};
    const GlossyRelightOptions options{.leastRoughness = 0.4};
    const auto seenOf = [&](const auto& isSeen, const Vec3f& view) {
        return see(makeTransferOf(Transport::glossyShadowed, makeMatrix(normal, isSeen)),
                   Transport::glossyShadowed, receiver, whiteLight(),
                   frame.worldFromLocal(view) * 2.0f, options);
    };

    // All, nothing, and one side.
    constexpr float kGrid = 2e-3f;
    const Vec3f view(0.6f, 0.0f, 0.8f);
    const ExitRadiance open = seenOf(isUpward, view);
    EXPECT_NEAR(open.mirrorVisibility, 1.0f, kGrid);
    EXPECT_EQ(seenOf([](const Vec3d&) { return false; }, view).mirrorVisibility, 0.0f);
    const auto isLeft = [](const Vec3d& direction) {
        return direction.z > 0.0 && direction.x < 0.0;
    };
    EXPECT_GT(seenOf(isLeft, view).mirrorVisibility, 0.85f);
    EXPECT_LT(seenOf(isLeft, Vec3f(-0.6f, 0.0f, 0.8f)).mirrorVisibility, 0.15f);

    // Nothing has bounced: specular light is the environment's alone.
    EXPECT_EQ(open.constant, Vec3f(0.0f));
    const ExitRadiance whole =
        see(makeTransferOf(Transport::glossyShadowed, makeMatrix(normal, isUpward)),
            Transport::glossyShadowed, receiver, whiteLight(), frame.worldFromLocal(view) * 2.0f);
    EXPECT_GT(whole.perBaseColor.x, open.perBaseColor.x + 0.2f);
    EXPECT_EQ(whole.mirrorVisibility, 0.0f);
}

TEST(GlossyReceivers, ASplitReceiverShowsWhatHasBouncedAsAnyOther) {
    const Vec3f normal(0.0f, 0.6f, 0.8f);
    const auto isFar = [](const Vec3d& direction) { return direction.z > 0.5; };
    const std::vector<float> direct = makeMatrix(normal, isFar);
    const std::vector<float> bounced = makeMatrix(
        normal, [&](const Vec3d& direction) { return isUpward(direction) && !isFar(direction); });
    std::vector<float> sum(direct.size());
    std::ranges::transform(direct, bounced, sum.begin(), std::plus());
    CompressedTransfer both = makeTransferOf(Transport::glossyShadowed, direct);
    both.layers.push_back(makeTransferOf(Transport::glossy, sum).layers.front());

    constexpr float kFloats = 1e-5f;
    const ReceiverSurface metal{Vec3f(0.0f), normal, 0, MetallicRoughness{1.0f, 0.2f}};
    const Lighting lighting = anyLight();
    const Vec3f eye(3.0f, 1.0f, 2.0f);
    const ExitRadiance split =
        see(both, Transport::glossy, metal, lighting, eye, {.leastRoughness = 0.4});
    const ExitRadiance bouncedAlone =
        see(makeTransferOf(Transport::glossy, bounced), Transport::glossy, metal, lighting, eye);
    for (int color = 0; color < 3; ++color) {
        EXPECT_NEAR(split.perBaseColor[color], bouncedAlone.perBaseColor[color], kFloats);
        EXPECT_NEAR(split.constant[color], bouncedAlone.constant[color], kFloats);
    }
    EXPECT_GT(split.mirrorVisibility, 0.0f);
}

TEST(GlossyReceivers, WithoutALayerOfVisibilityNothingIsSplit) {
    const Vec3f normal(0.0f, 0.0f, 1.0f);
    const auto transfer = makeTransferOf(Transport::glossy, makeMatrix(normal, isUpward));
    const ReceiverSurface metal{Vec3f(0.0f), normal, 0, MetallicRoughness{1.0f, 0.0f}};
    const Vec3f eye(1.0f, 1.0f, 2.0f);
    const ExitRadiance seen = see(transfer, Transport::glossy, metal, whiteLight(), eye);
    const ExitRadiance asked =
        see(transfer, Transport::glossy, metal, whiteLight(), eye, {.leastRoughness = 1.0});
    EXPECT_EQ(asked.perBaseColor, seen.perBaseColor);
    EXPECT_EQ(asked.constant, seen.constant);
    EXPECT_EQ(asked.mirrorVisibility, 0.0f);
    EXPECT_GT(asked.perBaseColor.x, 0.5f);
}

TEST(GlossyReceivers, RefusesALayerThatTheAssetLacksAndNamesThoseItHas) {
    const CompressedTransfer transfer =
        makeTransferOf(Transport::glossyShadowed, std::vector<float>(625));
    const ReceiverSurface receiver;
    try {
        see(transfer, Transport::glossy, receiver, whiteLight(), Vec3f(1.0f));
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::invalidOption);
        EXPECT_EQ(error.message(), "the asset holds no glossy transfer (it has glossy-shadowed)");
    }
}

}  // namespace
}  // namespace prt
