#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "prt/basis/zonal.h"
#include "prt/transport/reflection.h"
#include "prt/transport/transfer_matrices.h"
#include "tests/support/scenes.h"
#include "tests/transport/uniform_rays.h"

namespace prt {
namespace {

using test::matrixOfVertex;

constexpr LobeQuadratureOptions kCoarse{.polarNodeCount = 32, .azimuthNodeCount = 16};

using Tables = std::vector<std::shared_ptr<const BrdfViewTable>>;

std::shared_ptr<const BrdfViewTable> makeTable(const BrdfLobe& lobe, int bandCount = 5) {
    return std::make_shared<BrdfViewTable>(
        Brdf{.lobes = {lobe}},
        BrdfViewTableOptions{.bandCount = bandCount, .viewCount = 16, .quadrature = kCoarse});
}

LambertLobe lambertOf(const Material& material) {
    return {.albedo = Vec3d(material.baseColorFactor.x, material.baseColorFactor.y,
                            material.baseColorFactor.z)};
}

TEST(BrdfReflection, OfLambertTablesIsThatOfLambertsLaw) {
    // What five bands miss of the clamped cosine, 0.02 of incident light at most, and two bounces
    // off surfaces that hide a third of what another sees.
    constexpr double kBandLimit = 5e-3;
    const Scene scene = test::makeRoomScene();
    TransferMatrixOptions options{.bandCount = 3, .sampleCount = 256, .bounceCount = 2};
    const TransferMatrices expected = bakeTransferMatrices(scene, options);
    Tables tables;
    for (const Material& material : scene.materials)
        tables.push_back(makeTable(lambertOf(material)));
    options.reflection = brdfReflection(scene, tables);
    const TransferMatrices baked = bakeTransferMatrices(scene, options);
    options.bounceCount = 0;
    const TransferMatrices direct = bakeTransferMatrices(scene, options);
    double bounced = 0.0;
    for (std::size_t vertex = 0; vertex < baked.receiverOfVertex.size(); vertex += 3) {
        const std::vector<float> matrix = matrixOfVertex(baked, vertex);
        const std::vector<float> lambert = matrixOfVertex(expected, vertex);
        const std::vector<float> visible = matrixOfVertex(direct, vertex);
        for (std::size_t e = 0; e < matrix.size(); ++e) {
            EXPECT_NEAR(matrix[e], lambert[e], kBandLimit) << "vertex " << vertex << ", " << e;
            bounced = std::max(
                bounced, static_cast<double>(std::abs(lambert[e] - visible[e % visible.size()])));
        }
    }
    EXPECT_GT(bounced, 0.1) << "bounces that do nothing are not tested";
}

TEST(BrdfReflection, LeavesMaterialsWithoutATableAsTheyAre) {
    Scene scene = test::makeRoomScene();
    scene.materials[1].metallicFactor = 0.75f;
    scene.materials[1].roughnessFactor = 0.5f;
    const auto gltf = std::make_shared<GltfViewTable>(GltfViewTableOptions{
        .bandCount = 3, .levelCount = 3, .viewCount = 16, .quadrature = kCoarse});
    Tables tables(scene.materials.size());
    tables[2] = makeTable(PhongLobe{.albedo = Vec3d(0.2, 0.5, 0.8), .exponent = 9.0}, 3);
    const SurfaceReflection mixed = brdfReflection(scene, tables, gltf);
    const SurfaceReflection unchanged = gltfReflection(scene, gltf);
    const Vec3f view(0.48f, -0.6f, 0.64f);
    std::vector<float> ofTable(27);
    tables[2]->addResponse(view, ofTable);
    for (std::size_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
        const SurfacePoint point{mesh, 0, 0.25f, 0.25f};
        std::vector<float> response(27), expected(27);
        mixed(point, view, response);
        unchanged(point, view, expected);
        EXPECT_EQ(response, scene.meshes[mesh].material == 2 ? ofTable : expected) << mesh;
        EXPECT_NE(expected, ofTable);
    }
}

/// E/π at the vertices of a scene in a white sky.
struct Range {
    double least = 10.0;
    double largest = 0.0;
};
Range measureBowl(const Scene& scene, const SurfaceReflection& reflection, int bounceCount,
                  int sampleCount) {
    TransferMatrixOptions options{
        .bandCount = 1, .sampleCount = sampleCount, .bounceCount = bounceCount};
    options.reflection = reflection;
    const TransferMatrices baked = bakeTransferMatrices(scene, options);
    const double white = std::sqrt(4.0 * std::numbers::pi) * static_cast<double>(kLambertResponse);
    Range range;
    for (std::size_t vertex = 0; vertex < baked.receiverOfVertex.size(); ++vertex) {
        const double irradiance = white * static_cast<double>(matrixOfVertex(baked, vertex)[2]);
        range.least = std::min(range.least, irradiance);
        range.largest = std::max(range.largest, irradiance);
    }
    return range;
}

TEST(BrdfReflection, InABowlHasItsClosedForm) {  // A9
    constexpr double kAlbedo = 0.7;
    constexpr double kSky = 0.3;
    // Of a thousand rays over the edge of the sky, and of what five bands miss near the horizon.
    constexpr double kTolerance = 2e-2;
    const Scene scene = test::assembleScene({{makeBowl(0.4f, 24)}});
    const SurfaceReflection reflection =
        brdfReflection(scene, {makeTable(LambertLobe{.albedo = Vec3d(kAlbedo)})});
    double transfer = kSky;
    for (int bounceCount = 1; bounceCount <= 3; ++bounceCount) {
        transfer = kSky + kAlbedo * (1.0 - kSky) * transfer;
        const Range range = measureBowl(scene, reflection, bounceCount, 1024);
        EXPECT_NEAR(range.least, transfer, kTolerance) << bounceCount << " bounces";
        EXPECT_NEAR(range.largest, transfer, kTolerance) << bounceCount << " bounces";
    }
}

TEST(BrdfReflection, OfWhiteLobesAddsNoLight) {
    // Five bands hold these lobes to some hundredths.
    constexpr double kBandLimit = 0.03;
    const Scene scene = test::assembleScene({{makeBowl(0.4f, 12)}});
    for (const BrdfLobe& lobe : {BrdfLobe(LambertLobe{.albedo = Vec3d(1.0)}),
                                 BrdfLobe(PhongLobe{.albedo = Vec3d(1.0), .exponent = 8.0}),
                                 BrdfLobe(GgxLobe{.f0 = Vec3d(1.0), .alpha = 0.3})}) {
        const SurfaceReflection reflection = brdfReflection(scene, {makeTable(lobe)});
        double last = 0.3;  // its share of the sky
        for (int bounceCount = 1; bounceCount <= 8; bounceCount *= 2) {
            const double largest = measureBowl(scene, reflection, bounceCount, 256).largest;
            EXPECT_GT(largest, last) << lobe.index();
            EXPECT_LT(largest, 1.0 + kBandLimit) << lobe.index();
            last = largest;
        }
    }
}

}  // namespace
}  // namespace prt
