#include "prt/transport/unshadowed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "prt/base/random.h"
#include "prt/basis/sh.h"
#include "prt/math/frame.h"
#include "prt/math/quadrature.h"
#include "prt/transport/reflection.h"
#include "tests/support/scenes.h"

namespace prt {
namespace {

constexpr int kBandCount = 4;
constexpr int kIncidentBandCount = 3;
constexpr std::size_t kColumnCount = 16;
constexpr std::size_t kRowCount = 9;
constexpr double kRounding = 1e-5;  // of float sums

/// Patches that face anywhere.
Scene makePatches() {
    std::vector<test::Part> parts;
    RandomStream random(11, 0);
    for (int i = 0; i < 6; ++i) {
        const Vec3f normal = Vec3f(random.nextUnitFloat() - 0.5f, random.nextUnitFloat() - 0.5f,
                                   random.nextUnitFloat() - 0.5f)
                                 .normalized();
        parts.push_back({test::makePatch(Vec3f(static_cast<float>(i)), normal, 0.1f)});
    }
    return test::assembleScene(parts);
}

/// ∫ y_i(R ω) y_j(ω) dω by quadrature in the local frame, exact for polynomials of these degrees.
std::vector<double> integrateByHand(const Vec3f& normal) {
    constexpr int kAzimuthCount = 16;
    const Frame<double> frame = frameFromNormal(Vec3d(normal).normalized());
    std::vector<double> matrix(kRowCount * kColumnCount), local(kRowCount), world(kColumnCount);
    for (const auto& [x, weight] : gaussLegendre(8)) {
        const double z = 0.5 * (x + 1.0);
        for (int k = 0; k < kAzimuthCount; ++k) {
            const double phi = 2.0 * std::numbers::pi * k / kAzimuthCount;
            const double radius = std::sqrt(1.0 - z * z);
            const Vec3d direction(radius * std::cos(phi), radius * std::sin(phi), z);
            evaluateSh(direction, kIncidentBandCount, local);
            evaluateSh(frame.worldFromLocal(direction), kBandCount, world);
            for (std::size_t i = 0; i < kRowCount; ++i)
                for (std::size_t j = 0; j < kColumnCount; ++j)
                    matrix[i * kColumnCount + j] +=
                        local[i] * world[j] * 0.5 * weight * 2.0 * std::numbers::pi / kAzimuthCount;
        }
    }
    return matrix;
}

TEST(Unshadowed, MatricesAreTheIntegralOverTheUpperHemisphere) {
    const Scene scene = makePatches();
    const TransferField field = makeUnshadowedMatrices(scene, kBandCount, kIncidentBandCount);
    ASSERT_EQ(field.receiverCount, scene.vertexCount());
    ASSERT_EQ(field.layers.size(), 1u);
    EXPECT_EQ(field.layers[0].transport, Transport::glossyShadowed);
    EXPECT_EQ(field.layers[0].incidentBandCount, kIncidentBandCount);
    std::vector<float> row(kRowCount * kColumnCount);
    for (std::size_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
        const std::vector<double> expected = integrateByHand(scene.meshes[mesh].normals[0]);
        field.layers[0].coefficients.readRow(3 * mesh + 1, std::span(row));
        for (std::size_t k = 0; k < row.size(); ++k)
            EXPECT_NEAR(row[k], expected[k], kRounding) << mesh << " " << k;
    }
}

TEST(Unshadowed, TheCosineRowOfMatricesIsTheTransferVector) {  // C6
    const Scene scene = makePatches();
    const TransferField vectors = makeUnshadowedTransfer(scene, kBandCount);
    const TransferField matrices = makeUnshadowedMatrices(scene, kBandCount, kIncidentBandCount);
    std::vector<float> vector(kColumnCount), matrix(kRowCount * kColumnCount);
    for (std::size_t vertex = 0; vertex < scene.vertexCount(); ++vertex) {
        vectors.layers[0].coefficients.readRow(vertex, std::span(vector));
        matrices.layers[0].coefficients.readRow(vertex, std::span(matrix));
        for (std::size_t j = 0; j < kColumnCount; ++j)
            EXPECT_NEAR(kLambertResponse * matrix[2 * kColumnCount + j], vector[j], kRounding);
    }
}

}  // namespace
}  // namespace prt
