// prt render and prt compare of assets whose surfaces are shown as they are.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "prt/gltf/glb_writer.h"
#include "prt/io/image_io.h"
#include "tests/cli/run_prt.h"
#include "tests/support/scenes.h"

namespace prt::test {
namespace {

using Json = nlohmann::json;

/// A rough metal ball and a mirror on a matt floor, all of base colour 0.5, without bounces and
/// with one; and the same as if it were diffuse.
class GlossyAsset : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = new TemporaryFolder;
        Scene scene = assembleScene({{makeFloor(2.0f, 0.0f, 16)},
                                     {makeSphere(Vec3f(-0.6f, 0.51f, 0.0f), 0.5f, 24)},
                                     {makeSphere(Vec3f(0.6f, 0.51f, 0.0f), 0.5f, 24)}});
        const std::vector<std::string> names = {"floor", "rough", "mirror"};
        const std::vector<float> roughnesses = {1.0f, 0.7f, 0.1f};
        for (std::size_t i = 0; i < names.size(); ++i) {
            scene.materials[i].name = names[i];
            scene.materials[i].metallicFactor = i == 0 ? 0.0f : 1.0f;
            scene.materials[i].roughnessFactor = roughnesses[i];
        }
        writeGlb(file("balls.glb"), scene);
    }
    static void TearDownTestSuite() { delete folder_; }

    /// The name of a bake of the balls, which is made when it is first asked for.
    static std::string baked(const std::string& transport) {
        const std::string name = transport + ".prt.glb";
        if (std::filesystem::exists(file(name))) return name;
        run({"bake", "balls.glb", "-o", name, "--transport", transport, "--bands", "4", "--samples",
             "128", "--bounces", transport == "glossy" ? "1" : "0"});
        return name;
    }

    static CommandResult attempt(const std::vector<std::string>& arguments) {
        return runPrt(*folder_, arguments);
    }

    static void run(const std::vector<std::string>& arguments) {
        const CommandResult result = attempt(arguments);
        EXPECT_EQ(result.exitCode, 0) << result.errors;
    }

    /// Under light whose every direction differs.
    static Image render(const std::string& asset, const std::vector<std::string>& more) {
        std::vector<std::string> arguments = {"render", asset,      "--light", "sky:40,50,3",
                                              "-o",     "view.exr", "--size",  "80x45"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        run(arguments);
        return readImage(file("view.exr"));
    }

    static std::filesystem::path file(const std::string& name) { return folder_->path() / name; }
    static const TemporaryFolder& folder() { return *folder_; }

  private:
    static inline TemporaryFolder* folder_ = nullptr;
};

double relativeDifference(const Image& a, const Image& b) {
    double squares = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        squares += static_cast<double>((a.pixels[i] - b.pixels[i]).length2());
        sum += static_cast<double>(b.pixels[i].length2());
    }
    return std::sqrt(squares / sum);
}

TEST_F(GlossyAsset, IsShownAsItIsUnlessAskedOtherwise) {
    const Image glossy = render(baked("glossy"), {});
    // The diffuse layers stay what they are without matrices.
    const Image shadowed = render(baked("glossy"), {"--transport", "shadowed"});
    EXPECT_EQ(shadowed.pixels, render(baked("shadowed"), {}).pixels);
    EXPECT_GT(relativeDifference(glossy, shadowed), 0.1);
}

TEST_F(GlossyAsset, LambertBrdfsShowTheDiffusePicture) {
    constexpr double kTableError = 0.01;
    const std::vector<std::string> half = {"--brdf", "lambert:0.5,0.5,0.5"};
    const Image diffuse = render(baked("glossy-shadowed"), {"--transport", "shadowed"});
    EXPECT_LT(relativeDifference(render(baked("glossy-shadowed"), half), diffuse), kTableError);
    const std::vector<std::string> one = {"--brdf", "rough=lambert:0.5,0.5,0.5", "--brdf",
                                          "mirror=phong:0.5,0.5,0.5,20"};
    EXPECT_GT(relativeDifference(render(baked("glossy-shadowed"), one), diffuse), 0.1);
}

TEST_F(GlossyAsset, ComparesWithPathTracingOfTheSameMaterials) {
    run({"compare", baked("glossy"), "--light", "sky:40,50,3", "-o", "report", "--size", "80x45",
         "--reference-samples", "128", "--triple"});
    const Json report = Json::parse(readText(file("report") / "comparison.json"));
    EXPECT_EQ(report.at("transport"), "glossy");
    EXPECT_EQ(report.at("bounces"), 1);
    const Json& light = report.at("lights").at(0);
    const char* inBands = "the_light_in_its_bands";
    EXPECT_LT(light.at("against").at(inBands).at("relative_rmse_without_noise"), 0.05);
    EXPECT_LT(light.at("against").at(inBands).at("at_vertices").at("relative_rmse_without_noise"),
              0.1);

    std::map<std::string, Json> rows;
    for (const Json& row : light.at("by_material"))
        rows[row.at("material")] = row;
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows.at("mirror").at("metallic"), 1.0);
    EXPECT_EQ(rows.at("mirror").at("roughness"), 0.1) << "and not what a float makes of it";
    const auto error = [&](const std::string& material) {
        return rows.at(material).at("against").at(inBands).at("relative_rmse_without_noise");
    };
    EXPECT_LT(error("floor"), 0.03);
    EXPECT_LT(error("rough"), 0.06);
    EXPECT_LT(error("mirror"), 0.25);  // its neighbours are mirrored in bands only

    const Json& transports = light.at("by_transport");
    ASSERT_EQ(transports.size(), 6u);
    EXPECT_EQ(transports.at(3).at("transport"), "glossy-unshadowed");
    for (std::size_t i = 0; i < 5; ++i)
        EXPECT_GT(transports.at(i).at("relative_rmse_without_noise"),
                  transports.at(5).at("relative_rmse_without_noise"))
            << transports.at(i).at("transport");
    const std::string page = readText(file("report") / "index.html");
    for (const char* word : {"Material by material", "roughness", "light1-relit-in-bands.png"})
        EXPECT_NE(page.find(word), std::string::npos) << word;
}

TEST_F(GlossyAsset, ComparesOtherBrdfs) {
    run({"compare", baked("glossy-shadowed"), "--light", "sky:40,50,3", "-o", "phong", "--size",
         "64x36", "--reference-samples", "64", "--brdf", "phong:0.5,0.4,0.3,4"});
    const Json report = Json::parse(readText(file("phong") / "comparison.json"));
    const Json& light = report.at("lights").at(0);
    EXPECT_LT(light.at("against").at("the_light_in_its_bands").at("relative_rmse_without_noise"),
              0.06);  // four bands of the lobe
    for (const Json& row : light.at("by_material"))
        EXPECT_TRUE(row.at("replaced").get<bool>());
}

TEST_F(GlossyAsset, WarnsOfALobeThatItsBandsLose) {
    const auto renderWith = [](const std::string& brdf) {
        return attempt({"render", baked("glossy-shadowed"), "--light", "uniform:1", "-o",
                        "lobe.exr", "--size", "8x8", "--brdf", brdf});
    };
    const CommandResult lost = renderWith("rough=phong:1,1,1,200");
    EXPECT_EQ(lost.exitCode, 0);
    EXPECT_NE(lost.errors.find("5 bands lose 9"), std::string::npos) << lost.errors;
    EXPECT_NE(lost.errors.find("gives rough"), std::string::npos) << lost.errors;
    const CommandResult held = renderWith("rough=phong:1,1,1,2");
    EXPECT_EQ(held.exitCode, 0);
    EXPECT_EQ(held.errors.find("lose"), std::string::npos) << held.errors;
}

TEST_F(GlossyAsset, WrongInputIsOneSentence) {
    struct Wrong {
        std::vector<std::string> arguments;
        std::string word;
    };
    const std::vector<Wrong> wrongs = {
        {{baked("shadowed"), "--transport", "glossy"}, "bake it with --transport glossy"},
        {{baked("shadowed"), "--transport", "glossy-unshadowed"}, "bake it with --transport"},
        {{baked("glossy-shadowed"), "--transport", "glossy"}, "without glossy transport"},
        {{baked("shadowed"), "--brdf", "lambert:1,1,1"}, "bake it with --transport glossy"},
        {{baked("glossy-shadowed"), "--transport", "shadowed", "--brdf", "lambert:1,1,1"},
         "--brdf"},
        {{baked("glossy-shadowed"), "--brdf", "gold=lambert:1,1,1"}, "gold"},
        {{baked("glossy-shadowed"), "--transport", "shiny"}, "shiny"}};
    const std::ptrdiff_t fileCount = folder().fileCount();
    for (const std::string command : {"render", "compare"})
        for (const Wrong& wrong : wrongs) {
            std::vector<std::string> arguments = {command, "--light", "uniform:1", "-o",
                                                  command == "render" ? "wrong.png" : "wrong"};
            arguments.insert(arguments.end(), wrong.arguments.begin(), wrong.arguments.end());
            const CommandResult result = attempt(arguments);
            EXPECT_EQ(result.exitCode, 2) << result.errors;
            EXPECT_NE(result.errors.find("prt: error: "), std::string::npos) << result.errors;
            EXPECT_NE(result.errors.find(wrong.word), std::string::npos) << result.errors;
        }
    const CommandResult window = attempt({"render", baked("glossy-shadowed"), "--light",
                                          "sun:40,55,0", "-o", "wrong.png", "--window", "auto"});
    EXPECT_EQ(window.exitCode, 2);
    EXPECT_NE(window.errors.find("name a window"), std::string::npos) << window.errors;
    EXPECT_EQ(folder().fileCount(), fileCount);
    // Of diffuse surfaces it still finds one.
    render(baked("glossy-shadowed"), {"--transport", "shadowed", "--window", "auto"});
}

}  // namespace
}  // namespace prt::test
