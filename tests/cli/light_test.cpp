// prt light: coefficients as people and programs read them.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
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

TEST_F(CliLight, SeveralLightsAddUpAndScale) {
    const Json sum = coefficients({"sun:10,20,30", "uniform:1,2,3", "--scale", "0.5,1,2"});
    const Json sun = coefficients({"sun:10,20,30"});
    const Json uniform = coefficients({"uniform:1,2,3"});
    const double factors[] = {0.5, 1.0, 2.0};
    for (std::size_t i = 0; i < sum.size(); ++i)
        for (std::size_t channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(sum[i][channel].get<double>(),
                        factors[channel] *
                            (sun[i][channel].get<double>() + uniform[i][channel].get<double>()),
                        kDoubleRounding);
    expectNear(coefficients({"sun:10,20,30", "--scale", "2"}),
               coefficients({"sun:10,20,30", "sun:10,20,30"}), kDoubleRounding);
}

TEST_F(CliLight, CoefficientsFromAFileKeepTheirBands) {
    writeText(folder.path() / "two.json",
              print({"sun:30,45,20", "--format", "json", "--bands", "2"}));
    EXPECT_EQ(coefficients({"two.json", "--bands", "5"}).size(), 4u);
    EXPECT_EQ(coefficients({"two.json", "uniform:1", "--bands", "5"}).size(), 25u);
}

TEST_F(CliLight, DaylightIsSkyAndSun) {
    const Json sky = coefficients({"sky:30,40,3", "--bands", "3"});
    const Json daylight = coefficients({"daylight:30,40", "--bands", "3"});
    // The sun gives some 100 klx, so it adds some 30 to the first coefficient.
    EXPECT_GT(daylight[0][1].get<double>(), sky[0][1].get<double>() + 15.0);
    EXPECT_GT(sky[0][2].get<double>(), sky[0][0].get<double>()) << "the sky is blue";
}

TEST_F(CliLight, AnEnvironmentIsTheSameLightInEveryLayout) {
    const Json truth =
        coefficients({"sky:30,40", "--rotate", "0,70,0", "--scale", "2", "--bands", "3"});
    for (const std::string layout : {"lat-long", "angular-map", "vertical-cross",
                                     "horizontal-cross", "vertical-strip", "octahedral"}) {
        print({"sky:30,40", "--rotate", "0,70,0", "--scale", "2", "--environment", "sky.exr",
               "--layout", layout, "--size", "96"});
        const Json back = coefficients({"sky.exr", "--map", layout, "--bands", "3"});
        expectNear(back, truth, 0.01 * truth[0][2].get<double>());
    }
    const Image cross = readImage(folder.path() / "sky.exr");
    EXPECT_EQ(cross.width, 96);
}

TEST_F(CliLight, ASunThatWasTakenOutCanBeAddedAgain) {
    const CommandResult rest =
        runPrt(folder, {"light", "daylight:30,40", "--split-sun", "--format", "json"});
    ASSERT_EQ(rest.exitCode, 0) << rest.errors;
    writeText(folder.path() / "rest.json", rest.output);
    // "prt: took out sun:azimuth,elevation,angle --scale r,g,b"
    const std::size_t start = rest.errors.find("sun:"), space = rest.errors.find(' ', start);
    ASSERT_NE(start, std::string::npos) << rest.errors;
    const std::string sun = rest.errors.substr(start, space - start);
    std::string factor = rest.errors.substr(rest.errors.find("--scale ") + 8);
    factor.pop_back();
    EXPECT_TRUE(sun.starts_with("sun:30.0") || sun.starts_with("sun:29.9")) << sun;
    writeText(folder.path() / "sun.json", print({sun, "--scale", factor, "--format", "json"}));
    const Json truth = coefficients({"daylight:30,40"});
    expectNear(coefficients({"rest.json", "sun.json"}), truth, 0.01 * truth[0][0].get<double>());

    const CommandResult none = runPrt(folder, {"light", "uniform:1", "--split-sun"});
    EXPECT_NE(none.errors.find("no sun"), std::string::npos) << none.errors;
}

TEST_F(CliLight, IrradianceNeedsLessSmoothingThanRadianceAndAnAssetMayNeedNone) {
    runPrt(folder, {"scene", "bowl", "-o", "bowl.glb"});
    const CommandResult bake = runPrt(
        folder, {"bake", "bowl.glb", "-o", "bowl.prt.glb", "--bands", "4", "--samples", "64"});
    ASSERT_EQ(bake.exitCode, 0) << bake.errors;
    const auto lastCoefficient = [&](std::vector<std::string> window) {
        std::vector<std::string> words = {"sun:20,50,0", "--bands", "4"};
        words.insert(words.end(), window.begin(), window.end());
        return std::abs(coefficients(words)[9][0].get<double>());
    };
    const double plain = lastCoefficient({});
    const double irradiance = lastCoefficient({"--window", "auto", "--nonnegative", "irradiance"});
    const double radiance = lastCoefficient({"--window", "auto"});
    const double asset = lastCoefficient({"--window", "auto", "--nonnegative", "bowl.prt.glb"});
    EXPECT_LT(radiance, irradiance);
    EXPECT_LT(irradiance, plain);
    EXPECT_GT(asset, radiance);

    const CommandResult tooMany = runPrt(
        folder, {"light", "sun:20,50,0", "--window", "auto", "--nonnegative", "bowl.prt.glb"});
    EXPECT_EQ(tooMany.exitCode, 2);
    EXPECT_NE(tooMany.errors.find("--bands 4"), std::string::npos) << tooMany.errors;
    EXPECT_EQ(runPrt(folder, {"light", "uniform:1", "--nonnegative", "irradiance"}).exitCode, 2);
}

TEST_F(CliLight, AConventionRefusesMoreBandsThanItHas) {
    const CommandResult result = runPrt(folder, {"light", "uniform:1", "--convention", "unity"});
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_NE(result.errors.find("at most 3 bands"), std::string::npos) << result.errors;
}

TEST_F(CliLight, SixtyFourBandsAreReadBack) {
    writeText(folder.path() / "many.json",
              print({"sun:30,45,20", "--format", "json", "--bands", "64"}));
    const Json many = coefficients({"many.json", "--bands", "64", "--rotate", "0,30,0"});
    ASSERT_EQ(many.size(), 4096u);
    // The azimuth runs against rotations about y. Of a disc of radiance 10 some terms of 1 remain.
    expectNear(many, coefficients({"sun:0,45,20", "--bands", "64"}), 1e-9);
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"--window", "auto"}, {"--report", "page"}}) {
        std::vector<std::string> command = {"light", "sun:30,45,20", "--bands", "64"};
        command.insert(command.end(), words.begin(), words.end());
        EXPECT_EQ(runPrt(folder, command).exitCode, 2) << words[0];
    }
}

TEST_F(CliLight, AReportShowsTheLightItsBandsAndItsNumbers) {
    const std::string table =
        print({"sky:30,40", "--bands", "3", "--window", "hann", "--report", "page"});
    const std::string page = readText(folder.path() / "page" / "index.html");
    // Every picture that the page shows is there.
    std::size_t pictureCount = 0;
    for (std::size_t at = page.find("src=\""); at != std::string::npos;
         at = page.find("src=\"", at + 1), ++pictureCount) {
        const std::string name = page.substr(at + 5, page.find('"', at + 5) - at - 5);
        EXPECT_TRUE(std::filesystem::exists(folder.path() / "page" / name)) << name;
    }
    EXPECT_GE(pictureCount, 16u);
    EXPECT_NE(page.find("sky:30,40 as a light"), std::string::npos);
    EXPECT_NE(page.find("9.4 %"), std::string::npos) << "of the worst light, edge-on";
    for (const std::string name : {"unity", "godot", "3dgs", "filament"})
        EXPECT_NE(page.find("<b>" + name + "</b>"), std::string::npos);
    // lighting.json is what was printed.
    expectNear(coefficients({"page/lighting.json", "--bands", "3"}),
               coefficients({"sky:30,40", "--bands", "3", "--window", "hann"}), kDoubleRounding);
    EXPECT_EQ(table, print({"sky:30,40", "--bands", "3", "--window", "hann"}));

    const CommandResult again = runPrt(folder, {"light", "sky:30,40", "--report", "page"});
    EXPECT_EQ(again.exitCode, 2) << "a folder that is there is not overwritten";
}

TEST_F(CliLight, PrefilteredCubesGoFromTheMirrorToTheMatt) {
    print({"sky:30,40", "--prefilter", "cubes", "--prefilter-size", "16"});
    double lastBrightest = 1e9;
    for (const std::string name : {"roughness-0.00", "roughness-0.40", "roughness-1.00"}) {
        const Image cube = readImage(folder.path() / "cubes" / (name + ".exr"));
        EXPECT_EQ(cube.width, 16);
        EXPECT_EQ(cube.height, 96);
        double brightest = 0.0;
        for (const Vec3f& texel : cube.pixels)
            brightest = std::max(brightest, static_cast<double>(texel.y));
        EXPECT_LT(brightest, lastBrightest) << name;
        lastBrightest = brightest;
    }
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "cubes" / "diffuse.exr"));
}

TEST_F(CliLight, AReportOfDarknessIsAPageToo) {
    print({"uniform:0", "--report", "dark"});
    EXPECT_NE(readText(folder.path() / "dark" / "index.html").find("uniform:0 as a light"),
              std::string::npos);
}

}  // namespace
}  // namespace prt::test
