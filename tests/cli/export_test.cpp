// prt export --frozen: a plain GLB with its light in COLOR_0.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "prt/asset/asset.h"
#include "prt/base/file.h"
#include "prt/basis/sh_window.h"
#include "prt/gltf/glb_writer.h"
#include "prt/gltf/gltf_scene.h"
#include "prt/image/tone_curve.h"
#include "prt/io/image_io.h"
#include "prt/light/analytic_lights.h"
#include "prt/relight/relighter.h"
#include "prt/render/render_view.h"
#include "prt/scene/framing.h"
#include "tests/cli/run_prt.h"
#include "tests/gltf/glb_file.h"
#include "tests/support/scenes.h"

namespace prt::test {
namespace {

using Json = nlohmann::json;

constexpr int kDataAtFault = 1, kWrongUsage = 2;

// The light of the test and that of the program differ by rounding of an angle in double precision.
constexpr float kRounding = 1e-5f;

TextureImage makeChequer() {
    Rgba8Image pixels(2, 2);
    for (int i = 0; i < 4; ++i)
        pixels.at(i % 2, i / 2) = i % 3 == 0 ? Rgba8{240, 200, 160, 255} : Rgba8{60, 90, 200, 255};
    return {
        .name = "chequers", .mimeType = "image/png", .encoded = encodePng(pixels), .pixels = {}};
}

/// A ball of painted vertices over a floor of chequers, and a lamp.
Scene makeStage() {
    Scene scene =
        assembleScene({{makeFloor(2.0f, 0.0f, 12), {0.9f, 0.8f, 0.7f}},
                       {makeSphere(Vec3f(0.0f, 0.51f, 0.0f), 0.5f, 16), {0.8f, 0.8f, 0.8f}},
                       {makeSphere(Vec3f(1.0f, 0.21f, 0.3f), 0.2f, 8), {0.5f, 0.5f, 0.5f}}});
    scene.images = {makeChequer()};
    scene.materials[0].baseColorTexture = TextureUse{};
    scene.materials[0].metallicRoughnessTexture = TextureUse{};
    scene.materials[1].metallicFactor = 0.25f;
    scene.materials[1].roughnessFactor = 0.75f;
    scene.materials[2].emissiveFactor = Vec3f(0.25f, 0.125f, 0.0f);
    Mesh& floor = scene.meshes[0];
    floor.uvSets[0].clear();
    for (const Vec3f& position : floor.positions)
        floor.uvSets[0].push_back({position.x, position.z});
    for (const Vec3f& position : scene.meshes[1].positions)
        scene.meshes[1].colors.push_back({0.5f + 0.5f * position.x, 1.0f, position.y, 1.0f});
    return scene;
}

/// The same without textures and vertex colours: what leaves it is linear in each triangle.
Scene makePlainStage() {
    Scene scene = makeStage();
    scene.images.clear();
    for (Material& material : scene.materials)
        material.baseColorTexture = material.metallicRoughnessTexture = std::nullopt;
    for (Mesh& mesh : scene.meshes)
        mesh.colors.clear();
    return scene;
}

class CliExport : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = new TemporaryFolder;
        writeGlb(file("interreflected.glb"), makeStage());
        writeGlb(file("glossy.glb"), makePlainStage());
        for (const std::string transport : {"interreflected", "glossy"})
            run({"bake", transport + ".glb", "-o", transport + ".prt.glb", "--transport", transport,
                 "--bands", "4", "--samples", "64", "--bounces", "1", "--max-edge", "none"});
    }
    static void TearDownTestSuite() { delete folder_; }

    static CommandResult attempt(const std::vector<std::string>& arguments) {
        return runPrt(*folder_, arguments);
    }
    static CommandResult run(const std::vector<std::string>& arguments) {
        CommandResult result = attempt(arguments);
        EXPECT_EQ(result.exitCode, 0) << result.errors;
        return result;
    }
    /// @return  the frozen scene
    static Scene freeze(const std::string& asset, const std::vector<std::string>& more) {
        std::vector<std::string> arguments = {"export", asset, "--frozen", "-o", "out.glb"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        run(arguments);
        return readGltf(file("out.glb"));
    }
    static void expectRefused(const std::vector<std::string>& arguments, int exitCode,
                              const std::vector<std::string>& words) {
        test::expectRefused(*folder_, arguments, exitCode, words);
    }
    static std::filesystem::path file(const std::string& name) { return folder_->path() / name; }

  private:
    static inline TemporaryFolder* folder_ = nullptr;
};

/// factor · vertex colour · B, and what is emitted where there is no texture, each channel clamped.
void expectFrozen(const Scene& frozen, const Asset& asset, Transport transport,
                  const Lighting& lighting, float exposureStops) {
    const Relighter relighter(asset.transfer, transport);
    std::vector<Vec3f> radiance(relighter.receiverCount());
    relighter.relight(lighting, radiance);
    const float exposure = std::exp2(exposureStops);
    ASSERT_EQ(frozen.meshes.size(), asset.scene.meshes.size());
    std::size_t vertex = 0, unclamped = 0;
    for (std::size_t m = 0; m < frozen.meshes.size(); ++m) {
        const Mesh& mesh = asset.scene.meshes[m];
        const Material& material = asset.scene.materials[mesh.material];
        ASSERT_EQ(frozen.meshes[m].positions, mesh.positions);
        ASSERT_EQ(frozen.meshes[m].indices, mesh.indices);
        for (std::size_t i = 0; i < mesh.vertexCount(); ++i, ++vertex)
            for (int c = 0; c < 3; ++c) {
                float expected = material.baseColorFactor[c] * radiance[vertex][c];
                if (!mesh.colors.empty()) expected *= mesh.colors[i][c];
                if (!material.baseColorTexture) expected += material.emissiveFactor[c];
                expected *= exposure;
                unclamped += expected > 0.0f && expected < 1.0f;
                ASSERT_NEAR(frozen.meshes[m].colors[i][c], std::clamp(expected, 0.0f, 1.0f),
                            kRounding)
                    << m << " " << i;
            }
    }
    EXPECT_GT(unclamped, vertex);  // of three channels each
}

TEST_F(CliExport, ColoursAreTheRelitVertices) {
    const Asset asset = readAsset(file("interreflected.prt.glb"));
    const double elevation = 50.0 * std::numbers::pi / 180.0;
    const Lighting sun = sunLighting(Vec3d(std::cos(elevation), std::sin(elevation), 0.0),
                                     10.0 * std::numbers::pi / 180.0, asset.transfer.bandCount);
    const std::vector<std::string> light = {"--light", "sun:0,50,20"};
    const auto withLight = [&](std::vector<std::string> more) {
        more.insert(more.end(), light.begin(), light.end());
        return more;
    };
    expectFrozen(freeze("interreflected.prt.glb", withLight({"--exposure", "1"})), asset,
                 Transport::interreflected, sun, 1.0f);
    expectFrozen(freeze("interreflected.prt.glb",
                        withLight({"--transport", "shadowed", "--exposure", "-1.5"})),
                 asset, Transport::shadowed, sun, -1.5f);
    // A rotation by 90 degrees about y takes azimuth 0 to -90.
    const Lighting turned = sunLighting(Vec3d(0.0, std::sin(elevation), -std::cos(elevation)),
                                        10.0 * std::numbers::pi / 180.0, asset.transfer.bandCount);
    expectFrozen(
        freeze("interreflected.prt.glb", withLight({"--rotate", "0,90,0", "--exposure", "0"})),
        asset, Transport::interreflected, turned, 0.0f);
    expectFrozen(
        freeze("interreflected.prt.glb", withLight({"--window", "hann", "--exposure", "0"})), asset,
        Transport::interreflected, applyWindow(sun, windowFactors(ShWindow::hann, sun.bandCount)),
        0.0f);
}

TEST_F(CliExport, TheAutomaticExposureShowsAWhiteSideAsEightTenths) {
    constexpr float kOfA64thOfTheSky = 1e-3f;
    const Scene frozen =
        freeze("interreflected.prt.glb", {"--light", "uniform:5", "--transport", "unshadowed"});
    for (const Vec4f& color : frozen.meshes[0].colors) {
        EXPECT_NEAR(color.x, 0.8f * 0.9f, kOfA64thOfTheSky);
        EXPECT_NEAR(color.y, 0.8f * 0.8f, kOfA64thOfTheSky);
        EXPECT_EQ(color.w, 1.0f);
    }
}

TEST_F(CliExport, TheToneCurveIsAppliedAtTheVertices) {
    const std::vector<std::string> light = {"--light",    "uniform:1",  "--transport",
                                            "unshadowed", "--exposure", "0"};
    const auto colorUnder = [&](const std::string& curve) {
        std::vector<std::string> more = light;
        more.insert(more.end(), {"--tone", curve});
        return freeze("interreflected.prt.glb", more).meshes[0].colors[0];
    };
    const Vec3f floor(0.9f, 0.8f, 0.7f);
    for (const ToneCurve curve : {ToneCurve::none, ToneCurve::aces, ToneCurve::neutral}) {
        const Rgba8 expected = encodeForDisplay(Image(1, 1, floor), {0.0f, curve}).at(0, 0);
        const Vec4f color = colorUnder(std::string(toneCurveName(curve)));
        constexpr float kHalfACodeValue = 0.501f;
        EXPECT_NEAR(255.0f * encodeSrgb(color.x), expected.red, kHalfACodeValue);
        EXPECT_NEAR(255.0f * encodeSrgb(color.z), expected.blue, kHalfACodeValue);
    }
}

TEST_F(CliExport, TheFileIsPlainGltfWithoutLightOrTransfer) {
    freeze("interreflected.prt.glb", {"--light", "uniform:1"});
    const GlbFile glb = splitGlb(readFile(file("out.glb"), 1 << 26));
    const std::string text = glb.json.dump();
    EXPECT_EQ(text.find("OPENPRT"), std::string::npos);
    EXPECT_EQ(text.find("_PRT"), std::string::npos);
    EXPECT_EQ(text.find("metallicRoughnessTexture"), std::string::npos);
    EXPECT_EQ(text.find("emissive"), std::string::npos);
    EXPECT_EQ(glb.json.at("extensionsUsed"), Json::array({"KHR_materials_unlit"}));
    for (const Json& material : glb.json.at("materials"))
        EXPECT_TRUE(material.at("extensions").contains("KHR_materials_unlit"));
    EXPECT_TRUE(
        glb.json.at("materials")[0].at("pbrMetallicRoughness").contains("baseColorTexture"));
    EXPECT_EQ(glb.json.at("images").size(), 1u);
}

TEST_F(CliExport, OfSeveralLightsEachHasAFileOfItsOwn) {
    writeExr(file("museum.exr"), Image(16, 8, Vec3f(0.5f, 1.0f, 2.0f)));
    run({"export", "interreflected.prt.glb", "--frozen", "--light", "museum.exr", "--light",
         "sun:60,40,10", "-o", "lit.glb"});
    EXPECT_FALSE(std::filesystem::exists(file("lit.glb")));
    for (const auto& [light, name] : {std::pair("museum.exr", "lit-museum.glb"),
                                      std::pair("sun:60,40,10", "lit-sun-60-40-10.glb")}) {
        freeze("interreflected.prt.glb", {"--light", light});
        EXPECT_EQ(readText(file("out.glb")), readText(file(name))) << name;
    }
}

/// The bands hold all of these lobes, so no mirror is in the picture, and what leaves a point of
/// one base colour is linear in the triangle.
TEST_F(CliExport, SurfacesThatShineAreFrozenAsOneEyeSeesThem) {
    const std::vector<std::string> view = {"--light", "sky:40,50,3", "--transport", "glossy"};
    std::vector<std::string> render = {"render", "glossy.prt.glb", "-o",    "seen.exr", "--eye",
                                       "1,2,3",  "--target",       "0,0,0", "--size",   "48x27"};
    render.insert(render.end(), view.begin(), view.end());
    run(render);
    std::vector<std::string> more = {"--eye", "1,2,3", "--exposure", "-6"};
    more.insert(more.end(), view.begin(), view.end());
    Scene frozen = freeze("glossy.prt.glb", more);
    std::vector<Vec3f> colors;
    for (Mesh& mesh : frozen.meshes) {
        for (const Vec4f& color : mesh.colors)
            colors.push_back({color.x, color.y, color.z});
        mesh.colors.clear();
    }
    const Image shown =
        renderView(frozen, RayScene(frozen), colors,
                   lookAt(Vec3f(1.0f, 2.0f, 3.0f), Vec3f(0.0f), std::numbers::pi_v<float> / 4.0f),
                   {.width = 48, .height = 27});
    const Image seen = readImage(file("seen.exr"));
    constexpr float kSixStops = 64.0f;
    float brightest = 0.0f;
    for (std::size_t i = 0; i < shown.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            brightest = std::max(brightest, shown.pixels[i][c]);
            EXPECT_NEAR(shown.pixels[i][c], seen.pixels[i][c] / kSixStops, kRounding) << i;
        }
    EXPECT_GT(brightest, 0.1f);
    EXPECT_LT(brightest, 1.0f);
}

TEST_F(CliExport, WithoutAnEyeNothingShines) {
    const std::vector<std::string> light = {"--light", "uniform:1", "--exposure", "0"};
    const auto expectWithout = [&](const std::string& asset, const std::vector<std::string>& more,
                                   const std::vector<std::string>& words) {
        std::vector<std::string> arguments = {"export", asset, "--frozen", "-o", "never.glb"};
        arguments.insert(arguments.end(), light.begin(), light.end());
        arguments.insert(arguments.end(), more.begin(), more.end());
        expectRefused(arguments, kWrongUsage, words);
    };
    const Asset asset = readAsset(file("glossy.prt.glb"));
    expectFrozen(freeze("glossy.prt.glb", light), asset, Transport::interreflected,
                 uniformLighting(Vec3d(1.0), asset.transfer.bandCount), 0.0f);
    const std::string told =
        run({"export", "glossy.prt.glb", "--frozen", "-o", "out.glb", "--light", "uniform:1"})
            .errors;
    EXPECT_NE(told.find("taken for diffuse (--camera or --eye"), std::string::npos) << told;
    expectWithout("glossy.prt.glb", {"--transport", "glossy"}, {"--transport", "--eye"});
    expectWithout("glossy.prt.glb", {"--transport", "shadowed", "--eye", "0,1,2"},
                  {"--eye", "shadowed"});
    expectWithout("glossy.prt.glb", {"--camera", "front"}, {"'front'"});
    expectWithout("glossy.prt.glb", {"--camera", "front", "--eye", "1,1,1"}, {"--camera"});

    run({"compress", "glossy.prt.glb", "--transport", "glossy", "-o", "matrices.prt.glb"});
    expectWithout("matrices.prt.glb", {}, {"matrices.prt.glb", "--camera or --eye"});
    const std::vector<std::string> byNormals = {"--light", "uniform:1", "--transport",
                                                "unshadowed"};
    EXPECT_NEAR(freeze("matrices.prt.glb", byNormals).meshes[0].colors[0].x, 0.8f * 0.9f, 1e-3f);
}

TEST_F(CliExport, WrongInputIsOneSentence) {
    const auto command = [](const std::vector<std::string>& more) {
        std::vector<std::string> arguments = {"export", "interreflected.prt.glb"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    };
    expectRefused(command({"--light", "uniform:1", "-o", "a.glb"}), kWrongUsage, {"--frozen"});
    expectRefused(command({"--frozen", "-o", "a.glb"}), kWrongUsage, {"--light"});
    expectRefused(command({"--frozen", "--light", "uniform:1"}), kWrongUsage, {"--output"});
    const auto frozen = [&](std::vector<std::string> more) {
        more.insert(more.begin(), "--frozen");
        return command(more);
    };
    expectRefused(frozen({"--light", "uniform:1", "-o", "a.gltf"}), kWrongUsage,
                  {"a.gltf", ".glb"});
    expectRefused(frozen({"--light", "uniform:1", "-o", "interreflected.prt.glb"}), kWrongUsage,
                  {"overwrite"});
    expectRefused(frozen({"--light", "uniform:1", "-o", "nowhere/a.glb"}), kDataAtFault,
                  {"nowhere/a.glb", "cannot be written"});
    expectRefused(frozen({"--light", "lost.exr", "-o", "a.glb"}), kDataAtFault, {"lost.exr"});
    expectRefused(frozen({"--light", "uniform:1", "--light", "lost.exr", "-o", "a.glb"}),
                  kDataAtFault, {"lost.exr"});
    expectRefused(frozen({"--light", "uniform:1", "--light", "uniform:1", "-o", "a.glb"}),
                  kWrongUsage, {"a-uniform-1.glb", "two lights"});
    expectRefused(frozen({"--light", "uniform:1", "-o", "a.glb", "--exposure", "bright"}),
                  kWrongUsage, {"--exposure", "'bright'", "auto|EV"});
    expectRefused(frozen({"--light", "uniform:1", "-o", "a.glb", "--exposure", "101"}), kWrongUsage,
                  {"--exposure"});
    expectRefused(frozen({"--light", "uniform:1", "-o", "a.glb", "--tone", "sepia"}), kWrongUsage,
                  {"--tone", "'sepia'"});
    expectRefused(frozen({"--light", "uniform:1", "-o", "a.glb", "--transport", "glossy"}),
                  kWrongUsage, {"interreflected.prt.glb", "without glossy"});
    expectRefused({"export", "glossy.glb", "--frozen", "--light", "uniform:1", "-o", "a.glb"},
                  kDataAtFault, {"glossy.glb"});
}

}  // namespace
}  // namespace prt::test
