// prt bake --refine-error.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/run_prt.h"

namespace prt::test {
namespace {

using Words = std::vector<std::string>;

class RefinedBake : public testing::Test {
  protected:
    /// A floor, and a wall that stands on it.
    void SetUp() override {
        writeText(folder_.path() / "scene.obj",
                  "v -4 0 4\nv 4 0 4\nv 4 0 -4\nv -4 0 -4\nv -1 0 0\nv 1 0 0\nv 1 1 0\nv -1 1 0\n"
                  "f 1 2 3 4\nf 5 6 7 8\nf 8 7 6 5\n");
    }

    std::string run(const Words& arguments) {
        const CommandResult result = runPrt(folder_, arguments);
        EXPECT_EQ(result.exitCode, 0) << result.errors;
        return result.output;
    }

    CommandResult bake(const std::string& output, const Words& options) {
        Words words = {"bake", "scene.obj", "-o", output, "--samples", "256", "--bands", "3"};
        words.insert(words.end(), options.begin(), options.end());
        return runPrt(folder_, words);
    }

    std::size_t bakeVertices(const Words& options) {
        EXPECT_EQ(bake("out.prt.glb", options).exitCode, 0);
        const auto info = nlohmann::json::parse(run({"info", "out.prt.glb", "--json"}));
        return info.at("vertices").get<std::size_t>();
    }

    TemporaryFolder folder_;
};

TEST_F(RefinedBake, AddsVerticesAsFarAsTheLimitsAllow) {
    const std::size_t plain = bakeVertices({});
    const std::size_t fine = bakeVertices({"--refine-error", "0.1"});
    EXPECT_GT(fine, plain);
    EXPECT_EQ(bakeVertices({"--refine-error", "0.1", "--min-edge", "100"}), plain);
    const std::size_t between = (plain + fine) / 2;
    const std::size_t limited =
        bakeVertices({"--refine-error", "0.1", "--max-vertices", std::to_string(between)});
    EXPECT_GT(limited, plain);
    EXPECT_LE(limited, between);
}

TEST_F(RefinedBake, ACheckpointKnowsHowFarItWasRefined) {
    const Words kept = {"--refine-error", "0.3", "--checkpoint", "kept"};
    ASSERT_EQ(bake("one.prt.glb", kept).exitCode, 0);
    run({"merge", "scene.obj", "kept", "-o", "two.prt.glb"});
    EXPECT_EQ(readText(folder_.path() / "one.prt.glb"), readText(folder_.path() / "two.prt.glb"));
    const CommandResult other =
        bake("three.prt.glb", {"--refine-error", "0.2", "--checkpoint", "kept"});
    EXPECT_NE(other.exitCode, 0);
    EXPECT_NE(other.errors.find("refine-error: 0.3 in the checkpoint, 0.2 asked for"),
              std::string::npos)
        << other.errors;
}

TEST_F(RefinedBake, OptionsThatMakeNoSenseAreWrongUsage) {
    for (const Words& options : {Words{"--min-edge", "0.1"}, Words{"--refine-error", "0"},
                                 Words{"--refine-error", "-1"}, Words{"--refine-error", "nan"}})
        EXPECT_EQ(bake("out.prt.glb", options).exitCode, 2) << options[0] << " " << options[1];
}

}  // namespace
}  // namespace prt::test
