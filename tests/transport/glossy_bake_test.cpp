// bakeTransfer of glossy transport: its layers, and that neither memory nor threads nor an end
// before the end change a bit (C10).

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "prt/base/error.h"
#include "prt/base/file.h"
#include "prt/transport/bake.h"
#include "prt/transport/bake_settings.h"
#include "prt/transport/matrix_bake.h"
#include "prt/transport/transfer_matrices.h"
#include "tests/support/scenes.h"
#include "tests/support/temporary_folder.h"
#include "tests/transport/reflect_glossily.h"

namespace prt {
namespace {

namespace fs = std::filesystem;

using test::reflectGlossily;

/// The room's screen is of metal.
Scene makeScene() {
    Scene scene = test::makeScreenScene();
    scene.materials.back().metallicFactor = 1.0f;
    scene.materials.back().roughnessFactor = 0.5f;
    return scene;
}

class GlossyBake : public testing::Test {
  protected:
    GlossyBake() : scene(makeScene()) {
        options.transport = Transport::glossy;
        options.bandCount = 4;
        options.incidentBandCount = 3;
        options.sampleCount = 64;
        options.reflection = reflectGlossily;
        options.threadCount = 2;
    }

    TransferField bake(BakeStats* stats = nullptr) const {
        return bakeTransfer(scene, options, stats);
    }
    static void expectSame(const TransferField& a, const TransferField& b) {
        EXPECT_EQ(a.receiverOfVertex, b.receiverOfVertex);
        ASSERT_EQ(a.layers.size(), b.layers.size());
        for (std::size_t i = 0; i < a.layers.size(); ++i)
            EXPECT_TRUE(a.layers[i].coefficients == b.layers[i].coefficients) << "layer " << i;
    }

    Scene scene;
    BakeOptions options;
};

TEST_F(GlossyBake, HasTheVectorsAndTheMatricesOfTheirOwnBakes) {
    const TransferField glossy = bake();
    EXPECT_EQ(glossy.bandCount, 4);
    const std::vector<Transport> kinds = {Transport::shadowed, Transport::interreflected,
                                          Transport::glossyShadowed, Transport::glossy};
    ASSERT_EQ(glossy.layers.size(), kinds.size());
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        const TransferLayer& layer = glossy.layers[i];
        EXPECT_EQ(layer.transport, kinds[i]);
        EXPECT_EQ(layer.channelCount, i % 2 == 0 ? 1 : 3);
        EXPECT_EQ(layer.incidentBandCount, i < 2 ? 0 : 3);
        EXPECT_EQ(layer.coefficients.rowCount(), glossy.receiverCount);
        EXPECT_EQ(layer.coefficients.columnCount(), coefficientsPerReceiver(4, layer));
    }

    BakeOptions diffuse = options;
    diffuse.transport = Transport::interreflected;
    const TransferField vectors = bakeTransfer(scene, diffuse);
    EXPECT_EQ(glossy.receiverOfVertex, vectors.receiverOfVertex);
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_TRUE(glossy.layers[i].coefficients == vectors.layers[i].coefficients) << i;

    TransferMatrixOptions matrices{.incidentBandCount = 3, .bandCount = 4, .sampleCount = 64};
    matrices.reflection = reflectGlossily;
    EXPECT_TRUE(glossy.layers[2].coefficients == bakeTransferMatrices(scene, matrices).matrices);
    matrices.bounceCount = options.bounceCount;
    EXPECT_TRUE(glossy.layers[3].coefficients == bakeTransferMatrices(scene, matrices).matrices);
}

TEST_F(GlossyBake, OfShadowsAloneHasThoseLayersAndTracesEachRayOnce) {
    const TransferField all = bake();
    options.transport = Transport::glossyShadowed;
    BakeStats stats;
    const TransferField shadowed = bake(&stats);
    ASSERT_EQ(shadowed.layers.size(), 2u);
    EXPECT_TRUE(shadowed.layers[0].coefficients == all.layers[0].coefficients);
    EXPECT_TRUE(shadowed.layers[1].coefficients == all.layers[2].coefficients);
    EXPECT_EQ(stats.rayCount, 2 * 64 * stats.receiverCount);
    EXPECT_EQ(stats.bounceCount, 0);
}

TEST_F(GlossyBake, WithoutBouncesIsWhatIsVisibleInThreeChannels) {
    options.bounceCount = 0;
    const TransferField field = bake();
    const std::vector<float> visible = copyRows<float>(field.layers[2].coefficients);
    const std::vector<float> total = copyRows<float>(field.layers[3].coefficients);
    const std::size_t length = field.layers[2].coefficients.columnCount();
    ASSERT_EQ(total.size(), 3 * visible.size());
    for (std::size_t i = 0; i < total.size(); ++i)
        ASSERT_EQ(total[i], visible[i / (3 * length) * length + i % length]);
}

TEST_F(GlossyBake, FollowsTheScenesMaterialsUnlessTold) {
    const TransferField told = bake();
    options.reflection = gltfReflection(
        scene, std::make_shared<GltfViewTable>(GltfViewTableOptions{.bandCount = 3}));
    const TransferField gltf = bake();
    options.reflection = {};
    expectSame(bake(), gltf);
    EXPECT_FALSE(told.layers[3].coefficients == gltf.layers[3].coefficients);
    EXPECT_TRUE(told.layers[1].coefficients == gltf.layers[1].coefficients);
}

TEST_F(GlossyBake, IsTheSameForAnyMemoryAndNumberOfThreads) {  // C10
    const TransferField freely = bake();
    BakeForecast forecast;
    options.announce = [&](const BakeForecast& said) { forecast = said; };
    options.threadCount = 3;
    expectSame(bake(), freely);
    const BakeForecast ofAll = forecast;
    options.memoryBytes = 1;
    BakeStats stats;
    expectSame(bake(&stats), freely);
    EXPECT_GT(forecast.rayCount, 8 * ofAll.rayCount) << "a column of light at a time";
    EXPECT_GT(forecast.diskBytes, 0u);
    EXPECT_EQ(ofAll.diskBytes, 0u);
}

TEST_F(GlossyBake, IsTheSameForAnyNumberOfColumnsAtOnce) {  // C10
    const RayScene rays(scene);
    const Receivers receivers = placeReceivers(scene, rays);
    const GatherKernels kernels = selectGatherKernels(detectIsa());
    const SamplePattern pattern(64);
    const VisibilityMatrix visibilityMatrix(3, 4);
    const SurfaceReflection reflection = reflectGlossily;
    const GatherScene gatherScene{scene, rays, receivers};
    const MatrixGatherScene shared{gatherScene,      kernels,    pattern,
                                   visibilityMatrix, reflection, options.seed};
    const TransferField field = bake();
    for (const std::size_t columns : {1, 5, 8, 9, 15, 100}) {
        const MatrixBakeOptions bakeOptions{
            .bounceCount = 2, .columnsAtOnce = columns, .progress = options.progress};
        MatrixBake matrices(shared, bakeOptions);
        const CoefficientTable visible = matrices.gatherVisible();
        EXPECT_TRUE(visible == field.layers[2].coefficients);
        EXPECT_TRUE(matrices.addBounces(visible) == field.layers[3].coefficients) << columns;
    }
}

TEST_F(GlossyBake, EndlessBouncesOfABowlReachTheirLimit) {  // A9
    // s of the sky and ρ (1 − s) of the wall: s / (1 − ρ (1 − s)) in all, from each to each.
    constexpr double kTolerance = 3e-2;  // of a wall of 24 segments, and 256 points
    const Scene bowl = test::assembleScene({{makeBowl(0.4f, 24), Vec3f(0.7f, 0.7f, 0.7f)}});
    options.bandCount = 1;
    options.incidentBandCount = 2;
    options.sampleCount = 256;
    options.bounceCount = kInfiniteBounces;
    options.reflection = lambertReflection(bowl);
    BakeStats stats;
    const TransferField field = bakeTransfer(bowl, options, &stats);
    EXPECT_GT(stats.bounceCount, 8);
    EXPECT_LT(stats.bounceCount, 100);
    const double limit = 0.3 / (1.0 - 0.7 * 0.7);
    std::vector<float> matrix(12);
    for (std::size_t receiver = 0; receiver < field.receiverCount; receiver += 3) {
        field.layers[3].coefficients.readRow(receiver, std::span(matrix));
        for (std::size_t channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(std::sqrt(4.0 * std::numbers::pi) *
                            static_cast<double>(kLambertResponse * matrix[4 * channel + 2]),
                        limit, kTolerance);
    }

    // The same as so many bounces that nothing is left.
    options.bounceCount = stats.bounceCount + 10;
    const TransferField many = bakeTransfer(bowl, options);
    const std::vector<float> endless = copyRows<float>(field.layers[3].coefficients);
    const std::vector<float> finite = copyRows<float>(many.layers[3].coefficients);
    for (std::size_t i = 0; i < endless.size(); ++i)
        ASSERT_NEAR(endless[i], finite[i], 4e-6f);
}

TEST_F(GlossyBake, EndlessBouncesBetweenSurfacesThatMakeLightAreRefused) {
    options.bounceCount = kInfiniteBounces;
    options.reflection = [](const SurfacePoint&, const Vec3f&, std::span<float> response) {
        for (std::size_t channel = 0; channel < 3; ++channel)
            response[9 * channel + 2] += 6.0f * kLambertResponse;
    };
    try {
        bake();
        ADD_FAILURE() << "it ended";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::invalidOption);
        EXPECT_NE(std::string(error.what()).find("without end"), std::string::npos);
    }
}

TEST_F(GlossyBake, RefusesWhatItCannotMake) {
    const auto expectRefused = [&](auto change) {
        BakeOptions wrong = options;
        change(wrong);
        EXPECT_THROW(bakeTransfer(scene, wrong), Error);
    };
    expectRefused([](BakeOptions& o) { o.incidentBandCount = 8; });
    expectRefused([](BakeOptions& o) { o.incidentBandCount = 0; });
    expectRefused([](BakeOptions& o) { o.bandCount = 9; });
    const test::TemporaryFolder temporary;
    options.checkpoint.folder = temporary.path() / "kept";
    EXPECT_THROW(bakeUnits(scene, options, {0, 1}), Error);
}

TEST_F(GlossyBake, KeptOrStoppedAgainAndAgainTheBitsAreTheSame) {  // C10
    options.sampleCount = 4096;  // so many that a unit is 128 receivers
    options.bandCount = 2;
    const TransferField alone = bake();
    const test::TemporaryFolder temporary;
    options.checkpoint.folder = temporary.path() / "kept";
    const auto unitFiles = [&] {
        std::vector<fs::path> files;
        std::error_code ignored;
        for (const auto& entry : fs::directory_iterator(options.checkpoint.folder, ignored))
            if (entry.path().extension() == ".unit") files.push_back(entry.path());
        return files;
    };

    // Each attempt is stopped at its first sign of progress after one more unit is there.
    int stops = 0;
    const auto attempt = [&] {
        options.progress = [&, before = unitFiles().size()](const Progress&) {
            return unitFiles().size() <= before;
        };
        try {
            bake();
            return true;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::cancelled);
            return false;
        }
    };
    while (!attempt() && stops < 100)
        ++stops;
    EXPECT_GE(stops, 5);
    options.progress = {};
    BakeStats stats;
    expectSame(bake(&stats), alone);
    EXPECT_EQ(stats.traceSeconds, 0.0);
    EXPECT_TRUE(stats.warnings.empty());

    // A damaged unit of a bounce, and other memory.
    for (const fs::path& file : unitFiles())
        if (file.filename().string().starts_with("m2-")) test::writeText(file, "");
    options.memoryBytes = 1;
    expectSame(bake(&stats), alone);
    options.memoryBytes = 0;
    expectSame(bake(&stats), alone);
    EXPECT_FALSE(stats.warnings.empty());
}

TEST_F(GlossyBake, ACheckpointOfOtherMaterialsOrBandsIsRefusedByName) {
    const test::TemporaryFolder temporary;
    options.checkpoint.folder = temporary.path() / "kept";
    options.sampleCount = 16;
    bake();
    const auto expectRefused = [&](const std::string& word, auto change) {
        BakeOptions other = options;
        Scene otherScene = scene;
        change(other, otherScene);
        try {
            bakeTransfer(otherScene, other);
            ADD_FAILURE() << "not refused: " << word;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::invalidOption);
            EXPECT_NE(std::string(error.what()).find(" " + word + ": "), std::string::npos)
                << error.what();
        }
    };
    expectRefused("incident-bands", [](BakeOptions& o, Scene&) { o.incidentBandCount = 4; });
    expectRefused("materials", [](BakeOptions&, Scene& s) { s.materials[4].metallicFactor = 0; });
    expectRefused("materials", [](BakeOptions&, Scene& s) { s.materials[4].roughnessFactor = 1; });
    expectRefused("materials", [](BakeOptions&, Scene& s) {
        s.materials[0].metallicRoughnessTexture = TextureUse{};
    });
    BakeOptions read;
    applyBakeSettings(bakeSettings(scene, options, Isa::avx2), read);
    EXPECT_EQ(read.transport, Transport::glossy);
    EXPECT_EQ(read.incidentBandCount, 3);
}

TEST_F(GlossyBake, AForecastCountsTheRays) {
    BakeForecast forecast;
    options.announce = [&](const BakeForecast& said) { forecast = said; };
    scene = test::makeRoomScene();  // of which nothing is double-sided
    for (const int bounceCount : {0, 1, 3}) {
        options.bounceCount = bounceCount;
        BakeStats stats;
        bake(&stats);
        EXPECT_EQ(forecast.rayCount, stats.rayCount);
        EXPECT_EQ(stats.rayCount,
                  64 * stats.receiverCount * static_cast<std::uint64_t>(2 + bounceCount));
        EXPECT_EQ(stats.bounceCount, bounceCount);
    }
}

}  // namespace
}  // namespace prt
