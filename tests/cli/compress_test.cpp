// prt compress: an asset in fewer bytes.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/run_prt.h"

namespace prt::test {
namespace {

using Json = nlohmann::json;

class CliCompress : public testing::Test {
  protected:
    void SetUp() override {
        run({"scene", "sphere-over-plane", "-o", "scene.glb"});
        run({"bake", "scene.glb", "-o", "float.prt.glb", "--samples", "32", "--bands", "3"});
    }
    CommandResult run(const std::vector<std::string>& arguments) {
        CommandResult result = runPrt(folder, arguments);
        EXPECT_EQ(result.exitCode, 0) << result.errors;
        return result;
    }
    Json info(const std::string& asset) {
        return Json::parse(run({"info", asset, "--json"}).output);
    }

    TemporaryFolder folder;
};

TEST_F(CliCompress, ACompressedAssetIsTheOneThatABakeOfThisMethodWrites) {
    run({"bake", "scene.glb", "-o", "baked.prt.glb", "--samples", "32", "--bands", "3", "--method",
         "u8"});
    const CommandResult result =
        run({"compress", "float.prt.glb", "-o", "small.prt.glb", "--method", "u8"});
    EXPECT_NE(result.errors.find("interreflected: 27 bytes a vertex instead of 108"),
              std::string::npos)
        << result.errors;
    EXPECT_EQ(run({"check", "small.prt.glb"}).output, "ok\n");
    // Pictures are the same to the last byte; only the provenance differs.
    for (const std::string name : {"baked", "small"})
        run({"render", name + ".prt.glb", "--light", "sun:40,50,20", "-o", name + ".exr", "--size",
             "64x36"});
    EXPECT_EQ(readText(folder.path() / "baked.exr"), readText(folder.path() / "small.exr"));
    EXPECT_NE(info("small.prt.glb").at("provenance").dump().find("compress --method u8"),
              std::string::npos);
    EXPECT_LT(std::filesystem::file_size(folder.path() / "small.prt.glb"),
              std::filesystem::file_size(folder.path() / "float.prt.glb"));
}

TEST_F(CliCompress, OneKindOfTransportCanBeKeptAlone) {
    run({"compress", "float.prt.glb", "-o", "one.prt.glb", "--transport", "shadowed"});
    const Json layers = info("one.prt.glb").at("layers");
    ASSERT_EQ(layers.size(), 1u);
    EXPECT_EQ(layers[0].at("transport"), "shadowed");
    EXPECT_EQ(layers[0].at("bytes_per_vertex"), 18) << "u16 by default";
    const CommandResult missing = runPrt(
        folder, {"compress", "one.prt.glb", "-o", "x.prt.glb", "--transport", "interreflected"});
    EXPECT_EQ(missing.exitCode, 2);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "x.prt.glb"));
}

TEST_F(CliCompress, WrongInputIsOneSentenceAndNoFile) {
    writeText(folder.path() / "text.prt.glb", "not an asset");
    const auto refuse = [&](const std::vector<std::string>& arguments, int exitCode) {
        const CommandResult result = runPrt(folder, arguments);
        EXPECT_EQ(result.exitCode, exitCode) << result.errors;
        EXPECT_TRUE(result.errors.starts_with("prt: error: ")) << result.errors;
        EXPECT_FALSE(std::filesystem::exists(folder.path() / "out.prt.glb"));
    };
    refuse({"compress", "text.prt.glb", "-o", "out.prt.glb"}, 1);
    refuse({"compress", "scene.glb", "-o", "out.prt.glb"}, 1);
    refuse({"compress", "missing.prt.glb", "-o", "out.prt.glb"}, 1);
    refuse({"compress", "float.prt.glb", "-o", "out.png"}, 2);
    refuse({"compress", "float.prt.glb", "-o", "float.prt.glb"}, 2);
    refuse({"compress", "float.prt.glb", "-o", "out.prt.glb", "--method", "zip"}, 2);
}

}  // namespace
}  // namespace prt::test
