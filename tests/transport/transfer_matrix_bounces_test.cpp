#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "prt/base/error.h"
#include "prt/basis/zonal.h"
#include "prt/brdf/brdf_matrix.h"
#include "prt/transport/bake.h"
#include "prt/transport/transfer_matrices.h"
#include "tests/support/scenes.h"
#include "tests/support/transfer_matrix_checks.h"
#include "tests/transport/reflect_glossily.h"
#include "tests/transport/uniform_rays.h"

namespace prt {
namespace {

using test::BandCounts;
using test::intoLocalFrame;
using test::makeRoomScene;
using test::makeScreenScene;
using test::matrixOfVertex;
using test::reflectGlossily;

// Two means of 4096 points over visibility edges, one of the cosine and one cosine-distributed, and
// of the bounces from them.
constexpr float kCosineTolerance = 8e-3f;
// Of what a wall of 48 segments sends.
constexpr double kBowlTolerance = 2e-2;
// Sums of a thousand numbers of about 1, in float.
constexpr double kFloatTolerance = 2e-5;

TEST(TransferMatrixBounces, HoldTheDiffuseTransferInTheCosinesRow) {
    const Scene scene = makeScreenScene();
    for (int bounceCount = 0; bounceCount <= 2; ++bounceCount) {
        const TransferMatrices baked = bakeTransferMatrices(
            scene, {.incidentBandCount = 2, .sampleCount = 4096, .bounceCount = bounceCount});
        const TransferField field =
            bakeTransfer(scene, {.sampleCount = 4096, .bounceCount = bounceCount});
        const TransferLayer& layer = *field.findLayer(Transport::interreflected);
        ASSERT_EQ(field.receiverOfVertex, baked.receiverOfVertex);
        ASSERT_EQ(baked.channelCount, bounceCount > 0 ? 3 : 1);
        for (std::size_t vertex = 0; vertex < baked.receiverOfVertex.size(); vertex += 3) {
            const std::vector<float> matrix = matrixOfVertex(baked, vertex);
            for (int channel = 0; channel < baked.channelCount; ++channel) {
                const std::vector<float> transfer =
                    transferVector(field, layer, field.receiverOfVertex[vertex], channel);
                const float* row = &matrix[(static_cast<std::size_t>(channel) * 4 + 2) * 25];
                for (std::size_t j = 0; j < 25; ++j)
                    EXPECT_NEAR(kLambertResponse * row[j], transfer[j], kCosineTolerance)
                        << bounceCount << " bounces, vertex " << vertex << ", column " << j;
            }
        }
    }
}

constexpr BandCounts kGlossyBands = {3, 4};
constexpr std::size_t kRowCount = 9;
constexpr std::size_t kColumnCount = 16;
constexpr std::size_t kElementCount = kRowCount * kColumnCount;

/// What a surface sends back along a ray, [channel][j], of matrices at the vertices.
std::vector<double> radianceOf(const Scene& scene, const SurfacePoint& point,
                               const Vec3f& direction, const TransferMatrices& before) {
    std::size_t firstVertex = 0;
    for (std::size_t mesh = 0; mesh < point.mesh; ++mesh)
        firstVertex += scene.meshes[mesh].vertexCount();
    const Mesh& mesh = scene.meshes[point.mesh];
    const auto u = static_cast<double>(point.u);
    const auto v = static_cast<double>(point.v);
    const std::array<double, 3> shares = {1.0 - u - v, u, v};
    std::vector<double> radiance(3 * kColumnCount);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t corner = mesh.indices[3 * point.triangle + k];
        std::vector<float> response(3 * kRowCount);
        reflectGlossily(point, Vec3f(intoLocalFrame(-Vec3d(direction), mesh.normals[corner])),
                        response);
        const std::vector<float> matrix = matrixOfVertex(before, firstVertex + corner);
        for (std::size_t e = 0; e < 3 * kElementCount; ++e)
            radiance[e / kElementCount * kColumnCount + e % kColumnCount] +=
                shares[k] * static_cast<double>(response[e / kColumnCount]) *
                static_cast<double>(matrix[e % matrix.size()]);
    }
    return radiance;
}

/// Ray by ray what comes in at a receiver, [channel][i][j].
std::vector<double> sumBounce(const Scene& scene, const RayScene& rays, const Receiver& site,
                              const TransferMatrices& before) {
    const RayStream stream = test::traceUniformRays(rays, site, 1);
    const double weight = 2.0 * std::numbers::pi / static_cast<double>(stream.size());
    std::vector<double> sums(3 * kElementCount);
    std::vector<double> rows(kRowCount);
    std::vector<double> light(kColumnCount);
    std::vector<Hit> hit(1);
    for (std::uint32_t ray = 0; ray < stream.size(); ++ray) {
        const Vec3f direction = test::directionOf(stream, ray);
        std::vector<double> radiance(3 * kColumnCount);
        if (stream.tFar[ray] > 0.0f) {
            evaluateSh(Vec3d(direction), kGlossyBands.light, light);
            for (std::size_t e = 0; e < radiance.size(); ++e)
                radiance[e] = light[e % kColumnCount];
        } else {
            rays.findClosest(stream, std::vector<std::uint32_t>{ray}, hit);
            if (hit[0].escaped || hit[0].backFace) continue;
            radiance = radianceOf(scene, hit[0].point, direction, before);
        }
        evaluateSh(intoLocalFrame(Vec3d(direction), site.normal), kGlossyBands.incident, rows);
        for (std::size_t e = 0; e < sums.size(); ++e)
            sums[e] += weight * rows[e / kColumnCount % kRowCount] *
                       radiance[e / kElementCount * kColumnCount + e % kColumnCount];
    }
    return sums;
}

TEST(TransferMatrixBounces, BringWhatSurfacesReflectTowardsTheReceiver) {
    const Scene scene = makeRoomScene();
    const RayScene rays(scene);
    const Receivers receivers = placeReceivers(scene, rays);
    TransferMatrixOptions options{.incidentBandCount = 3, .bandCount = 4};
    options.reflection = reflectGlossily;
    TransferMatrices before = bakeTransferMatrices(scene, options);
    for (options.bounceCount = 1; options.bounceCount <= 2; ++options.bounceCount) {
        TransferMatrices baked = bakeTransferMatrices(scene, options);
        double largestChange = 0.0;
        for (std::size_t receiver = 0; receiver < receivers.fronts.size(); receiver += 17) {
            const std::vector<double> expected =
                sumBounce(scene, rays, receivers.fronts[receiver], before);
            std::vector<float> matrix(expected.size());
            baked.matrices.readRow(receiver, std::span(matrix));
            std::vector<float> last(before.matrices.columnCount());
            before.matrices.readRow(receiver, std::span(last));
            for (std::size_t e = 0; e < expected.size(); ++e) {
                ASSERT_NEAR(matrix[e], expected[e], kFloatTolerance)
                    << options.bounceCount << " bounces, receiver " << receiver << ", number " << e;
                largestChange =
                    std::max(largestChange,
                             std::abs(expected[e] - static_cast<double>(last[e % last.size()])));
            }
        }
        EXPECT_GT(largestChange, 0.01) << "bounces that do nothing are not tested";
        before = std::move(baked);
    }
}

TEST(TransferMatrixBounces, OfABowlHaveItsClosedFormFromEveryDirection) {  // A9
    // Every point of a bowl gathers the same share of the sky, s = (1 − 0.4)/2, and its wall is as
    // bright everywhere: ρ T, where T = s Σ (ρ (1 − s))^k over the bounces before.
    constexpr double kAlbedo = 0.7;
    constexpr double kSky = 0.3;
    const Scene scene = test::assembleScene({{makeBowl(0.4f, 48), Vec3f(0.7f, 0.7f, 0.7f)}});
    TransferMatrixOptions options{.incidentBandCount = 4, .bandCount = 1, .sampleCount = 256};
    const TransferMatrices direct = bakeTransferMatrices(scene, options);
    const std::vector<double> hemisphere = capZonal(4, std::numbers::pi / 2.0);
    const double white = std::sqrt(4.0 * std::numbers::pi);
    double transfer = 0.0;
    for (options.bounceCount = 1; options.bounceCount <= 3; ++options.bounceCount) {
        transfer = kSky + kAlbedo * (1.0 - kSky) * transfer;
        const double wall = kAlbedo * transfer;
        const TransferMatrices baked = bakeTransferMatrices(scene, options);
        double largest = 0.0;
        for (std::size_t vertex = 0; vertex < baked.receiverOfVertex.size(); vertex += 11) {
            const std::vector<float> matrix = matrixOfVertex(baked, vertex);
            const std::vector<float> visible = matrixOfVertex(direct, vertex);
            for (std::size_t i = 0; i < visible.size(); ++i) {
                const auto l = static_cast<std::size_t>(shDegree(static_cast<int>(i)));
                const double open = white * static_cast<double>(visible[i]);
                const double all = i == l * (l + 1) ? hemisphere[l] : 0.0;
                largest = std::max(largest, std::abs(white * static_cast<double>(matrix[i]) -
                                                     (open + wall * (all - open))));
            }
        }
        EXPECT_LT(largest, kBowlTolerance) << options.bounceCount << " bounces";
    }
}

// The materials and views here stand in it, so that nothing is interpolated, and nothing fitted.
constexpr GltfViewTableOptions kMaterialTable{
    .bandCount = 3,
    .levelCount = 11,
    .viewCount = 6,
    .horizonWeight = 1.0,
    .quadrature = {.polarNodeCount = 32, .azimuthNodeCount = 16}};

TEST(TransferMatrixBounces, FollowGltfMaterials) {
    Scene scene = makeRoomScene();
    scene.materials[1].metallicFactor = 1.0f;
    scene.materials[1].roughnessFactor = 0.4f;
    scene.materials[2].metallicFactor = 0.0f;
    scene.materials[2].roughnessFactor = 0.7f;
    const SurfaceReflection reflection =
        gltfReflection(scene, std::make_shared<GltfViewTable>(kMaterialTable));
    const double angle = 0.5 * std::numbers::pi * (1.0 - 0.4 * 0.4);  // three steps of five
    const Vec3d view(0.6 * std::sin(angle), -0.8 * std::sin(angle), std::cos(angle));
    for (std::size_t mesh = 1; mesh <= 2; ++mesh) {
        std::vector<float> response(3 * 9);
        reflection({mesh, 0, 0.25f, 0.25f}, Vec3f(view), response);
        const Material& material = scene.materials[mesh];
        const auto expected =
            projectBrdfView(makeGltfBrdf(evaluateAlbedo(scene, {mesh, 0, 0.25f, 0.25f}),
                                         {material.metallicFactor, material.roughnessFactor}),
                            view, 3, kMaterialTable.quadrature);
        for (std::size_t channel = 0; channel < 3; ++channel)
            for (std::size_t i = 0; i < 9; ++i)
                EXPECT_NEAR(response[9 * channel + i], expected[channel][i], kFloatTolerance)
                    << "mesh " << mesh << ", coefficient " << i;
    }
}

/// E/π at the vertices of a mesh in a white sky, largest over the mesh.
double largestIrradiance(const Scene& scene, const TransferMatrixOptions& options) {
    const TransferMatrices baked = bakeTransferMatrices(scene, options);
    const auto rowCount = static_cast<std::size_t>(shCoefficientCount(baked.incidentBandCount));
    double largest = 0.0;
    for (std::size_t vertex = 0; vertex < baked.receiverOfVertex.size(); ++vertex) {
        const std::vector<float> matrix = matrixOfVertex(baked, vertex);
        for (std::size_t channel = 0; channel < 3; ++channel)
            largest = std::max(largest, std::sqrt(4.0 * std::numbers::pi) *
                                            static_cast<double>(kLambertResponse *
                                                                matrix[channel * rowCount + 2]));
    }
    return largest;
}

TEST(TransferMatrixBounces, OfWhiteMetalAddNoLight) {
    // Five bands hold a lobe of roughness ½ to some hundredths.
    constexpr double kBandLimit = 0.03;
    Scene scene = test::assembleScene({{makeBowl(0.4f, 12), Vec3f(1.0f, 1.0f, 1.0f)}});
    scene.materials[0].metallicFactor = 1.0f;
    const auto table = std::make_shared<GltfViewTable>(GltfViewTableOptions{
        .levelCount = 3, .viewCount = 16, .quadrature = kMaterialTable.quadrature});
    for (const float roughness : {0.5f, 1.0f}) {
        scene.materials[0].roughnessFactor = roughness;
        TransferMatrixOptions options{.bandCount = 1, .sampleCount = 256};
        options.reflection = gltfReflection(scene, table);
        double last = 0.3;  // its share of the sky
        for (options.bounceCount = 1; options.bounceCount <= 8; options.bounceCount *= 2) {
            const double largest = largestIrradiance(scene, options);
            EXPECT_GT(largest, last) << "roughness " << roughness;
            EXPECT_LT(largest, 1.0 + kBandLimit) << "roughness " << roughness;
            last = largest;
        }
    }
}

TEST(TransferMatrixBounces, AreTheSameForAnyNumberOfThreads) {  // C10
    const Scene scene = makeScreenScene();
    TransferMatrixOptions options{.sampleCount = 64, .bounceCount = 2, .threadCount = 1};
    const TransferMatrices one = bakeTransferMatrices(scene, options);
    options.threadCount = 3;
    EXPECT_TRUE(one.matrices == bakeTransferMatrices(scene, options).matrices);
}

TEST(TransferMatrixBounces, TellHowFarTheyAreAndCanBeCancelled) {
    const Scene scene = makeRoomScene();
    std::vector<std::string> stages;
    TransferMatrixOptions options{.sampleCount = 16, .bounceCount = 2};
    options.progress = [&](const Progress& progress) {
        if (stages.empty() || stages.back() != progress.stage) stages.emplace_back(progress.stage);
        return true;
    };
    bakeTransferMatrices(scene, options);
    EXPECT_EQ(stages, (std::vector<std::string>{"trace", "bounce 1", "bounce 2"}));
    options.progress = [](const Progress& progress) { return progress.stage != "bounce 1"; };
    try {
        bakeTransferMatrices(scene, options);
        ADD_FAILURE() << "it was not cancelled";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cancelled);
    }
}

TEST(TransferMatrixBounces, NeedTwoBandsUnderLambertsLaw) {
    const Scene scene = makeRoomScene();
    for (const TransferMatrixOptions& options :
         {TransferMatrixOptions{.bounceCount = -2},
          TransferMatrixOptions{.incidentBandCount = 1, .bounceCount = 1}}) {
        try {
            bakeTransferMatrices(scene, options);
            ADD_FAILURE() << "it was baked";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::invalidOption);
        }
    }
}

}  // namespace
}  // namespace prt
