// The window of prt view, on a screen that nobody sees.

#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "prt/base/file.h"
#include "prt/gltf/glb_writer.h"
#include "prt/io/image_io.h"
#include "tests/cli/run_prt.h"
#include "tests/support/scenes.h"

namespace prt::test {
namespace {

using Json = nlohmann::json;

constexpr int kWidth = 640, kHeight = 360;

/// Rows between the panel's button above and the hint below.
constexpr int kFirstRow = 70, kEndRow = 240;

/// Both come from one rasteriser, which may round otherwise for a window.
constexpr int kMostCodeValues = 1;

/// What comes before a command that it is for. Tests that run at once begin to look for a free
/// number at different ones.
std::string screen() {
    return "xvfb-run -a -n " + std::to_string(100 + ::getpid() % 10000) +
           " -s '-screen 0 800x600x24' ";
}

class CliWindow : public testing::Test {
  protected:
    CliWindow() {
        Scene scene = assembleScene(
            {{makeFloor(2.0f, 0.0f, 8)}, {makeSphere(Vec3f(-0.6f, 0.51f, 0.0f), 0.5f, 12)}});
        writeGlb(folder_.path() / "ball.glb", scene);
        const CommandResult result = runPrt(
            folder_, {"bake", "ball.glb", "-o", "ball.prt.glb", "--bands", "3", "--samples", "64"});
        EXPECT_EQ(result.exitCode, 0) << result.errors;
    }

    void SetUp() override {
        if (std::system("command -v xvfb-run > /dev/null") != 0)
            GTEST_SKIP() << "there is no xvfb-run";
    }

    /// prt view by a shell. @param before  what comes before it in the line
    CommandResult view(const std::string& before, const std::string& arguments) const {
        const std::string line = "cd '" + folder_.path().string() + "' && " + before + "'" +
                                 PRT_BINARY + "' view ball.prt.glb --light sky:40,50,3 --size " +
                                 std::to_string(kWidth) + "x" + std::to_string(kHeight) + " " +
                                 arguments + " > output 2> errors";
        const int status = std::system(line.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, 0,
                readText(folder_.path() / "output"), readText(folder_.path() / "errors")};
    }

    Rgba8Image read(const std::string& name) const {
        return decodeImage(readFile(folder_.path() / name, 1 << 24), name);
    }

    TemporaryFolder folder_;
};

/// Three views, with screenshots of this name and a number.
Json makeScript(const std::string& name) {
    return {{{"screenshot", name + "1.png"}},
            {{"view", {{"light_rotation_degrees", {0, 120, 0}}}}, {"screenshot", name + "2.png"}},
            {{"view", {{"left", {{"bands", 1}}}, {"right", {{"transport", "unshadowed"}}}}},
             {"screenshot", name + "3.png"}}};
}

/// Of rows without panels, but for those columns where the line is that splits pictures.
int largestDifference(const Rgba8Image& a, const Rgba8Image& b) {
    constexpr int kSplitReach = 12;
    int largest = 0;
    for (int y = kFirstRow; y < kEndRow; ++y)
        for (int x = 0; x < kWidth; ++x) {
            if (std::abs(x - kWidth / 2) < kSplitReach) continue;
            const Rgba8 p = a.at(x, y), q = b.at(x, y);
            largest = std::max({largest, std::abs(p.red - q.red), std::abs(p.green - q.green),
                                std::abs(p.blue - q.blue)});
        }
    return largest;
}

TEST_F(CliWindow, ShowsWhatIsDrawnOffscreenUnderItsPanels) {
    writeFileAtomically(folder_.path() / "window.json", makeScript("window").dump());
    writeFileAtomically(folder_.path() / "offscreen.json", makeScript("offscreen").dump());
    const CommandResult window = view(screen(), "--script window.json");
    ASSERT_EQ(window.exitCode, 0) << window.errors;
    const CommandResult offscreen = view("", "--offscreen --script offscreen.json");
    ASSERT_EQ(offscreen.exitCode, 0) << offscreen.errors;
    for (const std::string step : {"1", "2", "3"}) {
        const Rgba8Image shown = read("window" + step + ".png");
        const Rgba8Image drawn = read("offscreen" + step + ".png");
        ASSERT_EQ(shown.width, kWidth);
        ASSERT_EQ(shown.height, kHeight);
        EXPECT_LE(largestDifference(shown, drawn), kMostCodeValues) << step;
        // The button of the panel, over the picture.
        const Rgba8 button = shown.at(kWidth - 30, 30), behind = drawn.at(kWidth - 30, 30);
        EXPECT_NE(button.red, behind.red);
    }
    EXPECT_GT(largestDifference(read("window1.png"), read("window2.png")), 20);
    EXPECT_GT(largestDifference(read("window2.png"), read("window3.png")), 20);
}

TEST_F(CliWindow, WithoutADisplayOneSentenceTellsWhatToDo) {
    const CommandResult result = view("env -u DISPLAY -u WAYLAND_DISPLAY ", "");
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_TRUE(result.errors.starts_with("prt: error: no window can be opened")) << result.errors;
    EXPECT_NE(result.errors.find("--offscreen"), std::string::npos) << result.errors;
    EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1) << result.errors;
}

TEST_F(CliWindow, WithoutOpenGl43OneSentenceSaysSo) {
    writeFileAtomically(folder_.path() / "one_step.json", std::string("[{}]"));
    const CommandResult result =
        view(std::string("env MESA_GL_VERSION_OVERRIDE=3.3 ") + screen(), "--script one_step.json");
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_NE(result.errors.find("there is no OpenGL 4.3"), std::string::npos) << result.errors;
}

}  // namespace
}  // namespace prt::test
