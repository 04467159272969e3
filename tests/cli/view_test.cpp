// prt view without a window: what a person does in it, done by scripts.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "prt/base/file.h"
#include "prt/gltf/glb_writer.h"
#include "prt/io/image_io.h"
#include "tests/cli/run_prt.h"
#include "tests/support/scenes.h"

namespace prt::test {
namespace {

using Json = nlohmann::json;

constexpr const char* kSize = "160x90";

/// Both sum the same products; OpenGL's are in single precision, and it takes its samples of a
/// pixel elsewhere.
constexpr double kLeastPsnr = 50.0;

/// Parts of the picture that are no edge: where the 3×3 pixels about a pixel differ by less than
/// this share of the brightest.
constexpr float kMostChangeOfSmooth = 0.02f;

float brightestOf(const Image& picture) {
    float brightest = 0.0f;
    for (const Vec3f& pixel : picture.pixels)
        for (int channel = 0; channel < 3; ++channel)
            brightest = std::max(brightest, pixel[channel]);
    return brightest;
}

bool isSmooth(const Image& picture, int x, int y, float mostChange) {
    for (int v = y - 1; v <= y + 1; ++v)
        for (int u = x - 1; u <= x + 1; ++u) {
            const Vec3f change = picture.at(u, v) - picture.at(x, y);
            for (int channel = 0; channel < 3; ++channel)
                if (std::abs(change[channel]) > mostChange) return false;
        }
    return true;
}

/// Of the smooth parts, relative to the brightest of `truth`; expects half of the columns and more
/// to be smooth.
///
/// @param first, end  columns that are compared
double smoothPsnr(const Image& picture, const Image& truth, int first, int end) {
    EXPECT_EQ(picture.width, truth.width);
    EXPECT_EQ(picture.height, truth.height);
    const float brightest = brightestOf(truth);
    double squares = 0.0;
    std::size_t count = 0;
    for (int y = 1; y + 1 < truth.height; ++y)
        for (int x = std::max(first, 1); x < std::min(end, truth.width - 1); ++x) {
            if (!isSmooth(truth, x, y, kMostChangeOfSmooth * brightest)) continue;
            squares += static_cast<double>((picture.at(x, y) - truth.at(x, y)).length2()) / 3.0;
            ++count;
        }
    EXPECT_GT(count, static_cast<std::size_t>((end - first) * truth.height / 2));
    const double rmse = std::sqrt(squares / static_cast<double>(count));
    return 20.0 * std::log10(static_cast<double>(brightest) / rmse);
}

double smoothPsnr(const Image& picture, const Image& truth) {
    return smoothPsnr(picture, truth, 0, truth.width);
}

/// A ball and a box on a floor, baked with all layers of vectors.
class CliView : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = new TemporaryFolder;
        Scene scene = assembleScene(
            {{makeFloor(2.0f, 0.0f, 16)}, {makeSphere(Vec3f(-0.6f, 0.51f, 0.0f), 0.5f, 24)}});
        scene.materials[0].baseColorFactor = Vec4f(0.8f, 0.7f, 0.5f, 1.0f);
        writeGlb(file("ball.glb"), scene);
        run({"bake", "ball.glb", "-o", "ball.prt.glb", "--bands", "4", "--samples", "128"});
    }
    static void TearDownTestSuite() { delete folder_; }

    void SetUp() override {
        const CommandResult result = attempt(
            {"view", "ball.prt.glb", "--offscreen", "--screenshot", "first.png", "--size", "16x9"});
        if (result.errors.find("no EGL library") != std::string::npos)
            GTEST_SKIP() << result.errors;
        ASSERT_EQ(result.exitCode, 0) << result.errors;
    }

    static CommandResult attempt(const std::vector<std::string>& arguments) {
        return runPrt(*folder_, arguments);
    }
    static CommandResult run(const std::vector<std::string>& arguments) {
        const CommandResult result = attempt(arguments);
        EXPECT_EQ(result.exitCode, 0) << result.errors;
        return result;
    }

    static CommandResult view(const std::vector<std::string>& more) {
        write("plain.json", {{"background", false}});
        std::vector<std::string> arguments = {"view", "--offscreen", "--size",
                                              kSize,  "--view",      "plain.json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return attempt(arguments);
    }

    /// What prt render makes of the asset.
    static Image render(const std::vector<std::string>& more) {
        std::vector<std::string> arguments = {"render",     "ball.prt.glb", "-o",
                                              "render.exr", "--size",       kSize};
        arguments.insert(arguments.end(), more.begin(), more.end());
        run(arguments);
        return readImage(file("render.exr"));
    }

    static void write(const std::string& name, const Json& document) {
        writeFileAtomically(file(name), document.dump());
    }
    static std::filesystem::path file(const std::string& name) { return folder_->path() / name; }

  private:
    static inline TemporaryFolder* folder_ = nullptr;
};

TEST_F(CliView, ShowsWhatRenderDraws) {
    for (const char* relight : {"cpu", "opengl"}) {
        const CommandResult result =
            view({"ball.prt.glb", "--light", "sun:60,45,20", "--screenshot", "view.exr",
                  "--relight", relight, "--samples", "4"});
        ASSERT_EQ(result.exitCode, 0) << result.errors;
        const Image truth = render({"--light", "sun:60,45,20"});
        EXPECT_GE(smoothPsnr(readImage(file("view.exr")), truth), kLeastPsnr) << relight;
    }
}

// One process: the light turns, then fewer bands are used, then the picture is split.
TEST_F(CliView, AScriptTurnsTheLightChangesBandsAndSplitsThePicture) {
    write("script.json",
          {{{"screenshot", "as_it_is.exr"}},
           {{"view", {{"light_rotation_degrees", {0, 90, 0}}}}, {"screenshot", "turned.exr"}},
           {{"view", {{"left", {{"bands", 2}}}}}, {"screenshot", "two_bands.exr"}},
           {{"view",
             {{"left", {{"bands", 10}, {"transport", "unshadowed"}}},
              {"right", {{"transport", "shadowed"}}},
              {"split_position", 0.25}}},
            {"screenshot", "split.exr"}}});
    const CommandResult result = view(
        {"ball.prt.glb", "--light", "sun:60,45,20", "--script", "script.json", "--samples", "4"});
    ASSERT_EQ(result.exitCode, 0) << result.errors;

    run({"light", "sun:60,45,20", "--bands", "2", "--format", "json"});
    write("two_bands.json",
          Json::parse(run({"light", "sun:60,45,20", "--bands", "2", "--format", "json"}).output));
    const Image asItIs = render({"--light", "sun:60,45,20"});
    const Image turned = render({"--light", "sun:60,45,20", "--rotate", "0,90,0"});
    const Image twoBands = render({"--light", "two_bands.json", "--rotate", "0,90,0"});
    EXPECT_GE(smoothPsnr(readImage(file("as_it_is.exr")), asItIs), kLeastPsnr);
    EXPECT_GE(smoothPsnr(readImage(file("turned.exr")), turned), kLeastPsnr);
    EXPECT_GE(smoothPsnr(readImage(file("two_bands.exr")), twoBands), kLeastPsnr);
    // The steps differ.
    EXPECT_LT(smoothPsnr(turned, asItIs), 40.0);
    EXPECT_LT(smoothPsnr(twoBands, turned), 40.0);

    const Image split = readImage(file("split.exr"));
    const std::vector<std::string> light = {"--light", "sun:60,45,20", "--rotate", "0,90,0"};
    std::vector<std::string> unshadowed = light, shadowed = light;
    unshadowed.insert(unshadowed.end(), {"--transport", "unshadowed"});
    shadowed.insert(shadowed.end(), {"--transport", "shadowed"});
    EXPECT_GE(smoothPsnr(split, render(unshadowed), 0, 39), kLeastPsnr);
    EXPECT_GE(smoothPsnr(split, render(shadowed), 41, 160), kLeastPsnr);
    EXPECT_LT(smoothPsnr(split, render(unshadowed), 41, 160), 40.0);
}

TEST_F(CliView, TwoLightsAddUp) {
    const CommandResult result =
        view({"ball.prt.glb", "--light", "sun:60,45,20", "--light", "uniform:3,2,1", "--screenshot",
              "sum.exr", "--samples", "4"});
    ASSERT_EQ(result.exitCode, 0) << result.errors;
    Image sum = render({"--light", "sun:60,45,20"});
    const Image uniform = render({"--light", "uniform:3,2,1"});
    for (std::size_t i = 0; i < sum.pixels.size(); ++i)
        sum.pixels[i] += uniform.pixels[i];
    EXPECT_GE(smoothPsnr(readImage(file("sum.exr")), sum), kLeastPsnr);
}

// An object turned together with the light looks as before, seen by a camera that has gone around.
TEST_F(CliView, ATurnedObjectIsRelitInItsOwnFrame) {
    const double azimuth = std::atan2(0.45, 1.0) * 180.0 / M_PI;
    const Json camera = {{"target", {0.0, 0.3, 0.0}},
                         {"distance", 5.0},
                         {"azimuth_degrees", azimuth},
                         {"elevation_degrees", 20.0}};
    Json around = camera;
    around["azimuth_degrees"] = azimuth + 90.0;
    write("script.json",
          {{{"view", {{"camera", camera}}}, {"screenshot", "before.exr"}},
           {{"view",
             {{"camera", around},
              {"light_rotation_degrees", {0, 90, 0}},
              {"objects", {{{"asset", "ball.prt.glb"}, {"rotation_degrees", {0, 90, 0}}}}}}},
            {"screenshot", "after.exr"}}});
    const CommandResult result = view(
        {"ball.prt.glb", "--light", "sun:60,45,20", "--script", "script.json", "--samples", "4"});
    ASSERT_EQ(result.exitCode, 0) << result.errors;
    EXPECT_GE(smoothPsnr(readImage(file("after.exr")), readImage(file("before.exr"))), kLeastPsnr);
}

TEST_F(CliView, ABrokenAssetAmongGoodOnesIsToldAndTheOthersShow) {
    writeFileAtomically(file("broken.prt.glb"), std::string("glTF, or not"));
    const CommandResult result = view({"broken.prt.glb", "ball.prt.glb", "--light", "sun:60,45,20",
                                       "--screenshot", "others.exr", "--samples", "4"});
    EXPECT_EQ(result.exitCode, 0) << result.errors;
    EXPECT_NE(result.errors.find("broken.prt.glb: "), std::string::npos) << result.errors;
    const Image truth = render({"--light", "sun:60,45,20"});
    EXPECT_GE(smoothPsnr(readImage(file("others.exr")), truth), kLeastPsnr);
}

TEST_F(CliView, WhatCannotBeShownIsOneSentence) {
    writeFileAtomically(file("broken.prt.glb"), std::string("glTF, or not"));
    writeFileAtomically(file("broken.json"), std::string("[{\"view\": {]"));
    write("unknown.json", {{{"view", {{"exposure", 3}}}}});
    write("wrong_value.json", {{{"view", {{"left", {{"bands", "five"}}}}}}});
    write("no_steps.json", Json::object());
    write("wrong_step.json", {{{"veiw", Json::object()}}});
    writeFileAtomically(file("deep.json"), std::string(100000, '['));
    const std::vector<std::pair<std::vector<std::string>, std::string>> attempts = {
        {{"broken.prt.glb", "--screenshot", "x.png"}, "broken.prt.glb: "},
        {{"missing.prt.glb", "--screenshot", "x.png"}, "missing.prt.glb: "},
        {{"ball.prt.glb", "--light", "missing.hdr", "--screenshot", "x.png"}, "missing.hdr: "},
        {{"ball.prt.glb", "--light", "sun:up", "--screenshot", "x.png"}, "sun:up: "},
        {{"ball.prt.glb", "--script", "missing.json", "--screenshot", "x.png"}, "missing.json: "},
        {{"ball.prt.glb", "--script", "unknown.json"}, "'exposure'"},
        {{"ball.prt.glb", "--script", "wrong_value.json"}, "left.bands"},
        {{"ball.prt.glb", "--script", "broken.json"}, "not valid JSON at byte"},
        {{"ball.prt.glb", "--script", "no_steps.json"}, "not an array"},
        {{"ball.prt.glb", "--script", "wrong_step.json"}, "step 1"},
        {{"ball.prt.glb", "--script", "deep.json"}, "more levels"},
        {{"ball.prt.glb", "--screenshot", "no/such/folder/x.png"}, "no/such/folder"}};
    for (const auto& [arguments, sentence] : attempts) {
        const CommandResult result = view(arguments);
        EXPECT_EQ(result.exitCode, 1) << result.errors;
        EXPECT_TRUE(result.errors.starts_with("prt: error: ")) << result.errors;
        EXPECT_NE(result.errors.find(sentence), std::string::npos) << result.errors;
        EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1) << result.errors;
        EXPECT_FALSE(std::filesystem::exists(file("x.png")));
    }
    EXPECT_EQ(view({"ball.prt.glb", "--screenshot", "x.jpg"}).exitCode, 2);
    EXPECT_EQ(attempt({"view"}).exitCode, 2);
    const CommandResult noView =
        attempt({"view", "--view", "missing.json", "--offscreen", "--screenshot", "x.png"});
    EXPECT_EQ(noView.exitCode, 1);
    EXPECT_NE(noView.errors.find("missing.json: "), std::string::npos) << noView.errors;
    EXPECT_EQ(view({"ball.prt.glb"}).exitCode, 2);
}

TEST_F(CliView, TheBenchmarkTellsPercentilesOfFrameTimes) {
    const CommandResult result =
        attempt({"view", "ball.prt.glb", "--offscreen", "--benchmark", "10", "--size", kSize});
    ASSERT_EQ(result.exitCode, 0) << result.errors;
    const Json report = Json::parse(result.output);
    EXPECT_EQ(report["frames"], 10);
    EXPECT_EQ(report["width"], 160);
    EXPECT_EQ(report["objects"], 1);
    EXPECT_GT(report["vertices"], 300);
    const Json& times = report["milliseconds"];
    EXPECT_GT(times["least"], 0.0);
    EXPECT_LE(times["least"], times["median"]);
    EXPECT_LE(times["median"], times["p90"]);
    EXPECT_LE(times["p90"], times["p99"]);
    EXPECT_LE(times["p99"], times["most"]);
    EXPECT_NEAR(report["frames_per_second"].get<double>() * times["mean"].get<double>(), 1000.0,
                1e-6);
}

}  // namespace
}  // namespace prt::test
