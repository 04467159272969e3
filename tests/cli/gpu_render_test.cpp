// prt render --gpu: the picture that rays draw.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "prt/gltf/glb_writer.h"
#include "prt/io/image_io.h"
#include "prt/scene/framing.h"
#include "tests/cli/run_prt.h"
#include "tests/support/scenes.h"
#include "tests/support/surface_pixels.h"

namespace prt::test {
namespace {

/// Over the pixels that show one mesh, or the background, through all their rays.
constexpr double kLeastPsnr = 50.0;

const std::vector<std::string> kViewOptions = {"--eye",  "1.2,1.5,3", "--target", "0,0.4,0",
                                               "--fov",  "40",        "--light",  "sky.exr",
                                               "--size", "96x72"};

/// Without edges, since rays of a pixel look through random places of it; none brighter than 1.
Image drawSky() {
    Image sky(64, 32);
    for (int y = 0; y < sky.height; ++y)
        for (int x = 0; x < sky.width; ++x)
            sky.at(x, y) = Vec3f(0.5f + 0.45f * std::sin(0.19634954f * static_cast<float>(x)),
                                 0.03f * static_cast<float>(sky.height - y), 0.5f);
    return sky;
}

Rgba8Image drawStripes(std::uint8_t leastAlpha) {
    Rgba8Image image(8, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            image.at(x, y) = {static_cast<std::uint8_t>(140 + 10 * x),
                              static_cast<std::uint8_t>(220 - 12 * y), 180,
                              (x / 2) % 2 == 0 ? std::uint8_t{255} : leastAlpha};
    return image;
}

/// A textured floor, a matt ball, one of metal, and a double-sided sheet with holes.
Scene makeVariedScene(float metalRoughness) {
    Scene scene = assembleScene({{makeFloor(2.0f, 0.0f, 12), {0.9f, 0.8f, 0.7f}},
                                 {makeSphere({-0.6f, 0.45f, 0.0f}, 0.4f, 24), {0.8f, 0.3f, 0.2f}},
                                 {makeSphere({0.5f, 0.45f, 0.3f}, 0.4f, 24), {0.9f, 0.9f, 0.6f}},
                                 {makeQuad({-1.0f, 0.1f, -0.8f}, {-1.0f, 1.4f, -1.0f},
                                           {1.0f, 1.4f, -1.0f}, {1.0f, 0.1f, -0.8f}),
                                  {1.0f, 1.0f, 1.0f},
                                  true}});
    for (const std::uint8_t leastAlpha : {std::uint8_t{255}, std::uint8_t{0}})
        scene.images.push_back(
            {"stripes", "image/png", encodePng(drawStripes(leastAlpha)), drawStripes(leastAlpha)});
    for (const std::size_t m : {std::size_t{0}, std::size_t{3}})
        for (const Vec3f& p : scene.meshes[m].positions)
            scene.meshes[m].uvSets[0].push_back(Vec2f(0.4f * p.x, 0.4f * (p.y + p.z)));
    scene.materials[0].baseColorTexture = TextureUse{0};
    scene.materials[2].metallicFactor = 1.0f;
    scene.materials[2].roughnessFactor = metalRoughness;
    scene.materials[3].baseColorTexture = TextureUse{1};
    scene.materials[3].alphaMode = AlphaMode::mask;
    return scene;
}

class CliGpuRender : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = new TemporaryFolder;
        writeGlb(file("rough.glb"), makeVariedScene(1.0f));
        writeGlb(file("mirror.glb"), makeVariedScene(0.1f));
        writeExr(file("sky.exr"), drawSky());
        bake("rough.glb", "float.prt.glb", "interreflected");
        bake("rough.glb", "glossy.prt.glb", "glossy");
        bake("mirror.glb", "mirror.prt.glb", "glossy-shadowed");
    }
    static void TearDownTestSuite() { delete folder_; }

    /// Skipped where there is no EGL, and nowhere else.
    void SetUp() override {
        const CommandResult result = render("float.prt.glb", {"--gpu"}, "first.exr");
        if (result.errors.find("no EGL library") != std::string::npos) GTEST_SKIP();
        ASSERT_EQ(result.exitCode, 0) << result.errors;
    }

    static void bake(const std::string& scene, const std::string& name,
                     const std::string& transport) {
        run({"bake", scene, "-o", name, "--transport", transport, "--bands", "3", "--samples", "64",
             "--bounces", transport == "glossy-shadowed" ? "0" : "1"});
    }

    static CommandResult render(const std::string& asset, const std::vector<std::string>& more,
                                const std::string& output) {
        std::vector<std::string> arguments = {"render", asset, "-o", output};
        arguments.insert(arguments.end(), kViewOptions.begin(), kViewOptions.end());
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPrt(*folder_, arguments);
    }

    static Image renderImage(const std::string& asset, const std::vector<std::string>& more) {
        const CommandResult result = render(asset, more, "view.exr");
        EXPECT_EQ(result.exitCode, 0) << result.errors;
        return readImage(file("view.exr"));
    }

    static void run(const std::vector<std::string>& arguments) {
        const CommandResult result = runPrt(*folder_, arguments);
        EXPECT_EQ(result.exitCode, 0) << result.errors;
    }

    void expectSamePicture(const std::string& asset, std::vector<std::string> more) const {
        const Image expected = renderImage(asset, more);
        more.push_back("--gpu");
        const Image drawn = renderImage(asset, more);
        const PixelAgreement inside = comparePixels(drawn, expected, isWhole_, true);
        std::string what = asset;
        for (const std::string& option : more)
            what += " " + option;
        EXPECT_GE(inside.psnr, kLeastPsnr) << what;
        EXPECT_GE(inside.share, 0.7) << what;
        // There is something to see.
        EXPECT_LE(comparePixels(expected, Image(96, 72), isWhole_, true).psnr, 25.0) << what;
    }

    static std::filesystem::path file(const std::string& name) { return folder_->path() / name; }

  private:
    static inline TemporaryFolder* folder_ = nullptr;
    const Scene scene_ = makeVariedScene(1.0f);
    const RayScene rays_{scene_};
    const std::vector<bool> isWhole_ = findSurfacePixels(
        scene_, rays_, lookAt({1.2f, 1.5f, 3.0f}, {0.0f, 0.4f, 0.0f}, 0.69813170079773184f),
        {.width = 96, .height = 72});
};

TEST_F(CliGpuRender, EveryFormOfVectorsGivesThePictureOfRays) {
    for (const std::string method : {"float", "u16", "u8", "pca", "vq", "cpca"}) {
        const std::string asset = method + "-form.prt.glb";
        run({"compress", "float.prt.glb", "-o", asset, "--method", method});
        expectSamePicture(asset, {"--transport", "interreflected"});
    }
}

TEST_F(CliGpuRender, EveryTransportGivesThePictureOfRays) {
    for (const std::string transport : {"unshadowed", "shadowed", "interreflected"})
        expectSamePicture("float.prt.glb", {"--transport", transport});
    for (const std::string transport : {"glossy-unshadowed", "glossy"})
        expectSamePicture("glossy.prt.glb", {"--transport", transport});
}

TEST_F(CliGpuRender, EveryFormOfMatricesGivesThePictureOfRays) {
    for (const std::string method : {"u8", "cpca"}) {
        const std::string asset = method + "-glossy.prt.glb";
        run({"compress", "glossy.prt.glb", "-o", asset, "--method", method});
        expectSamePicture(asset, {});
    }
}

TEST_F(CliGpuRender, BackgroundMirrorsAndTurnedLightAreThoseOfRays) {
    for (const std::string asset : {"float.prt.glb", "mirror.prt.glb"})
        expectSamePicture(asset, {"--background", "--rotate", "10,60,-30"});
}

TEST_F(CliGpuRender, WithoutOpenGlASentenceSaysSo) {
    // Mesa is told to be too old, and glvnd to find no driver.
    ::setenv("MESA_GL_VERSION_OVERRIDE", "3.3", 1);
    ::setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/dev/null", 1);
    const CommandResult result = render("float.prt.glb", {"--gpu"}, "none.exr");
    ::unsetenv("MESA_GL_VERSION_OVERRIDE");
    ::unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES");
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1) << result.errors;
    EXPECT_NE(result.errors.find("there is no OpenGL 4.3"), std::string::npos) << result.errors;
    EXPECT_FALSE(std::filesystem::exists(file("none.exr")));
}

}  // namespace
}  // namespace prt::test
