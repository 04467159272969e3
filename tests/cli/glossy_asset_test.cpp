// What prt tells of assets with matrices, and how it stores them.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "prt/asset/asset.h"
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
    // Two bands hold little: a lobe of half its energy from roughness 0.76 on.
    EXPECT_NEAR(both.at("mirror_like").at("least_roughness"), 0.76, 0.01);
    const std::string table = run({"info", "both.prt.glb"}).output;
    EXPECT_NE(table.find("chrome (roughness under 0.76): their specular light is taken from the "
                         "environment"),
              std::string::npos)
        << table;
    EXPECT_NE(table.find("glossy-shadowed"), std::string::npos);

    write("bounced", {Transport::glossy});
    EXPECT_EQ(info("bounced.prt.glb").at("mirror_like").at("from_environment"), false);
    write("rough", {Transport::glossyShadowed}, 0.9f);
    EXPECT_TRUE(info("rough.prt.glb").at("mirror_like").at("materials").empty());
    EXPECT_NE(run({"info", "rough.prt.glb"}).output.find("no material (roughness under 0.76)"),
              std::string::npos);
}

TEST_F(CliGlossyAsset, ABakeOfMatricesIsSound) {
    write("both", {Transport::glossyShadowed, Transport::glossy});
    EXPECT_EQ(run({"check", "both.prt.glb"}).output, "ok\n");
}

}  // namespace
}  // namespace prt::test
