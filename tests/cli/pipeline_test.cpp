// The command line from a scene to a picture.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "prt/io/image_io.h"
#include "tests/cli/gltf_text.h"
#include "tests/cli/run_prt.h"

namespace prt::test {
namespace {

using Json = nlohmann::json;

/// One baked box for all tests that only look at it.
class BakedScene : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = new TemporaryFolder;
        run({"scene", "sphere-over-plane", "-o", "scene.glb"});
        run({"bake", "scene.glb", "-o", "scene.prt.glb", "--samples", "64", "--bands", "3",
             "--bounces", "1", "--method", "u16", "--stats", "stats.json"});
    }
    static void TearDownTestSuite() { delete folder_; }

    static std::string run(const std::vector<std::string>& arguments) {
        const CommandResult result = runPrt(*folder_, arguments);
        EXPECT_EQ(result.exitCode, 0) << result.errors;
        return result.output;
    }
    static std::filesystem::path file(const std::string& name) { return folder_->path() / name; }

  private:
    static inline TemporaryFolder* folder_ = nullptr;
};

TEST_F(BakedScene, StatsNameEveryStageAndTheRays) {
    const Json stats = Json::parse(readText(file("stats.json")));
    double sum = 0.0;
    for (const char* stage :
         {"load", "build", "trace", "accumulate", "bounce", "compress", "write"}) {
        EXPECT_GE(stats.at("seconds").at(stage).get<double>(), 0.0);
        sum += stats.at("seconds").at(stage).get<double>();
    }
    EXPECT_LE(sum, stats.at("seconds").at("total").get<double>());
    EXPECT_EQ(stats.at("seconds").size(), 8u);
    EXPECT_EQ(stats.at("rays"), stats.at("receivers").get<std::uint64_t>() * 64);
    EXPECT_GT(stats.at("rays_per_second"), 0.0);
    EXPECT_GT(stats.at("peak_bytes"), 1'000'000);
    EXPECT_EQ(stats.size(), 5u);
}

TEST_F(BakedScene, InfoTellsHowItWasBaked) {
    const Json info = Json::parse(run({"info", "scene.prt.glb", "--json"}));
    EXPECT_EQ(info.at("bands"), 3);
    EXPECT_EQ(info.at("provenance").at("samples"), 64);
    EXPECT_EQ(info.at("provenance").at("bounces"), 1);
    EXPECT_EQ(info.at("provenance").at("seed"), 1);
    const Json& fullest = info.at("layers").back();
    EXPECT_EQ(fullest.at("transport"), "interreflected");
    EXPECT_EQ(fullest.at("bytes_per_vertex"), 3 * 9 * 2);
    const std::string table = run({"info", "scene.prt.glb"});
    EXPECT_NE(table.find("interreflected"), std::string::npos);
    EXPECT_NE(table.find("--samples 64"), std::string::npos);
}

TEST_F(BakedScene, CheckPrintsOk) {
    EXPECT_EQ(run({"check", "scene.prt.glb"}), "ok\n");
}

TEST_F(BakedScene, RendersAPictureOfTheSizeAskedFor) {
    run({"render", "scene.prt.glb", "--light", "uniform:1", "-o", "a.png", "--size", "96x54",
         "--background"});
    const Image picture = readImage(file("a.png"));
    EXPECT_EQ(picture.width, 96);
    EXPECT_EQ(picture.height, 54);
}

/// Uniform light of radiance 1 is seen as 1 behind the scene, and no unshadowed
/// surface sends out more than it.
TEST_F(BakedScene, ExrHoldsLinearRadiance) {
    run({"render", "scene.prt.glb", "--light", "uniform:1,2,4", "-o", "a.exr", "--size", "64x36",
         "--background", "--eye", "0,1,8", "--target", "0,1,0", "--transport", "unshadowed"});
    const Image picture = readImage(file("a.exr"));
    constexpr float kRounding = 1e-4f;  // of coefficients in float
    EXPECT_NEAR(picture.at(0, 0).x, 1.0f, kRounding);
    EXPECT_NEAR(picture.at(0, 0).z, 4.0f, kRounding);
    for (const Vec3f& radiance : picture.pixels) {
        EXPECT_LE(radiance.x, 1.0f + kRounding);
        EXPECT_GT(radiance.z, 0.0f);
    }
}

TEST_F(BakedScene, TheAutomaticWindowLeavesNoNegativePixel) {
    const auto renderUnder = [&](const std::string& window) {
        run({"render", "scene.prt.glb", "--light", "sun:270,10,1", "-o", "w.exr", "--size", "64x36",
             "--window", window});
        return readImage(file("w.exr"));
    };
    const auto findLowest = [](const Image& picture) {
        float lowest = 0.0f;
        for (const Vec3f& radiance : picture.pixels)
            lowest = std::min({lowest, radiance.x, radiance.y, radiance.z});
        return lowest;
    };
    const Image plain = renderUnder("none"), automatic = renderUnder("auto");
    constexpr float kTolerance = 1e-3f * 0.08f;  // of the mean radiance of that sun, 1/4π
    EXPECT_LT(findLowest(plain), -0.01f);
    EXPECT_GE(findLowest(automatic), -kTolerance);
    EXPECT_NE(automatic.pixels, renderUnder("hann").pixels);
}

TEST_F(BakedScene, TurningTheLightTurnsTheBackground) {
    const std::vector<std::string> view = {"--size", "16x9",     "--background", "--eye",
                                           "0,50,0", "--target", "0,100,1"};
    const auto render = [&](const std::string& light, const std::string& rotation,
                            const std::string& output) {
        std::vector<std::string> arguments = {"render",   "scene.prt.glb", "--light", light,
                                              "--rotate", rotation,        "-o",      output};
        arguments.insert(arguments.end(), view.begin(), view.end());
        run(arguments);
        return readImage(file(output));
    };
    // A rotation by +90 degrees about y takes +x to −z, which is azimuth −90 degrees.
    const Image turned = render("sun:0,30,40", "0,90,0", "turned.exr");
    const Image expected = render("sun:-90,30,40", "0,0,0", "expected.exr");
    constexpr float kRounding = 1e-4f;
    for (std::size_t i = 0; i < turned.pixels.size(); ++i)
        EXPECT_NEAR(turned.pixels[i].x, expected.pixels[i].x, kRounding);
}

TEST_F(BakedScene, AnExrTakesNoExposure) {
    const TemporaryFolder folder;
    const CommandResult result = runPrt(
        folder, {"render", "a.prt.glb", "--light", "uniform:1", "-o", "a.exr", "--exposure", "1"});
    EXPECT_EQ(result.exitCode, 2);
}

TEST_F(BakedScene, TheSameSeedGivesTheSameBytesForAnyThreadCount_C10) {
    std::vector<std::string> assets;
    for (const std::string threads : {"1", "2", "3", "8"}) {
        run({"bake", "scene.glb", "-o", "threads.prt.glb", "--samples", "32", "--bands", "3",
             "--threads", threads});
        assets.push_back(readText(file("threads.prt.glb")));
        EXPECT_EQ(assets.front(), assets.back()) << threads << " threads";
    }
    run({"bake", "scene.glb", "-o", "threads.prt.glb", "--samples", "32", "--bands", "3", "--seed",
         "2"});
    EXPECT_NE(assets.front(), readText(file("threads.prt.glb")));
}

TEST(CliInterrupt, ALongBakeStopsWithinTwoSecondsAndLeavesNothing) {
    const TemporaryFolder folder;
    ASSERT_EQ(runPrt(folder, {"scene", "teapot", "-o", "teapot.glb"}).exitCode, 0);
    for (const int signal : {SIGINT, SIGTERM}) {
        const PrtProcess bake(folder,
                              {"bake", "teapot.glb", "-o", "out.prt.glb", "--samples", "65536"});
        // Its last line before the rays says how the scene was refined.
        for (int attempt = 0;
             attempt < 1000 && bake.errorsSoFar().find("refine") == std::string::npos; ++attempt)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        const auto start = std::chrono::steady_clock::now();
        bake.sendSignal(signal);
        const CommandResult result = bake.wait();
        EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
        EXPECT_EQ(result.exitCode, 75) << result.errors;
        EXPECT_TRUE(result.errors.ends_with("prt: interrupted\n")) << result.errors;
        EXPECT_EQ(folder.fileCount(), 1) << "more than teapot.glb is left";
    }
}

}  // namespace
}  // namespace prt::test
