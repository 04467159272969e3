// However a bake was stopped, and whatever became of its files, the next one ends with the same
// bits (C10).

#include <gtest/gtest.h>

#include <algorithm>
#include <new>
#include <set>

#include "prt/base/error.h"
#include "prt/scene/procedural.h"
#include "prt/transport/bake.h"
#include "prt/transport/bake_settings.h"
#include "tests/support/scenes.h"
#include "tests/support/temporary_folder.h"

namespace prt {
namespace {

namespace fs = std::filesystem;
using test::assembleScene;
using test::makeQuad;
using test::readText;
using test::writeText;

/// A box that is open above, with a curtain in it that light reaches from both sides: fronts in
/// several units, backs in one.
Scene makeScene() {
    Mesh box = makeBox({-1, -1, 0}, {1, 1, 1}, true, 12);
    std::vector<std::uint32_t> open;
    for (std::size_t i = 0; i < box.indices.size(); i += 3)
        if (box.normals[box.indices[i]].z > -0.5f)
            open.insert(open.end(), &box.indices[i], &box.indices[i] + 3);
    box.indices = open;
    const Mesh curtain = makeQuad({-1, 0, 0.1f}, {1, 0, 0.1f}, {1, 0, 0.9f}, {-1, 0, 0.9f});
    return assembleScene({{box, {0.8f, 0.6f, 0.4f}},
                          {.mesh = curtain, .albedo = {0.2f, 0.7f, 0.9f}, .doubleSided = true}});
}

class ResumeTest : public testing::Test {
  protected:
    // So many rays that a unit is 128 receivers.
    ResumeTest() : scene(makeScene()) {
        options.bandCount = 3;
        options.sampleCount = 4096;
        options.bounceCount = 3;
        options.threadCount = 2;
        options.checkpoint.folder = temporary.path() / "kept";
    }

    TransferField bake(BakeStats* stats = nullptr) const {
        return bakeTransfer(scene, options, stats);
    }
    /// The bake that keeps nothing.
    TransferField bakeAlone() const {
        BakeOptions alone = options;
        alone.checkpoint = {};
        return bakeTransfer(scene, alone);
    }
    static void expectSame(const TransferField& a, const TransferField& b) {
        EXPECT_EQ(a.receiverOfVertex, b.receiverOfVertex);
        ASSERT_EQ(a.layers.size(), b.layers.size());
        for (std::size_t i = 0; i < a.layers.size(); ++i)
            EXPECT_TRUE(a.layers[i].coefficients == b.layers[i].coefficients) << "layer " << i;
    }
    std::vector<fs::path> unitFiles(const std::string& stage = "") const {
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(options.checkpoint.folder))
            if (entry.path().extension() == ".unit" &&
                entry.path().filename().string().starts_with(stage))
                files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        return files;
    }

    test::TemporaryFolder temporary;
    Scene scene;
    BakeOptions options;
};

TEST_F(ResumeTest, KeptOrNotTheBitsAreTheSame_C10) {
    const TransferField alone = bakeAlone();
    BakeStats stats;
    expectSame(bake(&stats), alone);
    EXPECT_EQ(stats.resumedUnitCount, 0u);
    EXPECT_GE(unitFiles("fronts").size(), 8u);
    EXPECT_GE(unitFiles("backs-1").size(), 1u);
    EXPECT_EQ(unitFiles("bounce").size(), 3u * 2);  // 27 columns are two blocks

    // Once more, from files alone, with other threads, and with hits that are read again.
    options.threadCount = 1;
    options.memoryBytes = 1;
    const std::uint64_t rayCount = stats.rayCount;
    expectSame(bake(&stats), alone);
    EXPECT_EQ(stats.resumedUnitCount, unitFiles("fronts").size() + unitFiles("backs").size());
    EXPECT_EQ(stats.rayCount, rayCount);
    EXPECT_EQ(stats.traceSeconds, 0.0);
    EXPECT_TRUE(stats.warnings.empty());
    for (const fs::path& file : unitFiles("bounce"))
        fs::remove(file);
    expectSame(bake(), alone);
}

TEST_F(ResumeTest, ShadowsAloneAndEndlessBouncesAreKeptToo) {
    options.transport = Transport::shadowed;
    const TransferField shadowed = bakeAlone();
    expectSame(bake(), shadowed);
    expectSame(bake(), shadowed);
    options.transport = Transport::interreflected;
    options.bounceCount = kInfiniteBounces;
    options.checkpoint.folder = temporary.path() / "endless";
    const TransferField endless = bakeAlone();
    BakeStats first;
    BakeStats second;
    expectSame(bake(&first), endless);
    expectSame(bake(&second), endless);
    EXPECT_GT(first.bounceCount, 5);
    EXPECT_EQ(first.bounceCount, second.bounceCount);
}

TEST_F(ResumeTest, ABakeThatIsStoppedAgainAndAgainEndsWithTheSameBits) {
    // Each attempt is stopped at its first sign of progress after one more unit is there.
    options.checkpoint.folder = temporary.path() / "kept";
    int stops = 0;
    const auto attempt = [&] {
        const std::size_t before = fs::exists(options.checkpoint.folder) ? unitFiles().size() : 0;
        options.progress = [&, before](const Progress&) { return unitFiles().size() <= before; };
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
    EXPECT_GE(stops, 3);
    options.progress = {};
    expectSame(bake(), bakeAlone());
}

TEST_F(ResumeTest, OnlyDamagedUnitsAreMadeAgain) {
    const TransferField alone = bakeAlone();
    bake();
    const std::size_t rayUnitCount = unitFiles("fronts").size() + unitFiles("backs").size();
    const auto expectMended = [&](std::size_t damagedRayUnits, std::size_t damagedUnits) {
        BakeStats stats;
        expectSame(bake(&stats), alone);
        EXPECT_EQ(stats.resumedUnitCount, rayUnitCount - damagedRayUnits);
        EXPECT_EQ(stats.warnings.size(), damagedUnits);
        BakeStats again;
        expectSame(bake(&again), alone);
        EXPECT_EQ(again.resumedUnitCount, rayUnitCount);
        EXPECT_TRUE(again.warnings.empty());
    };
    for (const std::string stage : {"fronts", "backs-1", "bounce-2"}) {
        const fs::path file = unitFiles(stage).back();
        const std::size_t ofRays = stage != "bounce-2";
        const std::string whole = readText(file);

        std::string flipped = whole;
        flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 1);
        writeText(file, flipped);
        expectMended(ofRays, 1);
        writeText(file, whole.substr(0, whole.size() - 1));
        expectMended(ofRays, 1);
        writeText(file, "");
        expectMended(ofRays, 1);
        EXPECT_EQ(readText(file), whole) << "a unit made again is the same file";
    }
    const fs::path first = unitFiles("fronts")[0];
    const fs::path second = unitFiles("fronts")[1];
    fs::rename(first, temporary.path() / "aside");
    fs::rename(second, first);
    fs::rename(temporary.path() / "aside", second);
    expectMended(2, 2);
}

TEST_F(ResumeTest, AnyOtherBakeIsRefusedByName) {
    options.sampleCount = 64;
    options.checkpoint.callerSettings = {{"max-edge", "0.5"}};
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
            EXPECT_NE(std::string(error.what()).find(" " + word), std::string::npos)
                << error.what();
        }
    };
    const auto refuseOption = [&](const std::string& word, auto change) {
        expectRefused(word, [&](BakeOptions& other, Scene&) { change(other); });
    };
    const auto refuseScene = [&](const std::string& word, auto change) {
        expectRefused(word + ": ", [&](BakeOptions&, Scene& other) { change(other); });
    };
    refuseOption("samples: 64 in the checkpoint, 80 asked for",
                 [](auto& o) { o.sampleCount = 80; });
    refuseOption("bands: 3 in", [](auto& o) { o.bandCount = 4; });
    refuseOption("bounces: 3 in the checkpoint, inf", [](auto& o) { o.bounceCount = -1; });
    refuseOption("seed: 1 in", [](auto& o) { o.seed = 2; });
    refuseOption("transport: interreflected in",
                 [](auto& o) { o.transport = Transport::shadowed; });
    refuseOption("max-edge: 0.5 in", [](auto& o) { o.checkpoint.callerSettings[0].value = "0.6"; });
    if (detectIsa() > Isa::sse4) refuseOption("isa: ", [](auto& o) { o.isa = Isa::sse4; });
    refuseScene("geometry", [](Scene& s) { s.meshes[0].positions[3].x += 1e-5f; });
    refuseScene("geometry",
                [](Scene& s) { std::swap(s.meshes[0].indices[0], s.meshes[0].indices[1]); });
    refuseScene("materials", [](Scene& s) { s.materials[1].baseColorFactor.y = 0.71f; });
    refuseScene("materials", [](Scene& s) { s.materials[1].doubleSided = false; });
    refuseScene("textures", [](Scene& s) { s.images.resize(1); });

    // What decides nothing may change.
    options.threadCount = 3;
    options.memoryBytes = 1000;
    scene.materials[0].name = "brick";
    BakeStats stats;
    bake(&stats);
    EXPECT_GT(stats.resumedUnitCount, 0u);
}

TEST_F(ResumeTest, SettingsThatWereWrittenDownAreTakenUpAgain) {
    options.bounceCount = kInfiniteBounces;
    options.seed = 0xfedcba9876543210;
    options.transport = Transport::shadowed;
    const std::vector<Setting> settings = bakeSettings(scene, options, Isa::avx2);
    BakeOptions read;
    applyBakeSettings(settings, read);
    EXPECT_EQ(read.transport, options.transport);
    EXPECT_EQ(read.bandCount, options.bandCount);
    EXPECT_EQ(read.sampleCount, options.sampleCount);
    EXPECT_EQ(read.bounceCount, options.bounceCount);
    EXPECT_EQ(read.seed, options.seed);
    EXPECT_EQ(read.isa, Isa::avx2);
    for (std::size_t i = 0; i < 6; ++i) {
        std::vector<Setting> damaged = settings;
        damaged[i].value = "12x";
        EXPECT_THROW(applyBakeSettings(damaged, read), Error) << settings[i].name;
        damaged.erase(damaged.begin() + static_cast<std::ptrdiff_t>(i));
        EXPECT_THROW(applyBakeSettings(damaged, read), Error) << settings[i].name;
    }
}

TEST_F(ResumeTest, SharesOfManyMachinesMakeTheSameBits) {
    const TransferField alone = bakeAlone();
    const auto bakeShare = [&](const std::string& folder, std::size_t begin, std::size_t end) {
        BakeOptions share = options;
        share.checkpoint.folder = temporary.path() / folder;
        return bakeUnits(scene, share, {begin, end});
    };
    const UnitReport none = bakeShare("a", 0, 0);
    ASSERT_GE(none.unitCount, 8u);
    EXPECT_EQ(none.missingUnitCount, none.unitCount);
    // One unit is made twice, and one is forgotten; what is beyond the last is none.
    EXPECT_EQ(bakeShare("a", 0, 4).missingUnitCount, none.unitCount - 4);
    EXPECT_EQ(bakeShare("b", 3, 6).missingUnitCount, none.unitCount - 3);
    EXPECT_EQ(bakeShare("b", 7, 1'000'000).missingUnitCount, 4u);
    EXPECT_EQ(bakeShare("b", 1'000'000, 2'000'000).missingUnitCount, 4u);

    BakeOptions merge = options;
    merge.checkpoint.folder = temporary.path() / "a";
    merge.checkpoint.otherFolders = {temporary.path() / "b"};
    merge.checkpoint.requireFronts = true;
    try {
        bakeTransfer(scene, merge);
        FAIL() << "a unit is missing";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::notFound);
        EXPECT_TRUE(std::string(error.what()).ends_with("missing: 6")) << error.what();
    }
    bakeShare("b", 6, 7);
    BakeStats stats;
    expectSame(bakeTransfer(scene, merge, &stats), alone);
    EXPECT_EQ(stats.resumedUnitCount, none.unitCount);
}

TEST_F(ResumeTest, AForecastCountsTheRaysAndMayRefuse) {
    options.sampleCount = 100;
    options.announce = [&](const BakeForecast& forecast) {
        EXPECT_EQ(forecast.rayCount, forecast.receiverCount * 112);
        EXPECT_EQ(forecast.unitCount, 1u);
        throw Error(ErrorCode::outOfMemory, "too much");
    };
    EXPECT_THROW(bake(), Error);
    options.announce = [](const BakeForecast&) { throw std::bad_alloc(); };
    try {
        bake();
        FAIL() << "went on";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::outOfMemory);
    }
}

/// What is said before a bake, which is then refused.
BakeForecast forecastOf(const Scene& scene, BakeOptions options) {
    BakeForecast said;
    options.announce = [&](const BakeForecast& forecast) {
        said = forecast;
        throw Error(ErrorCode::cancelled, "enough");
    };
    EXPECT_THROW(bakeTransfer(scene, options), Error);
    return said;
}

/// Of a scene of many receivers the hits are foreseen within a tenth, on disk and in memory.
TEST(BakeForecast, KnowsTheHitsOfALargeScene) {
    const Scene room = assembleScene({{makeBox({-1, -1, -1}, {1, 1, 1}, true, 72)}});
    BakeOptions options;
    options.bandCount = 1;
    options.sampleCount = 16;
    const BakeForecast inMemory = forecastOf(room, options);
    options.memoryBytes = 1;
    const BakeForecast onDisk = forecastOf(room, options);
    options.memoryBytes = 0;
    BakeStats stats;
    bakeTransfer(room, options, &stats);

    ASSERT_GT(stats.receiverCount, 20'000u);
    EXPECT_EQ(inMemory.receiverCount, stats.receiverCount);
    EXPECT_EQ(inMemory.rayCount, stats.rayCount);
    EXPECT_EQ(inMemory.diskBytes, 0u);
    // Three tables of one panel of floats: direct, at work, and in all.
    const auto movedBytes = static_cast<double>(stats.hitBytes + stats.receiverCount * 3 * 16);
    EXPECT_NEAR(static_cast<double>(onDisk.diskBytes), movedBytes, 0.1 * movedBytes);
    EXPECT_NEAR(static_cast<double>(inMemory.memoryBytes - onDisk.memoryBytes), movedBytes,
                0.1 * movedBytes);
}

}  // namespace
}  // namespace prt
