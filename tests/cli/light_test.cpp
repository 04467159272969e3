// prt light: coefficients as people and programs read them.

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "prt/io/image_io.h"
#include "tests/cli/run_prt.h"

namespace prt::test {
namespace {

using Json = nlohmann::json;

constexpr double kSixDecimals = 6e-7;      // the table rounds to 1e-6
constexpr double kDoubleRounding = 1e-12;  // JSON holds every digit

class CliLight : public testing::Test {
  protected:
    std::string print(const std::vector<std::string>& arguments) const {
        std::vector<std::string> words = {"light"};
        words.insert(words.end(), arguments.begin(), arguments.end());
        const CommandResult result = runPrt(folder, words);
        EXPECT_EQ(result.exitCode, 0) << result.errors;
        return result.output;
    }

    Json coefficients(std::vector<std::string> arguments) const {
        arguments.insert(arguments.end(), {"--format", "json"});
        return Json::parse(print(arguments)).at("coefficients");
    }

    TemporaryFolder folder;
};

void expectNear(const Json& a, const Json& b, double tolerance) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(a[i][channel].get<double>(), b[i][channel].get<double>(), tolerance) << i;
}

TEST_F(CliLight, AUniformLightIsItsFirstCoefficient) {
    std::istringstream table(print({"uniform:1,1,1", "--bands", "3"}));
    std::string header;
    std::getline(table, header);
    const double kFirst = 2.0 * std::sqrt(std::numbers::pi);  // 3.5449
    int index, l, m, rowCount = 0;
    double red, green, blue;
    for (; table >> index >> l >> m >> red >> green >> blue; ++rowCount) {
        EXPECT_EQ(index, rowCount);
        EXPECT_EQ(index, l * (l + 1) + m);  // C3
        for (const double value : {red, green, blue})
            EXPECT_NEAR(value, index == 0 ? kFirst : 0.0, kSixDecimals);
    }
    EXPECT_EQ(rowCount, 9);
}

/// A directional light of unit irradiance has the basis functions of its
/// direction as coefficients (C2).
TEST_F(CliLight, ASunHasTheValuesOfTheBasisInItsDirection) {
    const Json alongZ = coefficients({"sun:90,0,0", "--bands", "2"});
    const Json up = coefficients({"sun:0,90,0", "--bands", "2"});
    const double kY1 = std::sqrt(3.0 / (4.0 * std::numbers::pi));
    EXPECT_NEAR(alongZ[2][0].get<double>(), kY1, kDoubleRounding);
    EXPECT_NEAR(alongZ[1][0].get<double>(), 0.0, kDoubleRounding);
    EXPECT_NEAR(up[1][0].get<double>(), -kY1, kDoubleRounding);
}

TEST_F(CliLight, JsonIsReadBackAsTheSameLight) {
    writeText(folder.path() / "a.json", print({"sun:30,45,20", "--format", "json"}));
    expectNear(coefficients({"a.json"}), coefficients({"sun:30,45,20"}), kDoubleRounding);
    for (const std::string convention :
         {"rh", "d3dx", "three", "filament", "unity", "godot", "3dgs"}) {
        writeText(folder.path() / "b.json", print({"sun:30,45,20", "--format", "json", "--bands",
                                                   "3", "--convention", convention}));
        EXPECT_EQ(Json::parse(readText(folder.path() / "b.json")).at("convention"), convention);
        expectNear(coefficients({"b.json"}), coefficients({"sun:30,45,20", "--bands", "3"}),
                   kDoubleRounding);
    }
}

TEST_F(CliLight, RotationsAreAboutXThenYThenZ) {
    // x takes +y to +z, y takes +z to +x, z takes +x to +y.
    expectNear(coefficients({"sun:0,90,10", "--rotate", "90,0,0"}), coefficients({"sun:90,0,10"}),
               kDoubleRounding);
    expectNear(coefficients({"sun:0,90,10", "--rotate", "90,90,0"}), coefficients({"sun:0,0,10"}),
               kDoubleRounding);
    expectNear(coefficients({"sun:0,90,10", "--rotate", "90,90,90"}), coefficients({"sun:0,90,10"}),
               kDoubleRounding);
}

TEST_F(CliLight, TheAutomaticWindowLeavesNoNegativeRadiance) {
    print({"sun:0,60,1", "--window", "auto", "--reconstruct", "auto.exr"});
    print({"sun:0,60,1", "--reconstruct", "none.exr"});
    const auto darkest = [this](const std::string& name) {
        float least = 0.0f;
        for (const Vec3f& radiance : readImage(folder.path() / name).pixels)
            least = std::min(least, radiance.x);
        return least;
    };
    constexpr float kRounding = 1e-5f;  // of a sun whose peak is about 2
    EXPECT_GE(darkest("auto.exr"), -kRounding);
    EXPECT_LT(darkest("none.exr"), -0.1f);
}

TEST_F(CliLight, WindowsLowerTheHigherBandsOnly) {
    const Json plain = coefficients({"sun:0,90,0", "--bands", "3"});
    const Json hann = coefficients({"sun:0,90,0", "--bands", "3", "--window", "hann"});
    const Json lanczos = coefficients({"sun:0,90,0", "--bands", "3", "--window", "lanczos"});
    const double x = std::numbers::pi / 3.0;  // l = 1 of n = 3
    EXPECT_EQ(hann[0], plain[0]);
    EXPECT_NEAR(hann[1][0].get<double>() / plain[1][0].get<double>(), 0.5 * (1.0 + std::cos(x)),
                kDoubleRounding);
    EXPECT_NEAR(lanczos[1][0].get<double>() / plain[1][0].get<double>(), std::sin(x) / x,
                kDoubleRounding);
}

TEST_F(CliLight, ShaderArraysHoldEveryCoefficient) {
    const std::string glsl = print({"uniform:1,0,0", "--bands", "2", "--format", "glsl"});
    EXPECT_NE(glsl.find("const vec3 kLighting[4] = vec3[4](\n    vec3(3.5449078, 0.0, 0.0),\n"),
              std::string::npos)
        << glsl;
    EXPECT_TRUE(glsl.ends_with("    vec3(0.0, 0.0, 0.0)\n);\n")) << glsl;
    const std::string hlsl = print({"uniform:1,0,0", "--bands", "2", "--format", "hlsl"});
    EXPECT_NE(hlsl.find("float3(3.5449078, 0.0, 0.0)"), std::string::npos) << hlsl;
    const std::string wgsl = print({"uniform:1,0,0", "--bands", "2", "--format", "wgsl"});
    EXPECT_NE(
        wgsl.find("const kLighting = array<vec3<f32>, 4>(\n    vec3<f32>(3.5449078, 0.0, 0.0),\n"),
        std::string::npos)
        << wgsl;
    const std::string c =
        print({"uniform:1,0,0", "--bands", "2", "--format", "c", "--convention", "d3dx"});
    EXPECT_NE(c.find("{3.5449078f, 0.0f, 0.0f}"), std::string::npos) << c;
    EXPECT_NE(c.find("d3dx"), std::string::npos) << c;
}

TEST_F(CliLight, MendedTexelsAreCountedInAWarning) {
    Image sky(8, 4, Vec3f(1.0f));
    sky.at(0, 0).x = std::numeric_limits<float>::quiet_NaN();
    sky.at(1, 1).y = -1.0f;
    sky.at(2, 1).y = -2.0f;
    writeExr(folder.path() / "sky.exr", sky);
    const CommandResult result = runPrt(folder, {"light", "sky.exr"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_TRUE(result.errors.starts_with("prt: warning: sky.exr: ")) << result.errors;
    EXPECT_NE(result.errors.find("1 with NaN"), std::string::npos) << result.errors;
    EXPECT_NE(result.errors.find("2 with a negative channel"), std::string::npos) << result.errors;
}

TEST_F(CliLight, ALayoutCanBeForced) {
    // A square image is taken as an angular map, half of whose corners
    // show nothing; a strip it is not.
    writeExr(folder.path() / "square.exr", Image(16, 16, Vec3f(1.0f)));
    EXPECT_NEAR(coefficients({"square.exr"})[0][0].get<double>(), 2.0 * std::sqrt(std::numbers::pi),
                1e-6);
    const CommandResult strip =
        runPrt(folder, {"light", "square.exr", "--map", "horizontal-strip"});
    EXPECT_EQ(strip.exitCode, 1) << strip.output;
}

}  // namespace
}  // namespace prt::test
