// prt bake --transport glossy-shadowed and glossy.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "prt/asset/asset.h"
#include "tests/cli/run_prt.h"

namespace prt::test {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

class CliGlossyBake : public testing::Test {
  protected:
    void SetUp() override { run({"scene", "sphere-over-plane", "-o", "scene.glb"}); }

    CommandResult run(const Words& words, int exitCode = 0) const {
        CommandResult result = runPrt(folder, words);
        EXPECT_EQ(result.exitCode, exitCode) << result.errors;
        return result;
    }
    CommandResult bake(const Words& options, int exitCode = 0) const {
        Words words = {"bake", "scene.glb", "-o", "out.prt.glb", "--samples",
                       "32",   "--bands",   "3",  "--max-edge",  "none"};
        words.insert(words.end(), options.begin(), options.end());
        return run(words, exitCode);
    }
    fs::path file(const std::string& name) const { return folder.path() / name; }
    Asset asset() const { return readAsset(file("out.prt.glb")); }

    TemporaryFolder folder;
};

TEST_F(CliGlossyBake, WritesVectorsAndMatricesAndHowTheyWereMade) {
    const CommandResult result =
        bake({"--transport", "glossy", "--incident-bands", "2", "--bounces", "1", "--brdf",
              "gltf:1,0.8,0.6,1,0.4", "--stats", "stats.json"});
    for (const char* stage : {"\ntrace ", "\nbounce ", "\nwrite "})
        EXPECT_NE(result.errors.find(stage), std::string::npos) << result.errors;
    const Asset baked = asset();
    ASSERT_EQ(baked.transfer.layers.size(), 4u);
    EXPECT_EQ(baked.transfer.layers[2].transport, Transport::glossyShadowed);
    EXPECT_EQ(baked.transfer.layers[3].transport, Transport::glossy);
    EXPECT_EQ(baked.transfer.layers[3].incidentBandCount, 2);
    EXPECT_EQ(baked.transfer.layers[3].table.numbers.columnCount(), 3u * 4u * 9u);
    EXPECT_EQ(baked.provenance.bounceCount, 1);
    for (const char* words : {"--transport glossy --bands 3 --incident-bands 2 --samples 32 ",
                              " --brdf gltf:1,0.8,0.6,1,0.4"})
        EXPECT_NE(baked.provenance.command.find(words), std::string::npos)
            << baked.provenance.command;
    const auto stats = nlohmann::json::parse(readText(file("stats.json")));
    // Rays of vectors, of matrices, and of a bounce.
    EXPECT_EQ(stats.at("rays"), 3 * 32 * stats.at("receivers").get<std::uint64_t>());
}

TEST_F(CliGlossyBake, ShadowsAloneBounceNothing) {
    bake({"--transport", "glossy-shadowed"});
    ASSERT_EQ(asset().transfer.layers.size(), 2u);
    EXPECT_EQ(asset().transfer.layers[1].incidentBandCount, 5);
    EXPECT_EQ(asset().provenance.bounceCount, 0);
}

TEST_F(CliGlossyBake, WrongUsageIsToldInASentence) {
    const auto refuse = [&](const Words& options, const std::string& words, int exitCode = 2) {
        const std::string errors = bake(options, exitCode).errors;
        EXPECT_NE(errors.find(words), std::string::npos) << errors;
        EXPECT_FALSE(fs::exists(file("out.prt.glb")));
    };
    refuse({"--transport", "glossy", "--incident-bands", "9"},
           "--incident-bands: 9 and --bands 3 are more than 11 together");
    refuse({"--transport", "glossy", "--incident-bands", "0"}, "--incident-bands");
    refuse({"--transport", "shadowed", "--incident-bands", "3"}, "--incident-bands: ");
    refuse({"--transport", "glossy-shadowed", "--bounces", "1"}, "--bounces: ");
    refuse({"--brdf", "lambert:1,1,1"}, "--brdf: ");
    refuse({"--transport", "glossy-shadowed", "--brdf", "lambert:1,1,1"}, "--brdf: ");
    refuse({"--transport", "glossy", "--brdf", "gold=lambert:1,1,1"}, "no material named 'gold'");
}

TEST_F(CliGlossyBake, IsNotShared) {
    const std::string errors = run({"bake", "scene.glb", "--transport", "glossy", "--checkpoint",
                                    "kept", "--units", "0:1"},
                                   2)
                                   .errors;
    EXPECT_NE(errors.find("--units: "), std::string::npos) << errors;
    bake({"--transport", "glossy-shadowed", "--checkpoint", "kept"});
    EXPECT_NE(run({"merge", "scene.glb", "kept", "-o", "out.prt.glb"}, 2).errors.find("kept: "),
              std::string::npos);
}

TEST_F(CliGlossyBake, ACheckpointKnowsWhatTheSurfacesWereMadeOf) {
    const Words glossy = {"--transport",      "glossy", "--brdf",    "ggx:1,1,1,0.5",
                          "--incident-bands", "2",      "--bounces", "1"};
    bake(glossy);
    const std::string alone = readText(file("out.prt.glb"));
    Words kept = glossy;
    kept.insert(kept.end(), {"--checkpoint", "kept"});
    bake(kept);
    EXPECT_EQ(readText(file("out.prt.glb")), alone);
    EXPECT_NE(bake(kept).errors.find("came from the checkpoint"), std::string::npos);
    EXPECT_EQ(readText(file("out.prt.glb")), alone);
    kept[3] = "ggx:1,1,1,0.6";
    const std::string errors = bake(kept, 2).errors;
    EXPECT_NE(errors.find("brdf: --brdf ggx:1,1,1,0.5 "), std::string::npos) << errors;
}

}  // namespace
}  // namespace prt::test
