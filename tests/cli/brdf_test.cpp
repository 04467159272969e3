// prt brdf tells what closed forms say.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "prt/basis/sh.h"
#include "prt/basis/zonal.h"
#include "prt/brdf/band_limit.h"
#include "prt/brdf/tabulate_brdf.h"
#include "prt/io/image_io.h"
#include "prt/io/merl.h"
#include "tests/cli/run_prt.h"

namespace prt::test {
namespace {

constexpr std::array kAlbedo = {0.8, 0.5, 0.2};

nlohmann::json tellJson(const TemporaryFolder& folder, const std::vector<std::string>& arguments) {
    std::vector<std::string> words = {"brdf", "--json"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const CommandResult result = runPrt(folder, words);
    EXPECT_EQ(result.exitCode, 0) << result.errors;
    return nlohmann::json::parse(result.output);
}

/// A paint, measured.
void writeMerlFile(const std::filesystem::path& path) {
    constexpr std::array kScales = {1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0};
    std::string file;
    const auto append = [&](const auto& number) {
        file.append(reinterpret_cast<const char*>(&number), sizeof number);
    };
    for (const std::int32_t size : {90, 90, 180})
        append(size);
    for (std::size_t channel = 0; channel < 3; ++channel)
        for (std::size_t cell = 0; cell < MeasuredBrdf::kCellCount; ++cell)
            append(kAlbedo[channel] * std::numbers::inv_pi / kScales[channel]);
    writeText(path, file);
}

TEST(CliBrdf, OfLambertHasItsAlbedoAndItsMatrix) {
    constexpr double kQuadrature = 1e-4;
    const TemporaryFolder folder;
    writeMerlFile(folder.path() / "paint.binary");
    const std::vector<double> cosine = clampedCosineZonal(3);
    const std::vector<double> hemisphere = capZonal(2, 0.5 * std::numbers::pi);
    for (const std::string spec : {"lambert:0.8,0.5,0.2", "merl:paint.binary"}) {
        // Cells at the horizon stand for directions below it too.
        const double tolerance = spec.starts_with("merl") ? 3e-3 : kQuadrature;
        const nlohmann::json json = tellJson(folder, {spec, "--bands", "3", "--view-bands", "2"});
        EXPECT_EQ(json["brdf"], spec);
        EXPECT_FALSE(json.contains("least_roughness"));
        EXPECT_GE(json["albedos"].size(), 3u);
        ASSERT_EQ(json["matrix"].size(), 3u);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            for (const nlohmann::json& seen : json["albedos"])
                EXPECT_NEAR(seen["albedo"][channel].get<double>(), kAlbedo[channel],
                            10.0 * tolerance)
                    << spec << " at " << seen["degrees"];
            ASSERT_EQ(json["matrix"][channel].size(), 9u);
            for (std::size_t i = 0; i < 9; ++i) {
                ASSERT_EQ(json["matrix"][channel][i].size(), 4u);
                for (std::size_t j = 0; j < 4; ++j) {
                    const int l = shDegree(static_cast<int>(i)), k = shDegree(static_cast<int>(j));
                    const bool isZonal = static_cast<int>(i) == shIndex(l, 0) &&
                                         static_cast<int>(j) == shIndex(k, 0);
                    const double expected = isZonal ? kAlbedo[channel] * std::numbers::inv_pi *
                                                          cosine[static_cast<std::size_t>(l)] *
                                                          hemisphere[static_cast<std::size_t>(k)]
                                                    : 0.0;
                    EXPECT_NEAR(json["matrix"][channel][i][j].get<double>(), expected, tolerance)
                        << spec << " " << i << " " << j;
                }
            }
        }
    }
}

TEST(CliBrdf, MoreBandsHoldMoreAndSmootherLobes) {
    const TemporaryFolder folder;
    const nlohmann::json json = tellJson(folder, {"ggx:1,1,1,0.5", "--bands", "3"});
    ASSERT_EQ(json["errors"].size(), 10u);
    for (std::size_t i = 0; i < 10; ++i) {
        EXPECT_EQ(json["errors"][i]["bands"], i + 1);
        if (i == 0) continue;
        EXPECT_LT(json["errors"][i]["light"], json["errors"][i - 1]["light"]);
        EXPECT_LT(json["errors"][i]["both"], json["errors"][i - 1]["both"]);
    }
    const double roughness = json["least_roughness"].get<double>();
    EXPECT_LT(tellJson(folder, {"ggx:1,1,1,0.5", "--bands", "6"})["least_roughness"], roughness);
    // There as much of the lobe is missed as may be.
    constexpr double kResolution = 5e-3;
    const nlohmann::json there = tellJson(folder, {fmt::format("ggx:1,1,1,{}", roughness)});
    EXPECT_NEAR(there["errors"][2]["light"].get<double>(), kMostLobeError, kResolution);
}

TEST(CliBrdf, PrintsATable) {
    const TemporaryFolder folder;
    const std::string table = runPrt(folder, {"brdf", "ggx:1,0.5,0.25,0.6"}).output;
    for (const std::string words : {"seen at", "45 degrees", "error in bands", "below roughness"})
        EXPECT_NE(table.find(words), std::string::npos) << words << " in " << table;
    const std::string measured = runPrt(folder, {"brdf", "gltf:1,0.5,0.25,1,0.6"}).output;
    EXPECT_EQ(table.substr(0, table.find("\nin ")), measured) << "a metal is GGX";
}

TEST(CliBrdf, WritesAFileOfTheMerlDatabase) {
    const TemporaryFolder folder;
    const std::string spec = "phong:0.8,0.5,0.2,3";
    EXPECT_EQ(runPrt(folder, {"brdf", spec, "--merl", "made.binary"}).exitCode, 0);
    const Brdf phong{.lobes = {PhongLobe{.albedo = Vec3d(0.8, 0.5, 0.2), .exponent = 3.0}}};
    EXPECT_TRUE(readMerlBrdf(folder.path() / "made.binary").brdf->values() ==
                tabulateBrdf(phong).values());

    const CommandResult refused = runPrt(folder, {"brdf", spec, "--merl", "made.exr"});
    EXPECT_EQ(refused.exitCode, 2);
    EXPECT_EQ(refused.errors.find("prt: error: made.exr: does not end in .binary"), 0u)
        << refused.errors;
    EXPECT_EQ(std::count(refused.errors.begin(), refused.errors.end(), '\n'), 1);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "made.exr"));
}

TEST(CliBrdf, DrawsTheLobeAndWhatBandsMakeOfIt) {
    constexpr int kMargin = 16, kDiscSize = 384;
    constexpr float kHalfFloat = 1e-3f;
    constexpr float kBandLimit = 0.06f;  // of three bands, at the horizon
    const TemporaryFolder folder;
    ASSERT_EQ(
        runPrt(folder, {"brdf", "lambert:0.5,0.25,0", "--bands", "3", "--picture", "lobe.exr"})
            .exitCode,
        0);
    const Image image = readImage(folder.path() / "lobe.exr");
    ASSERT_EQ(image.width, 2 * kDiscSize + 3 * kMargin);
    float largest = 0.0f;
    for (int y = 8; y < kDiscSize; y += 16)
        for (int x = 8; x < kDiscSize; x += 16) {
            const float u = (2.0f * static_cast<float>(x) + 1.0f) / kDiscSize - 1.0f;
            const float v = (2.0f * static_cast<float>(y) + 1.0f) / kDiscSize - 1.0f;
            if (u * u + v * v >= 1.0f) continue;
            const float cosine = std::sqrt(1.0f - u * u - v * v);
            const Vec3f exact = image.at(kMargin + x, kMargin + y);
            EXPECT_NEAR(exact.x, cosine, kHalfFloat);
            EXPECT_NEAR(exact.y, 0.5f * cosine, kHalfFloat);
            EXPECT_EQ(exact.z, 0.0f);
            const Vec3f held = image.at(2 * kMargin + kDiscSize + x, kMargin + y);
            EXPECT_NEAR(held.x, cosine, kBandLimit);
            EXPECT_NEAR(held.y, 0.5f * cosine, kBandLimit);
            largest = std::max(largest, exact.x);
        }
    EXPECT_GT(largest, 0.99f);
}

}  // namespace
}  // namespace prt::test
