// prt compress: an asset in fewer bytes.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "prt/asset/asset.h"
#include "prt/io/image_io.h"
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

TEST_F(CliCompress, MeshoptTakesFewerBytesAndLooksTheSame) {
    run({"compress", "float.prt.glb", "-o", "plain.prt.glb", "--method", "u8"});
    run({"compress", "float.prt.glb", "-o", "encoded.prt.glb", "--method", "u8", "--meshopt"});
    EXPECT_EQ(run({"check", "encoded.prt.glb"}).output, "ok\n");
    EXPECT_LT(3 * std::filesystem::file_size(folder.path() / "encoded.prt.glb"),
              2 * std::filesystem::file_size(folder.path() / "plain.prt.glb"));
    EXPECT_EQ(info("encoded.prt.glb").at("vertices"), info("plain.prt.glb").at("vertices"));
    for (const std::string name : {"plain", "encoded"})
        run({"render", name + ".prt.glb", "--light", "sun:40,50,20", "-o", name + ".exr", "--size",
             "64x36"});
    const Image plain = readImage(folder.path() / "plain.exr");
    const Image encoded = readImage(folder.path() / "encoded.exr");
    ASSERT_EQ(encoded.pixels.size(), plain.pixels.size());
    // A hit is found on another triangle first, or from another of its corners on: roundings.
    constexpr float kTolerance = 1e-5f;
    for (std::size_t i = 0; i < plain.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(encoded.pixels[i][c], plain.pixels[i][c], kTolerance) << "pixel " << i;
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

/// The number behind some words, as "… error 0.5 % of the transfer" has it.
double numberAfter(const std::string& text, const std::string& words) {
    const std::size_t at = text.find(words);
    EXPECT_NE(at, std::string::npos) << words << " in " << text;
    return at == std::string::npos ? 0.0 : std::stod(text.substr(at + words.size()));
}

TEST_F(CliCompress, EveryMethodOfClustersMakesAnAssetThatIsRelit) {
    run({"render", "float.prt.glb", "--light", "sun:40,50,20", "-o", "float.exr", "--size",
         "64x36"});
    for (const std::string method : {"pca", "vq", "cpca"}) {
        const std::string errors =
            run({"compress", "float.prt.glb", "-o", "small.prt.glb", "--method", method}).errors;
        EXPECT_EQ(run({"check", "small.prt.glb"}).output, "ok\n");
        const Json layers = info("small.prt.glb").at("layers");
        ASSERT_EQ(layers.size(), 2u);
        for (const Json& layer : layers) {
            const int asked = method == "pca" ? 1 : method == "vq" ? 256 : 64;
            EXPECT_LE(int(layer.at("clusters")), asked);
            EXPECT_GE(int(layer.at("clusters")), asked * 3 / 4) << "those that no vertex needs";
            EXPECT_EQ(layer.at("bytes_per_vertex"), 1 + int(layer.at("components")));
            EXPECT_EQ(layer.at("shared_bytes"),
                      2 * int(layer.at("vectors")) * 9 * int(layer.at("channels")));
        }
        EXPECT_NE(run({"info", "small.prt.glb"}).output.find("clusters"), std::string::npos);
        run({"render", "small.prt.glb", "--light", "sun:40,50,20", "-o", method + ".exr", "--size",
             "64x36"});
        EXPECT_NE(readText(folder.path() / (method + ".exr")),
                  readText(folder.path() / "float.exr"));
    }
}

TEST_F(CliCompress, BasesOfEightBitsTakeHalfTheBytes) {
    const auto compress = [&](const std::string& bases) {
        run({"compress", "float.prt.glb", "-o", "small.prt.glb", "--clusters", "4", "--components",
             "3", "--bases", bases});
        return info("small.prt.glb");
    };
    const Json words = compress("u16"), bytes = compress("u8");
    EXPECT_EQ(bytes.at("layers")[0].at("bases_encoding"), "unorm8");
    EXPECT_EQ(2 * int(bytes.at("layers")[0].at("shared_bytes")),
              int(words.at("layers")[0].at("shared_bytes")));
    EXPECT_NE(bytes.at("provenance").dump().find("--components 3 --bases u8"), std::string::npos);
}

TEST_F(CliCompress, ABakeByClustersWritesWhatCompressingItsFloatsDoes) {
    const std::vector<std::string> method = {"--method",     "cpca", "--clusters", "20",
                                             "--components", "3",    "--weigh-by", "sun:40,50,20"};
    std::vector<std::string> bake = {"bake",      "scene.glb", "-o",      "baked.prt.glb",
                                     "--samples", "32",        "--bands", "3"};
    std::vector<std::string> compress = {"compress", "float.prt.glb", "-o", "small.prt.glb"};
    bake.insert(bake.end(), method.begin(), method.end());
    compress.insert(compress.end(), method.begin(), method.end());
    const std::string told = run(bake).errors;
    EXPECT_NE(told.find("% as seen under sun:40,50,20"), std::string::npos) << told;
    const std::string toldAgain = run(compress).errors;
    EXPECT_NE(toldAgain.find("% as seen under sun:40,50,20"), std::string::npos) << toldAgain;
    for (const std::string name : {"baked", "small"}) {
        EXPECT_NE(info(name + ".prt.glb")
                      .at("provenance")
                      .dump()
                      .find("--method cpca --clusters 20 --components 3 --weigh-by sun:40,50,20"),
                  std::string::npos);
        EXPECT_EQ(info(name + ".prt.glb").at("layers")[1].at("bytes_per_vertex"), 4);
    }
}

TEST_F(CliCompress, ThreadsDoNotChangeAByte) {
    for (const std::string threads : {"1", "3"})
        run({"compress", "float.prt.glb", "-o", threads + ".prt.glb", "--method", "cpca",
             "--threads", threads});
    EXPECT_EQ(readText(folder.path() / "1.prt.glb"), readText(folder.path() / "3.prt.glb"));
}

TEST_F(CliCompress, ABudgetOfBytesOrOfErrorIsKept) {
    const auto compress = [&](const std::string& option, const std::string& value) {
        return run({"compress", "float.prt.glb", "-o", "out.prt.glb", "--transport", "shadowed",
                    option, value})
            .errors;
    };
    compress("--bytes-per-vertex", "7");
    Json asset = info("out.prt.glb");
    Json layer = asset.at("layers").at(0);
    const double shared = layer.value("shared_bytes", 0.0) / double(asset.at("vertices"));
    EXPECT_LE(double(layer.at("bytes_per_vertex")) + shared, 7.0);

    const std::string told = compress("--max-error", "0.02");
    EXPECT_LE(numberAfter(told, "error "), 2.0);
    EXPECT_GT(numberAfter(told, "error "), 0.0);
    EXPECT_LT(int(info("out.prt.glb").at("layers").at(0).at("bytes_per_vertex")), 9);
}

TEST_F(CliCompress, OptionsThatContradictEachOtherAreWrongUsage) {
    const std::vector<std::vector<std::string>> all = {
        {"--method", "u8", "--clusters", "4"},
        {"--method", "pca", "--clusters", "4"},
        {"--method", "vq", "--components", "3"},
        {"--method", "vq", "--weights", "u8"},
        {"--method", "u8", "--bases", "u8"},
        {"--method", "u16", "--max-error", "0.1"},
        {"--method", "vq", "--bytes-per-vertex", "8"},
        {"--bytes-per-vertex", "16", "--max-error", "0.1"},
        {"--bytes-per-vertex", "16", "--components", "3"},
        {"--bytes-per-vertex", "1"},
        {"--clusters", "257", "--weights", "u8"},
        {"--clusters", "0"},
        {"--max-error", "0"},
        {"--weigh-by", "uniform:0"},
    };
    for (const std::vector<std::string>& options : all)
        for (const std::string command : {"compress", "bake"}) {
            std::vector<std::string> arguments = {
                command, command == "bake" ? "scene.glb" : "float.prt.glb", "-o", "out.prt.glb"};
            arguments.insert(arguments.end(), options.begin(), options.end());
            const CommandResult result = runPrt(folder, arguments);
            EXPECT_EQ(result.exitCode, 2) << result.errors;
            EXPECT_NE(result.errors.find("prt: error: "), std::string::npos) << result.errors;
            EXPECT_FALSE(std::filesystem::exists(folder.path() / "out.prt.glb"));
        }
}

TEST_F(CliCompress, WhatIsCompressedTwiceIsStillSound) {
    run({"compress", "float.prt.glb", "-o", "once.prt.glb", "--components", "2", "--clusters",
         "3"});
    for (const std::string method : {"cpca", "pca", "u8", "float"}) {
        run({"compress", "once.prt.glb", "-o", method + ".prt.glb", "--method", method});
        EXPECT_EQ(run({"check", method + ".prt.glb"}).output, "ok\n") << method;
    }
}

TEST_F(CliCompress, AReportHoldsEveryMethodAgainstTheOriginal) {
    run({"compress", "float.prt.glb", "-o", "small.prt.glb", "--clusters", "8", "--components", "3",
         "--report", "report", "--light", "sun:40,50,20", "--size", "64x36"});
    const auto folderOfReport = folder.path() / "report";
    for (const std::string picture :
         {"original", "compressed", "vertex-errors", "vectors-2", "vectors-3", "vectors-4"}) {
        EXPECT_TRUE(std::filesystem::exists(folderOfReport / (picture + ".png"))) << picture;
        EXPECT_NE(readText(folderOfReport / "index.html").find(picture + ".png"),
                  std::string::npos);
    }
    const Json report = Json::parse(readText(folderOfReport / "compression.json"));
    EXPECT_GT(report.at("chosen").at("error").at("seen"), 0.0);
    EXPECT_GT(report.at("relit_rmse"), 0.0);
    double floats = 1.0, worst = 0.0;
    for (const Json& trial : report.at("trials")) {
        if (trial.at("options") == "--method float") floats = trial.at("error").at("seen");
        worst = std::max<double>(worst, trial.at("error").at("seen"));
    }
    EXPECT_EQ(floats, 0.0);
    EXPECT_GT(worst, report.at("chosen").at("error").at("seen"));
    // 64 clusters of floats for mean and components, floats for weights and a byte a vertex.
    const std::size_t vertexCount = report.at("vertices");
    for (const Json& few : report.at("few_vectors")) {
        const std::size_t vectorCount = few.at("vectors");
        EXPECT_EQ(few.at("bytes"),
                  vertexCount * (4 * (vectorCount - 1) + 1) + 64 * vectorCount * 27 * 4);
    }
    EXPECT_EQ(runPrt(folder, {"compress", "float.prt.glb", "-o", "x.prt.glb", "--report", "report"})
                  .exitCode,
              2)
        << "the folder is there";
    EXPECT_EQ(
        runPrt(folder, {"compress", "float.prt.glb", "-o", "x.prt.glb", "--light", "sun:40,50,20"})
            .exitCode,
        2)
        << "a light without a report";
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "x.prt.glb"));
}

TEST_F(CliCompress, TexturesHoldTheTransferOfTheVertices) {
    run({"compress", "float.prt.glb", "-o", "x.prt.glb", "--method", "float", "--textures",
         "maps"});
    const Json maps = Json::parse(readText(folder.path() / "maps" / "textures.json"));
    const Asset asset = readAsset(folder.path() / "float.prt.glb");
    const std::vector<float> truth = expandLayer(asset.transfer.layers.back());
    ASSERT_EQ(maps.at("channels"), 3);
    ASSERT_EQ(maps.at("coefficients").size(), 8u) << "of 9, the ninth is a constant";
    ASSERT_EQ(maps.at("textures").size(), 6u);
    const int width = maps.at("width");
    std::vector<Rgba8Image> textures;
    for (const std::string name : maps.at("textures")) {
        const std::string bytes = readText(folder.path() / "maps" / name);
        textures.push_back(decodeImage(std::as_bytes(std::span(bytes)), name));
        EXPECT_EQ(textures.back().width, width);
    }
    for (std::size_t v = 0; v < asset.transfer.receiverCount; ++v)
        for (std::size_t s = 0; s < 24; ++s) {
            const Rgba8& texel = textures[s / 4].pixels[v];
            const std::uint8_t q[] = {texel.red, texel.green, texel.blue, texel.alpha};
            const double scale = maps.at("scale")[s];
            const double value = maps.at("bias")[s].get<double>() + scale * q[s % 4] / 255.0;
            const std::size_t i = maps.at("coefficients")[s % 8];
            ASSERT_NEAR(value, truth[v * 27 + s / 8 * 9 + i], scale / 510.0 + 1e-7) << v;
        }
    const CommandResult both = runPrt(folder, {"compress", "float.prt.glb", "-o", "y.prt.glb",
                                               "--textures", "maps2", "--meshopt"});
    EXPECT_EQ(both.exitCode, 2) << "the order of vertices would differ";
    run({"bake", "scene.glb", "-o", "one.prt.glb", "--samples", "16", "--bands", "1"});
    const CommandResult one =
        runPrt(folder, {"compress", "one.prt.glb", "-o", "y.prt.glb", "--textures", "maps2"});
    EXPECT_EQ(one.exitCode, 2);
    EXPECT_NE(one.errors.find("single band"), std::string::npos) << one.errors;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "y.prt.glb"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "maps2"));
}

TEST_F(CliCompress, AnInterruptLeavesNothing) {
    const PrtProcess compress(
        folder, {"compress", "float.prt.glb", "-o", "out.prt.glb", "--max-error", "0.0001"});
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    compress.sendSignal(SIGINT);
    const CommandResult result = compress.wait();
    EXPECT_EQ(result.exitCode, 75) << result.errors;
    EXPECT_NE(result.errors.find("prt: interrupted"), std::string::npos) << result.errors;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out.prt.glb"));
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
