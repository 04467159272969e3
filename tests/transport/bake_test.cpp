#include "prt/transport/bake.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "prt/base/error.h"
#include "prt/basis/sh.h"
#include "prt/basis/zonal.h"
#include "prt/scene/procedural.h"
#include "tests/support/scenes.h"

namespace prt {
namespace {

using test::assembleScene;
using test::makePatch;
using test::makeQuad;
using test::makeRoomScene;
using test::transformScene;

constexpr Vec3f kUp(0.0f, 0.0f, 1.0f);
// Four standard errors of a mean of 4096 scrambled net points over a
// visibility edge: about N^(−3/4).
constexpr double kQmcTolerance = 4e-3;
// Exit radiance of unit radiance from everywhere: L_00 = √(4π).
const double kWhiteSky = std::sqrt(4.0 * std::numbers::pi);

BakeOptions quickOptions(Transport transport) {
    BakeOptions options;
    options.transport = transport;
    options.sampleCount = 4096;
    return options;
}

const TransferLayer& layerOf(const TransferField& field, Transport transport) {
    const TransferLayer* layer = field.findLayer(transport);
    EXPECT_NE(layer, nullptr);
    return *layer;
}

std::vector<float> vertexTransfer(const TransferField& field, Transport transport,
                                  std::size_t vertex, int channel = 0) {
    return transferVector(field, layerOf(field, transport), field.receiverOfVertex[vertex],
                          channel);
}

/// B of a vertex under unit radiance from everywhere.
double whiteSkyRadiance(const TransferField& field, Transport transport, std::size_t vertex) {
    return kWhiteSky * static_cast<double>(vertexTransfer(field, transport, vertex)[0]);
}

TEST(BakeShadowed, UnshadowedPatchHasTheClosedFormTransfer) {  // A3, T-14
    const Scene scene = assembleScene({{makePatch({0, 0, 0}, Vec3f(0.6f, -0.64f, 0.48f), 0.1f)}});
    const TransferField field = bakeTransfer(scene, quickOptions(Transport::shadowed));
    std::vector<float> expected(25);
    unshadowedTransfer(Vec3f(0.6f, -0.64f, 0.48f), 5, expected);
    for (std::size_t i = 0; i < 25; ++i)
        EXPECT_NEAR(vertexTransfer(field, Transport::shadowed, 0)[i], expected[i], 1e-3f)
            << "coefficient " << i;
}

TEST(BakeShadowed, PlaneBesideAnInfiniteWall) {  // inventory 4.8
    // A wall in the plane x = 0 that hides the half of the sky with x < 0.
    const Scene scene =
        assembleScene({{makePatch({1e-3f, 0, 0}, kUp, 1e-4f)},
                       {makeQuad({0, -10, -1}, {0, 10, -1}, {0, 10, 20}, {0, -10, 20})}});
    BakeOptions options = quickOptions(Transport::shadowed);
    const TransferField field = bakeTransfer(scene, options);
    constexpr std::array<double, 25> kExpected = {
        .1410474, 0, .1628675,   -.10368507, 0,          0,         .07884789, -.13656944, 0,
        0,        0, 0,          0,          -.09698962, 0,         .02504223, 0,          0,
        0,        0, -.01763092, -.04181759, 0,          .03687772, 0};
    for (std::size_t i = 0; i < 25; ++i)
        EXPECT_NEAR(vertexTransfer(field, Transport::shadowed, 0)[i], kExpected[i], 2e-3)
            << "coefficient " << i;
}

TEST(BakeShadowed, SkyViewBesideALongWall) {  // A8
    const auto skyView = [](float distance, float height) {
        const float halfLength =
            100.0f * height;  // hides all but 1e-4 of what an endless wall hides
        const Scene scene =
            assembleScene({{makePatch({distance, 0, 0}, kUp, 1e-3f)},
                           {makeQuad({0, -halfLength, 0}, {0, halfLength, 0},
                                     {0, halfLength, height}, {0, -halfLength, height})}});
        return whiteSkyRadiance(bakeTransfer(scene, quickOptions(Transport::shadowed)),
                                Transport::shadowed, 0);
    };
    EXPECT_NEAR(skyView(1, 1), .853553, kQmcTolerance);
    EXPECT_NEAR(skyView(1, 3), .658114, kQmcTolerance);
    EXPECT_NEAR(skyView(3, 1), .974342, kQmcTolerance);
}

TEST(BakeShadowed, PointBelowASphere) {  // A6
    // A unit sphere two above the point: T_l = 2 √((2l+1)/4π) ∫₀^√¾ t P_l(t) dt, the mirror of a
    // disc around the zenith.
    const Scene scene =
        assembleScene({{makePatch({0, 0, 0}, kUp, 1e-3f)}, {makeSphere({0, 0, 2}, 1.0f, 56)}});
    const TransferField field = bakeTransfer(scene, quickOptions(Transport::shadowed));
    constexpr std::array<double, 5> kZonal = {.21157109, .21157109, .02956796, -.12119257,
                                              -.13388483};
    for (int l = 0; l < 5; ++l)
        for (int m = -l; m <= l; ++m)
            EXPECT_NEAR(vertexTransfer(field, Transport::shadowed,
                                       0)[static_cast<std::size_t>(shIndex(l, m))],
                        m == 0 ? kZonal[static_cast<std::size_t>(l)] : 0.0, 2e-3)
                << "l " << l << ", m " << m;
}

TEST(BakeShadowed, PointBesideASphere) {  // A7: white-sky occlusion is cos θ (r/d)²
    const auto occlusion = [](float lateral, float height, float radius) {
        const Scene scene = assembleScene(
            {{makePatch({0, 0, 0}, kUp, 1e-3f)}, {makeSphere({lateral, 0, height}, radius, 56)}});
        return 1.0 - whiteSkyRadiance(bakeTransfer(scene, quickOptions(Transport::shadowed)),
                                      Transport::shadowed, 0);
    };
    EXPECT_NEAR(occlusion(1, 2, 1), .178885, kQmcTolerance);
    EXPECT_NEAR(occlusion(2, 1.5f, 1), .096000, kQmcTolerance);
    EXPECT_NEAR(occlusion(3, 1, 1), .031623, kQmcTolerance);
}

TEST(BakeShadowed, DiscAbove) {  // inventory 4.8: 1 − r²/(r² + h²)
    Mesh disc;
    constexpr int kSegmentCount = 256;
    disc.positions = {{0, 0, 2}};
    for (int i = 0; i < kSegmentCount; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kSegmentCount;
        disc.positions.emplace_back(static_cast<float>(std::cos(angle)),
                                    static_cast<float>(std::sin(angle)), 2.0f);
        const auto a = static_cast<std::uint32_t>(1 + i);
        const auto b = static_cast<std::uint32_t>(1 + (i + 1) % kSegmentCount);
        disc.indices.insert(disc.indices.end(), {0u, a, b});
    }
    disc.normals.assign(disc.positions.size(), kUp);
    const Scene scene = assembleScene({{makePatch({0, 0, 0}, kUp, 1e-3f)}, {disc}});
    const TransferField field = bakeTransfer(scene, quickOptions(Transport::shadowed));
    EXPECT_NEAR(whiteSkyRadiance(field, Transport::shadowed, 0), 0.8, kQmcTolerance);
}

TEST(BakeShadowed, ClosedBoxesAreDarkAtAnySizeAndPlace) {  // A12
    for (const double scale : {1e-3, 1.0, 1e3})
        for (const bool far : {false, true})
            for (const bool turned : {false, true}) {
                const Mat3d rotation =
                    turned ? rotationX(0.3) * rotationY(1.1) * rotationZ(-0.7) : Mat3d();
                const Vec3f offset =
                    far ? Vec3f(1e5f, -2e4f, 3e4f) * static_cast<float>(scale) : Vec3f(0.0f);
                const Scene scene = transformScene(
                    assembleScene({{makeBox({-1, -0.5f, -0.7f}, {1, 0.5f, 0.7f}, true, 6)}}),
                    rotation, scale, offset);
                BakeOptions options = quickOptions(Transport::shadowed);
                options.sampleCount = 256;
                const TransferField field = bakeTransfer(scene, options);
                float largest = 0.0f;
                for (const float value : copyRows<float>(field.layers[0].coefficients))
                    largest = std::max(largest, std::abs(value));
                EXPECT_EQ(largest, 0.0f)
                    << "scale " << scale << ", far " << far << ", turned " << turned;
            }
}

TEST(BakeInterreflected, ConvexObjectsGainNothing) {
    const Scene scene = assembleScene({{makeSphere({0, 0, 0}, 1.0f, 32), {1, 1, 1}}});
    BakeOptions options = quickOptions(Transport::interreflected);
    options.sampleCount = 256;
    options.bounceCount = 3;
    const TransferField field = bakeTransfer(scene, options);
    const TransferLayer& direct = layerOf(field, Transport::shadowed);
    const TransferLayer& bounced = layerOf(field, Transport::interreflected);
    for (std::size_t receiver = 0; receiver < field.receiverCount; ++receiver)
        for (int channel = 0; channel < 3; ++channel)
            for (std::size_t i = 0; i < 25; ++i)
                ASSERT_EQ(transferVector(field, direct, receiver, 0)[i],
                          transferVector(field, bounced, receiver, channel)[i]);
}

/// Transfer after each number of bounces inside a spherical bowl, receiver's albedo outside (A13,
/// C6): the indirect part is the same everywhere, zonal, (1/π) (1−c²)/4 · ρ Σ_{k<b} (ρf)^k · z_l
/// with f = (1+c)/2.
class BowlTest : public testing::Test {
  protected:
    static constexpr float kOpening = 0.2f;
    static constexpr double kAlbedo = 0.8;

    static TransferField bake(int bounceCount) {
        const auto albedo = static_cast<float>(kAlbedo);
        const Scene scene = assembleScene({{makeBowl(kOpening, 64), {albedo, albedo, albedo}}});
        BakeOptions options;
        options.transport = Transport::interreflected;
        options.sampleCount = 512;
        options.bounceCount = bounceCount;
        return bakeTransfer(scene, options);
    }

    static double indirectZonal(int l, int bounceCount) {
        const double c = static_cast<double>(kOpening);
        const double rhoF = kAlbedo * (1.0 + c) / 2.0;
        const double series = bounceCount == kInfiniteBounces
                                  ? 1.0 / (1.0 - rhoF)
                                  : (1.0 - std::pow(rhoF, bounceCount)) / (1.0 - rhoF);
        return std::numbers::inv_pi * (1.0 - c * c) / 4.0 * kAlbedo * series *
               clampedCosineZonal(l + 1)[static_cast<std::size_t>(l)];
    }
};

TEST_F(BowlTest, EveryBounceOfEveryBandHasItsClosedForm) {  // A13, T-17, C8
    for (const int bounceCount : {1, 2, 5, kInfiniteBounces}) {
        const TransferField field = bake(bounceCount);
        const TransferLayer& direct = layerOf(field, Transport::shadowed);
        const TransferLayer& bounced = layerOf(field, Transport::interreflected);
        for (int l = 0; l < 5; ++l)
            for (int m = -l; m <= l; ++m) {
                const auto i = static_cast<std::size_t>(shIndex(l, m));
                const double expected = m == 0 ? indirectZonal(l, bounceCount) : 0.0;
                double sum = 0.0;
                for (std::size_t receiver = 0; receiver < field.receiverCount; ++receiver) {
                    const double indirect =
                        static_cast<double>(transferVector(field, bounced, receiver, 1)[i]) -
                        static_cast<double>(transferVector(field, direct, receiver, 0)[i]);
                    sum += indirect;
                    // One receiver: 512 rays to a smooth field, where the facets
                    // hide up to 2 % of it.
                    ASSERT_NEAR(indirect, expected, 8e-3)
                        << "l " << l << " m " << m << " bounces " << bounceCount;
                }
                // The facets of 64 segments cost a fifth of a percent.
                EXPECT_NEAR(sum / static_cast<double>(field.receiverCount), expected,
                            5e-3 * indirectZonal(0, bounceCount))
                    << "l " << l << " m " << m << " bounces " << bounceCount;
            }
    }
}

TEST_F(BowlTest, WhiteSkyTotalIsTheSameEverywhere) {  // ρ(1−f)/(1−ρf), with ρ outside
    const TransferField field = bake(kInfiniteBounces);
    const double f = (1.0 + static_cast<double>(kOpening)) / 2.0;
    double sum = 0.0;
    for (std::size_t vertex = 0; vertex < field.receiverOfVertex.size(); ++vertex) {
        const double radiance = whiteSkyRadiance(field, Transport::interreflected, vertex);
        EXPECT_NEAR(radiance, (1.0 - f) / (1.0 - kAlbedo * f), 2e-2);
        sum += radiance;
    }
    EXPECT_NEAR(sum / static_cast<double>(field.receiverOfVertex.size()),
                (1.0 - f) / (1.0 - kAlbedo * f), 3e-3);
}

TEST(BakeInterreflected, WhiteFurnaceIsWhiteOnAnyMesh) {  // A9
    Scene scene = assembleScene(
        {{makeBowl(0.3f, 32), {1, 1, 1}, true},
         {makeSphere({0.1f, 0.2f, -0.4f}, 0.35f, 24), {1, 1, 1}},
         {makeBox({-0.6f, -0.5f, -0.2f}, {-0.35f, -0.2f, 0.3f}, false, 4), {1, 1, 1}}});
    BakeOptions options;
    options.sampleCount = 256;
    options.bounceCount = kInfiniteBounces;
    const TransferField field = bakeTransfer(scene, options);
    double sum = 0.0;
    for (std::size_t vertex = 0; vertex < field.receiverOfVertex.size(); ++vertex) {
        const double radiance = whiteSkyRadiance(field, Transport::interreflected, vertex);
        EXPECT_NEAR(radiance, 1.0, 2e-2) << "vertex " << vertex;
        sum += radiance;
    }
    EXPECT_NEAR(sum / static_cast<double>(field.receiverOfVertex.size()), 1.0, 1e-3);
}

TEST(BakeInterreflected, EachBounceAddsLightAndNeverMoreThanAlbedoAllows) {  // C8
    const Scene scene = makeRoomScene();
    BakeOptions options;
    options.sampleCount = 64;
    options.bandCount = 1;
    double last = 0.0;
    for (const int bounceCount : {0, 1, 2, 4}) {
        options.bounceCount = bounceCount;
        const TransferField field = bakeTransfer(scene, options);
        double sum = 0.0;
        for (std::size_t vertex = 0; vertex < field.receiverOfVertex.size(); ++vertex) {
            const double radiance = whiteSkyRadiance(field, Transport::interreflected, vertex);
            EXPECT_LE(radiance, 1.0 + 1e-5);
            sum += radiance;
        }
        EXPECT_GT(sum, last);
        last = sum;
        if (bounceCount > 0) continue;
        const TransferLayer& direct = layerOf(field, Transport::shadowed);
        EXPECT_EQ(transferVector(field, layerOf(field, Transport::interreflected), 0, 2)[0],
                  transferVector(field, direct, 0, 0)[0]);
    }
}

TEST(BakeInterreflected, ColourBleedsFromTheOtherSurfaceOnly) {  // C6
    // A white floor beside a wall that is red: the floor's own albedo is not
    // in its transfer, the wall's is.
    const auto bake = [](const Vec3f& floorAlbedo, const Vec3f& wallAlbedo) {
        const Scene scene =
            assembleScene({{makePatch({0.5f, 0, 0}, kUp, 1e-2f), floorAlbedo},
                           {makeQuad({0, -5, 0}, {0, 5, 0}, {0, 5, 5}, {0, -5, 5}), wallAlbedo}});
        BakeOptions options = quickOptions(Transport::interreflected);
        options.bounceCount = 1;
        const TransferField field = bakeTransfer(scene, options);
        return Vec3f(vertexTransfer(field, Transport::interreflected, 0, 0)[0],
                     vertexTransfer(field, Transport::interreflected, 0, 1)[0],
                     vertexTransfer(field, Transport::interreflected, 0, 2)[0]);
    };
    const Vec3f red = bake({1, 1, 1}, {0.8f, 0, 0});
    EXPECT_GT(red.x, 1.1f * red.y);
    EXPECT_EQ(red.y, red.z);
    EXPECT_EQ(bake({0.1f, 0.2f, 0.3f}, {0.8f, 0, 0}), red);
    // Twice the albedo, twice the bounce.
    const Vec3f dim = bake({1, 1, 1}, {0.4f, 0, 0});
    EXPECT_NEAR(red.x - red.y, 2.0f * (dim.x - dim.y), 1e-5f);
}

TEST(BakeInterreflected, BackFacesBlockAndReflectNothing) {  // C11
    // A floor under a roof that turns its back to it.
    const Scene scene = assembleScene(
        {{makeQuad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}), {1, 1, 1}},
         {makeQuad({-9, -9, 0.5f}, {9, -9, 0.5f}, {9, 9, 0.5f}, {-9, 9, 0.5f}), {1, 1, 1}}});
    const TransferField field = bakeTransfer(scene, quickOptions(Transport::interreflected));
    EXPECT_LT(whiteSkyRadiance(field, Transport::shadowed, 0), 0.05);
    EXPECT_EQ(whiteSkyRadiance(field, Transport::interreflected, 0),
              whiteSkyRadiance(field, Transport::shadowed, 0));
}

TEST(BakeInterreflected, ThinWallsDoNotLeak) {
    // A closed double-sided box, bright outside: inside, its walls and what they hold are dark.
    const Scene scene =
        assembleScene({{makePatch({0, 0, 0}, kUp, 0.1f), {1, 1, 1}},
                       {makeBox({-1, -1, -1}, {1, 1, 1}, false, 4), {1, 1, 1}, true}});
    const TransferField field = bakeTransfer(scene, quickOptions(Transport::interreflected));
    EXPECT_EQ(whiteSkyRadiance(field, Transport::interreflected, 0), 0.0);
    EXPECT_NEAR(whiteSkyRadiance(field, Transport::interreflected, 3), 1.0, 1e-5);
}

TEST(BakeInterreflected, DoubleSidedSheetsReflectFromBothSides) {
    // A patch looks up at a sheet lit from below by the sky, of which the patch hides nothing.
    const auto bake = [](bool doubleSided) {
        const Scene scene =
            assembleScene({{makePatch({0, 0, 0}, kUp, 1e-3f), {1, 1, 1}},
                           {makeQuad({-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}),
                            {0.5f, 0.5f, 0.5f},
                            doubleSided}});
        return bakeTransfer(scene, quickOptions(Transport::interreflected));
    };
    const TransferField field = bake(true);
    const double visible = whiteSkyRadiance(field, Transport::shadowed, 0);
    EXPECT_NEAR(whiteSkyRadiance(field, Transport::interreflected, 0),
                visible + 0.5 * (1.0 - visible), 1e-3);
    EXPECT_EQ(whiteSkyRadiance(bake(false), Transport::interreflected, 0), visible);
}

TEST(Conventions, C6_TransferContainsOneOverPi) {
    const Scene scene = assembleScene({{makePatch({0, 0, 0}, kUp, 0.1f), {0.3f, 0.3f, 0.3f}}});
    const TransferField field = bakeTransfer(scene, quickOptions(Transport::shadowed));
    EXPECT_NEAR(vertexTransfer(field, Transport::shadowed, 0)[0], 0.282094792, 1e-6);
    EXPECT_NEAR(vertexTransfer(field, Transport::shadowed, 0)[2], 0.325735008, 1e-4);
}

TEST(Conventions, C10_SameSeedSameBitsForAnyThreadCount) {  // C1 of the reliability programme
    const Scene scene = makeRoomScene();
    BakeOptions options;
    options.sampleCount = 32;
    options.bandCount = 3;
    options.threadCount = 1;
    const TransferField reference = bakeTransfer(scene, options);
    for (const int threadCount : {2, 3, 8}) {
        options.threadCount = threadCount;
        const TransferField field = bakeTransfer(scene, options);
        ASSERT_EQ(field.layers.size(), reference.layers.size());
        for (std::size_t i = 0; i < field.layers.size(); ++i)
            EXPECT_TRUE(field.layers[i].coefficients == reference.layers[i].coefficients)
                << threadCount << " threads";
    }
    options.seed = 2;
    EXPECT_FALSE(bakeTransfer(scene, options).layers[0].coefficients ==
                 reference.layers[0].coefficients);
}

TEST(Conventions, C11_DirectionsBelowTheGeometricSurfaceAreBlocked) {
    // A plane whose shading normals lean by 60°: of the cosine lobe about them the share (1 + cos
    // 60°)/2 is above it.
    const auto lean = static_cast<float>(std::numbers::pi / 3.0);
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.normals.assign(5, {std::sin(lean), 0.0f, std::cos(lean)});
    mesh.indices = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1};
    const TransferField field =
        bakeTransfer(assembleScene({{mesh}}), quickOptions(Transport::shadowed));
    EXPECT_NEAR(whiteSkyRadiance(field, Transport::shadowed, 0), 0.75, kQmcTolerance);
}

TEST(Bake, ResultsDoNotDependOnSizeOrPlace) {
    // Coordinates are multiples of 1/32, so that moving by 2^17 rounds nothing.
    const Scene scene = assembleScene({{makeBox({-1, -1, 0}, {1, 1, 1}, false, 8)},
                                       {makeQuad({-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0})},
                                       {makeBox({1.5f, -1, 0}, {2, 1, 2}, false, 4)}});
    BakeOptions options;
    options.sampleCount = 256;
    const TransferField reference = bakeTransfer(scene, options);
    const auto expectSame = [&](const Scene& other, double tolerance, const char* what) {
        const TransferField field = bakeTransfer(other, options);
        double squares = 0.0;
        for (std::size_t vertex = 0; vertex < scene.vertexCount(); ++vertex) {
            const double difference =
                whiteSkyRadiance(field, Transport::interreflected, vertex) -
                whiteSkyRadiance(reference, Transport::interreflected, vertex);
            squares += difference * difference;
        }
        EXPECT_LT(std::sqrt(squares / static_cast<double>(scene.vertexCount())), tolerance) << what;
    };
    // Powers of two change no bit; other factors round, which moves rays
    // by 1e-7 and flips few of them.
    expectSame(transformScene(scene, Mat3d(), 1.0 / 1024.0, Vec3f(0.0f)), 1e-9, "2^-10 times");
    expectSame(transformScene(scene, Mat3d(), 1.0, Vec3f(131072.0f, 0.0f, -131072.0f)), 1e-9,
               "2^17 away");
    expectSame(transformScene(scene, Mat3d(), 1e-3, Vec3f(0.0f)), 5e-4, "a thousandth");
    expectSame(transformScene(scene, Mat3d(), 1e3, Vec3f(0.0f)), 5e-4, "a thousand times");
}

TEST(Bake, HitsAndTransferOnDiskGiveTheSameBits) {
    const Scene scene = makeRoomScene();
    BakeOptions options;
    options.sampleCount = 32;
    options.bandCount = 3;
    BakeStats stats;
    const TransferField reference = bakeTransfer(scene, options, &stats);
    options.memoryBytes = 1;  // no more than it cannot do without
    const TransferField field = bakeTransfer(scene, options);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_TRUE(field.layers[i].coefficients.storage().onDisk);
        EXPECT_FALSE(reference.layers[i].coefficients.storage().onDisk);
        EXPECT_TRUE(field.layers[i].coefficients == reference.layers[i].coefficients);
    }
}

TEST(Bake, VerticesEqualInPositionAndNormalShareAReceiver) {
    Mesh seam = makeQuad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
    seam.positions.insert(seam.positions.end(), {{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}});
    seam.normals.resize(8, kUp);
    seam.indices.insert(seam.indices.end(), {4, 5, 6, 4, 6, 7});
    const TransferField field =
        bakeTransfer(assembleScene({{seam}}), quickOptions(Transport::shadowed));
    EXPECT_EQ(field.receiverCount, 6u);
    EXPECT_EQ(field.receiverOfVertex[1], field.receiverOfVertex[4]);
    EXPECT_EQ(field.receiverOfVertex[2], field.receiverOfVertex[7]);
}

TEST(Bake, CountsItsRays) {
    const Scene scene = assembleScene({{makeBox({-1, -1, -1}, {1, 1, 1}, true, 2)}});
    BakeOptions options;
    options.sampleCount = 100;  // rounded up to whole vectors
    BakeStats stats;
    const TransferField field = bakeTransfer(scene, options, &stats);
    EXPECT_EQ(stats.receiverCount, field.receiverCount);
    EXPECT_EQ(stats.rayCount, field.receiverCount * 112);
    EXPECT_EQ(stats.hitCount, stats.rayCount);
    EXPECT_EQ(stats.invalidRayCount, 0u);
    EXPECT_EQ(stats.bounceCount, 2);
}

TEST(Bake, RefusesOptionsOutOfRange) {
    const Scene scene = assembleScene({{makePatch({0, 0, 0}, kUp, 1.0f)}});
    const auto expectRefused = [&](const BakeOptions& options) {
        try {
            bakeTransfer(scene, options);
            ADD_FAILURE() << "not refused";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::invalidOption);
        }
    };
    BakeOptions options;
    options.bandCount = 0;
    expectRefused(options);
    options.bandCount = 11;
    expectRefused(options);
    options = {};
    options.sampleCount = -5;
    expectRefused(options);
    options = {};
    options.bounceCount = -2;
    expectRefused(options);
}

TEST(Bake, StopsWhenToldTo) {
    BakeOptions options;
    options.progress = [](const Progress& progress) { return progress.done == 0; };
    try {
        bakeTransfer(makeRoomScene(), options);
        FAIL() << "went on";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cancelled);
    }
}

TEST(Bake, AnEmptySceneHasNoReceivers) {
    const TransferField field = bakeTransfer(Scene(), {});
    EXPECT_EQ(field.receiverCount, 0u);
}

}  // namespace
}  // namespace prt
