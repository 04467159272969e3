// What prt tells of assets with matrices, and how it stores them.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "prt/asset/asset.h"
#include "prt/brdf/band_limit.h"
#include "prt/scene/procedural.h"
#include "prt/transport/transfer_matrices.h"
#include "tests/cli/run_prt.h"

namespace prt::test {
namespace {

using Json = nlohmann::json;

constexpr int kIncidentBandCount = 2;
constexpr int kBandCount = 3;

/// A floor and a ball, the ball of the roughness.
Scene makeScene(float roughness) {
    Scene scene;
    scene.materials.resize(2);
    scene.materials[0].name = "chalk";
    scene.materials[1].name = "chrome";
    scene.materials[1].metallicFactor = 1.0f;
    scene.materials[1].roughnessFactor = roughness;
    scene.meshes = {makeFloor(2.0f, 0.0f, 12), makeSphere({0.0f, 1.0f, 0.0f}, 0.8f, 16)};
    scene.meshes[1].material = 1;
    return scene;
}

class CliGlossyAsset : public testing::Test {
  protected:
    /// Writes NAME.prt.glb with a layer of matrices for each transport.
    void write(const std::string& name, const std::vector<Transport>& transports,
               float roughness = 0.1f) {
        const Scene scene = makeScene(roughness);
        CompressedTransfer transfer;
        for (const Transport transport : transports) {
            const TransferMatrices baked = bakeTransferMatrices(
                scene, {.incidentBandCount = kIncidentBandCount,
                        .bandCount = kBandCount,
                        .sampleCount = 64,
                        .bounceCount = transport == Transport::glossy ? 1 : 0});
            transfer.bandCount = baked.bandCount;
            transfer.receiverCount = baked.matrices.rowCount();
            transfer.receiverOfVertex = baked.receiverOfVertex;
            transfer.layers.push_back({.transport = transport,
                                       .channelCount = baked.channelCount,
                                       .table = {.numbers = baked.matrices},
                                       .incidentBandCount = baked.incidentBandCount});
        }
        Provenance provenance;
        provenance.sampleCount = 64;
        writeAsset(folder.path() / (name + ".prt.glb"), scene, transfer, provenance);
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

TEST_F(CliGlossyAsset, InfoTellsTheBandsOfIncidentRadianceAndWhatIsLikeAMirror) {
    write("both", {Transport::glossyShadowed, Transport::glossy});
    const Json both = info("both.prt.glb");
    ASSERT_EQ(both.at("layers").size(), 2u);
    for (const Json& layer : both.at("layers"))
        EXPECT_EQ(layer.at("incident_bands"), kIncidentBandCount);
    EXPECT_EQ(both.at("layers")[1].at("bytes_per_vertex"), 3 * 4 * 9 * 4);
    EXPECT_EQ(both.at("mirror_like").at("materials"), Json({"chrome"}));
    EXPECT_EQ(both.at("mirror_like").at("from_environment"), true);
    const double held = leastRoughnessHeld(kIncidentBandCount);
    EXPECT_EQ(both.at("mirror_like").at("least_roughness"), held);
    const std::string limit = fmt::format("(roughness under {:.2f})", held);
    const std::string table = run({"info", "both.prt.glb"}).output;
    EXPECT_NE(
        table.find("chrome " + limit + ": their specular light is taken from the environment"),
        std::string::npos)
        << table;
    EXPECT_NE(table.find("glossy-shadowed"), std::string::npos);

    write("bounced", {Transport::glossy});
    EXPECT_EQ(info("bounced.prt.glb").at("mirror_like").at("from_environment"), false);
    write("rough", {Transport::glossyShadowed}, 0.9f);
    EXPECT_TRUE(info("rough.prt.glb").at("mirror_like").at("materials").empty());
    EXPECT_NE(run({"info", "rough.prt.glb"}).output.find("no material " + limit),
              std::string::npos);
}

TEST_F(CliGlossyAsset, ABakeOfMatricesIsSound) {
    write("both", {Transport::glossyShadowed, Transport::glossy});
    EXPECT_EQ(run({"check", "both.prt.glb"}).output, "ok\n");
}

TEST_F(CliGlossyAsset, EveryMethodOfCompressionMakesASoundAssetAndTellsItsError) {
    write("both", {Transport::glossyShadowed, Transport::glossy});
    const std::vector<std::vector<std::string>> methods = {
        {"--method", "u16"},
        {"--method", "u8", "--meshopt"},
        {"--method", "pca", "--components", "7"},
        {"--method", "vq", "--clusters", "20"},
        {"--method", "cpca", "--clusters", "8", "--components", "3", "--meshopt"},
        {"--bytes-per-vertex", "40"},
        {"--max-error", "0.1"}};
    for (std::vector<std::string> arguments : methods) {
        SCOPED_TRACE(arguments[1]);
        arguments.insert(arguments.begin(), {"compress", "both.prt.glb", "-o", "small.prt.glb",
                                             "--weigh-by", "sun:40,50,20"});
        const std::string told = run(arguments).errors;
        for (const std::string transport : {"glossy-shadowed", "glossy"})
            EXPECT_NE(told.find("prt: " + transport + ": "), std::string::npos) << told;
        EXPECT_NE(told.find("% of what comes in under sun:40,50,20"), std::string::npos) << told;
        EXPECT_EQ(run({"check", "small.prt.glb"}).output, "ok\n");
        const Json small = info("small.prt.glb");
        ASSERT_EQ(small.at("layers").size(), 2u);
        for (const Json& layer : small.at("layers"))
            EXPECT_EQ(layer.at("incident_bands"), kIncidentBandCount);
        EXPECT_LT(int(small.at("layers")[1].at("bytes_per_vertex")), 3 * 4 * 9 * 4);
    }
    run({"compress", "both.prt.glb", "-o", "one.prt.glb", "--transport", "glossy-shadowed"});
    EXPECT_EQ(info("one.prt.glb").at("layers").size(), 1u);
}

TEST_F(CliGlossyAsset, TexturesAndReportsAreOfVectorsAlone) {
    write("matrices", {Transport::glossyShadowed});
    for (const std::string option : {"--textures", "--report"}) {
        const CommandResult refused =
            runPrt(folder, {"compress", "matrices.prt.glb", "-o", "out.prt.glb", option, "made"});
        EXPECT_EQ(refused.exitCode, 2);
        EXPECT_NE(refused.errors.find("matrices.prt.glb: has only matrices, and " + option),
                  std::string::npos)
            << refused.errors;
        EXPECT_FALSE(std::filesystem::exists(folder.path() / "out.prt.glb"));
        EXPECT_FALSE(std::filesystem::exists(folder.path() / "made"));
    }
    run({"scene", "box", "-o", "scene.glb"});
    run({"bake", "scene.glb", "-o", "baked.prt.glb", "--transport", "glossy-shadowed", "--bands",
         "2", "--incident-bands", "2", "--samples", "16"});
    run({"compress", "baked.prt.glb", "-o", "out.prt.glb", "--method", "u8", "--textures", "maps",
         "--report", "report", "--size", "32x18"});
    EXPECT_EQ(Json::parse(readText(folder.path() / "maps" / "textures.json")).at("transport"),
              "shadowed");
    EXPECT_EQ(Json::parse(readText(folder.path() / "report" / "compression.json")).at("transport"),
              "shadowed");
}

}  // namespace
}  // namespace prt::test
