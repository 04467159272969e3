#include "apps/viewer/stage.h"

#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include "apps/common/parse.h"
#include "apps/common/relit_asset.h"
#include "prt/gpu/gpu_vertex_radiance.h"
#include "prt/gpu/gpu_view.h"
#include "prt/io/environment_io.h"
#include "prt/light/deringing.h"
#include "prt/render/signed_radiance.h"
#include "prt/scene/framing.h"
#include "tests/support/surface_pixels.h"
#include "tests/viewer/stage_fixture.h"

namespace prt::viewer {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 64;

/// Sums in float, in another sequence.
constexpr double kLeastPsnr = 50.0;

class StageTest : public test::StageTest {
  protected:
    void SetUp() override {
        test::StageTest::SetUp();
        if (IsSkipped()) return;
        // Another radiance from everywhere, so that no turn looks like another.
        Image light(32, 16);
        for (int y = 0; y < light.height; ++y)
            for (int x = 0; x < light.width; ++x)
                light.at(x, y) = Vec3f(0.1f + 0.05f * static_cast<float>(x), 0.5f,
                                       0.1f * static_cast<float>(16 - y));
        writeExr(pathOf("light.exr"), light);
    }

    std::string writeRoom(TransferEncoding encoding = TransferEncoding::float32) const {
        return writeBaked("room.prt.glb", test::makeRoomScene(), kVectors, encoding);
    }

    /// A ball of metal. Few bands do not hold what is smooth, which mirrors then.
    std::string writeMetal(float roughness) const {
        Scene scene = test::assembleScene({{makeSphere({0.0f, 0.0f, 0.0f}, 1.0f, 16)}});
        scene.materials[0].metallicFactor = 1.0f;
        scene.materials[0].roughnessFactor = roughness;
        return writeBaked("metal.prt.glb", scene,
                          {.transport = Transport::glossyShadowed,
                           .bandCount = 3,
                           .incidentBandCount = 3,
                           .sampleCount = 16});
    }

    ViewState viewOf(const std::string& asset) const {
        ViewState view;
        view.objects = {{.asset = asset}};
        view.lights = {{.source = pathOf("light.exr")}};
        return view;
    }

    static StageOptions options(std::optional<bool> onCard = {}) {
        return {.limits = kLimits, .relightsOnCard = onCard, .awaitedPathsPerPixel = 2};
    }

    static Image draw(Stage& stage, const ViewState& view) {
        stage.finishLoading(view);
        return stage.draw(view, kWidth, kHeight, 1).readRadiance();
    }

    static Image drawAlone(const ViewState& view, std::optional<bool> onCard = {}) {
        Stage stage(options(onCard));
        return draw(stage, view);
    }

    const BakeOptions kVectors{.transport = Transport::interreflected,
                               .bandCount = 4,
                               .sampleCount = 64,
                               .bounceCount = 1};
};

double psnrOf(const Image& a, const Image& b) {
    return test::comparePixels(a, b, std::vector<bool>(a.pixels.size(), true), true).psnr;
}

/// What a light makes of an asset, drawn without a stage.
Image drawAsset(const Asset& asset, cli::ShownTransport shown, const Lighting& lighting,
                const Camera& camera, const Affine3d& worldFromObject, bool isCoefficient,
                const GpuBackground* background) {
    const Vec3f eye(worldFromObject.linear.transposed() *
                    (Vec3d(camera.eye) - worldFromObject.translation));
    const std::vector<ExitRadiance> exit =
        cli::AssetRelighter(asset, "asset").relight(shown, lighting, eye);
    const GpuScene scene(asset.scene);
    GpuVertexRadiance radiance(asset.scene.vertexCount());
    radiance.upload(isCoefficient ? showSignedRadiance(exit) : exit);
    const GpuTarget target(kWidth, kHeight);
    drawGpuView(std::array{GpuObject{&scene, &radiance, worldFromObject}}, camera, target,
                {.background = background});
    return target.readRadiance();
}

TEST_F(StageTest, DrawsWhatAssetRelighterAndDrawGpuViewGive) {
    ViewState view = viewOf(writeRoom());
    view.objects[0].rotationDegrees = {10.0, 40.0, 0.0};
    view.lightRotationDegrees = {20.0, -50.0, 5.0};
    view.left.bandCount = 3;
    Stage stage(options(true));
    const Image drawn = draw(stage, view);

    const Asset& asset = *stage.objects().asset(0);
    const Affine3d place = *stage.worldFromObject(view, 0);
    const Camera camera = makeCamera(stage.cameraPose(view, 1.5));
    const Mat3d worldFromLight = cli::rotationFromDegrees(view.lightRotationDegrees);
    const Lighting lighting =
        rotate(truncate(stage.lights().sum(), 3), place.linear.transposed() * worldFromLight);
    for (const bool hasBackground : {true, false}) {
        view.showBackground = hasBackground;
        const GpuBackground sky({SphereMap::latLong, hasBackground
                                                         ? stage.lights().environment().radiance
                                                         : Image(2, 1)});
        const Image again = draw(stage, view);
        const GpuTarget target(kWidth, kHeight);
        const Image behind = [&] {
            drawGpuView({}, camera, target,
                        {.background = &sky, .worldFromBackground = worldFromLight});
            return target.readRadiance();
        }();
        Image expected = drawAsset(asset, cli::ShownTransport::interreflected, lighting, camera,
                                   place, false, nullptr);
        int surfaceCount = 0;
        for (std::size_t i = 0; i < expected.pixels.size(); ++i) {
            if (expected.pixels[i] == Vec3f(0.0f))
                expected.pixels[i] = behind.pixels[i];
            else
                ++surfaceCount;
        }
        EXPECT_GE(psnrOf(again, expected), kLeastPsnr);
        EXPECT_GE(surfaceCount, 400);
        if (hasBackground) {
            EXPECT_EQ(again.pixels, drawn.pixels);
        }
    }
}

TEST_F(StageTest, RelightingOnTheCardAndOnTheCpuAgree) {
    for (const std::string& asset :
         {writeRoom(), writeRoom(TransferEncoding::unorm8), writeMetal(1.0f)}) {
        ViewState view = viewOf(asset);
        view.objects[0].rotationDegrees.y = 30.0;
        const Image onCard = drawAlone(view, true);
        EXPECT_GE(psnrOf(onCard, drawAlone(view, false)), kLeastPsnr);
        EXPECT_NE(onCard.pixels, Image(kWidth, kHeight).pixels);
    }
}

TEST_F(StageTest, ObjectsThatAreTurnedShareTheLight) {
    // A ball looks the same however it is turned, but for its light, which stays.
    ViewState view = viewOf(writeBaked(
        "ball.prt.glb", test::assembleScene({{makeSphere({0.0f, 0.0f, 0.0f}, 1.0f, 64)}}),
        {.transport = Transport::unshadowed, .bandCount = 3, .sampleCount = 64}));
    view.objects.push_back(view.objects[0]);
    const Image still = drawAlone(view);
    view.objects[0].rotationDegrees.y = 90.0;
    view.objects[1].rotationDegrees = {0.0, -90.0, 0.0};
    constexpr double kLeastPsnrOfFacets = 40.0;
    EXPECT_GE(psnrOf(drawAlone(view), still), kLeastPsnrOfFacets);
    view.lightRotationDegrees.y = 90.0;
    EXPECT_LE(psnrOf(drawAlone(view), still), 30.0);
}

TEST_F(StageTest, ObjectsThatAreHiddenAreNotDrawnAndFaultsAreTold) {
    ViewState view = viewOf(writeRoom());
    view.objects.push_back({.asset = pathOf("missing.prt.glb")});
    view.camera = CameraPose{.distance = 6.0};
    Stage stage(options());
    const Image shown = draw(stage, view);
    ASSERT_EQ(stage.describeFaults().size(), 1u);
    EXPECT_NE(stage.describeFaults()[0].find("missing.prt.glb"), std::string::npos);
    EXPECT_TRUE(stage.worldFromObject(view, 0));
    EXPECT_FALSE(stage.worldFromObject(view, 1));
    EXPECT_FALSE(stage.worldFromObject(view, 2));
    view.objects[0].isShown = false;
    const Image hidden = draw(stage, view);
    EXPECT_NE(hidden.pixels, shown.pixels);
    EXPECT_FALSE(stage.worldFromObject(view, 0));
    view.objects.clear();
    EXPECT_EQ(draw(stage, view).pixels, hidden.pixels);
    EXPECT_EQ(stage.vertexCount(), 0u);
}

TEST_F(StageTest, ACoefficientIsShownInFalseColours) {
    for (const std::string& path : {writeRoom(), writeMetal(1.0f)}) {
        ViewState view = viewOf(path);
        view.lightRotationDegrees.y = 70.0;  // changes nothing
        view.objects[0].rotationDegrees.y = 20.0;
        view.left.content = PaneContent::coefficient;
        Stage stage(options());
        for (const int coefficient : {0, 2, 7}) {
            view.left.coefficient = coefficient;
            const Image drawn = draw(stage, view);
            const Asset& asset = *stage.objects().asset(0);
            const int bandCount = asset.transfer.bandCount;
            const Image expected = drawAsset(asset, cli::fullestShown(asset.transfer),
                                             makeBasisLighting(bandCount, coefficient),
                                             makeCamera(stage.cameraPose(view, 1.5)),
                                             *stage.worldFromObject(view, 0), true, nullptr);
            EXPECT_GE(psnrOf(drawn, expected), kLeastPsnr) << coefficient;
        }
    }
}

TEST_F(StageTest, TheSameLightIsRelitAfterACoefficientWasShown) {
    // The light is a function of the basis, too, the same one.
    const std::string light = pathOf("basis.json");
    test::writeText(light, lightingToJson(makeBasisLighting(3, 2)));
    for (const std::string& path : {writeRoom(), writeMetal(1.0f)}) {
        ViewState view = viewOf(path);
        view.lights.push_back({.source = light, .isOn = false});
        Stage stage(options(true));
        const Image before = draw(stage, view);
        view.left = {.content = PaneContent::coefficient, .bandCount = 3, .coefficient = 2};
        draw(stage, view);
        view.left.content = PaneContent::relit;
        view.lights[0].isOn = false;
        view.lights[1].isOn = true;
        EXPECT_EQ(draw(stage, view).pixels, drawAlone(view, true).pixels);
        view.left = {};
        view.lights[0].isOn = true;
        view.lights[1].isOn = false;
        EXPECT_EQ(draw(stage, view).pixels, before.pixels);
    }
}

TEST_F(StageTest, WhatIsOutOfRangeIsHarmless) {
    constexpr int kHuge = std::numeric_limits<int>::max();
    ViewState view = viewOf(writeRoom());
    const Image plain = drawAlone(view);
    Stage stage(options());
    const GpuTarget shown(kWidth, kHeight, 1, TargetFormat::codeValues);
    const auto present = [&] {
        const Image drawn = draw(stage, view);
        shown.beginDrawing();
        stage.present(view);
        shown.finishDrawing();
        return drawn;
    };
    for (const PickedVertex& picked :
         {PickedVertex{0, std::size_t(kHuge)}, PickedVertex{7, 0}, PickedVertex{0, 3}}) {
        view.picked = picked;
        EXPECT_EQ(present().pixels, plain.pixels);
    }
    view.left.bandCount = kHuge;
    EXPECT_EQ(present().pixels, plain.pixels);
    view.left.bandCount = -kHuge;
    present();
    view.right = Pane{.content = PaneContent::coefficient};
    for (const int coefficient : {-1, 16, kHuge, -kHuge}) {
        view.right->coefficient = coefficient;
        present();
    }
    view.left = {};
    for (const double position : {1.0, 2.0, 1e300, std::numeric_limits<double>::infinity()}) {
        view.splitPosition = position;
        EXPECT_EQ(present().pixels, plain.pixels) << position;
    }
    for (const double position : {-1.0, -1e300, std::nan("")}) {
        view.splitPosition = position;
        present();
    }
}

TEST_F(StageTest, PanesStandOnTheirSidesOfTheLine) {
    ViewState view = viewOf(writeRoom());
    view.left.transport = cli::ShownTransport::unshadowed;
    const Image left = drawAlone(view);
    view.left = {.content = PaneContent::coefficient, .coefficient = 3};
    const Image right = drawAlone(view);
    view.right = view.left;
    view.left = {.transport = cli::ShownTransport::unshadowed};
    view.splitPosition = 0.25;
    const Image both = drawAlone(view);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            ASSERT_EQ(both.at(x, y), (x < kWidth / 4 ? left : right).at(x, y)) << x << ' ' << y;
    EXPECT_NE(left.pixels, right.pixels);
}

TEST_F(StageTest, LightIsOfTheBandsThatAreUsedWindowedAndTurned) {
    ViewState view = viewOf(writeRoom());
    view.lightRotationDegrees = {10.0, 20.0, 30.0};
    Stage stage(options());
    stage.finishLoading(view);
    const Mat3d rotation = cli::rotationFromDegrees(view.lightRotationDegrees);
    const Lighting used = truncate(stage.lights().sum(), 4);
    const auto expectLight = [&](const std::string& window, std::span<const double> factors) {
        view.window = window;
        const Lighting expected = rotate(applyWindow(used, factors), rotation);
        // Of 9 bands, the pane uses fewer than the receiver has, and the reverse.
        for (const auto& [paneBands, mostBands] : {std::pair(4, 9), std::pair(9, 4)}) {
            const Lighting found = stage.lightingOf(view, {.bandCount = paneBands}, mostBands);
            ASSERT_EQ(found.bandCount, 4);
            for (std::size_t i = 0; i < found.coefficients.size(); ++i)
                EXPECT_NEAR((found.coefficients[i] - expected.coefficients[i]).length(), 0.0, 1e-12)
                    << window << ' ' << i;
        }
    };
    expectLight("none", std::vector(4, 1.0));
    expectLight("hann", windowFactors(ShWindow::hann, 4));
    expectLight("lanczos", windowFactors(ShWindow::lanczos, 4));
    expectLight("auto", deringingFactors(used));
}

TEST_F(StageTest, AnAssetShownAloneIsSeenByItsOwnCamera) {
    Scene scene = test::makeRoomScene();
    scene.cameras = {lookAt({3.0f, 1.0f, 2.0f}, {0.0f, 0.0f, 0.5f}, 0.6f)};
    ViewState view = viewOf(writeBaked("seen.prt.glb", scene, kVectors));
    Stage stage(options());
    stage.finishLoading(view);
    constexpr float kRounding = 1e-5f;
    const Camera own = makeCamera(stage.cameraPose(view, 1.5));
    EXPECT_TRUE(own.eye.equalWithAbsError(scene.cameras[0].eye, kRounding));
    EXPECT_TRUE(own.forward.equalWithAbsError(scene.cameras[0].forward, kRounding));
    EXPECT_NEAR(own.verticalFovRadians, 0.6f, kRounding);

    view.objects.push_back(view.objects[0]);
    stage.finishLoading(view);
    const Camera framed = makeCamera(stage.cameraPose(view, 1.5));
    EXPECT_FALSE(framed.eye.equalWithAbsError(scene.cameras[0].eye, 0.1f));

    view.camera = CameraPose{.target = {1.0, 2.0, 3.0}, .distance = 4.0};
    EXPECT_EQ(stage.cameraPose(view, 1.5).target, Vec3d(1.0, 2.0, 3.0));
}

TEST_F(StageTest, TheReferenceUnderItsOwnBandsComesNearTheRelitPicture) {
    Scene scene = test::assembleScene({{makeSphere({0.0f, 0.0f, 0.0f}, 1.0f, 32)}});
    ViewState view =
        viewOf(writeBaked("ball.prt.glb", scene,
                          {.transport = Transport::shadowed, .bandCount = 3, .sampleCount = 1024}));
    view.left.bandCount = 3;
    view.showBackground = false;
    const Image relit = drawAlone(view);
    view.left.content = PaneContent::reference;
    StageOptions tracing = options();
    tracing.awaitedPathsPerPixel = 128;
    Stage stage(tracing);
    const Image traced = draw(stage, view);
    EXPECT_EQ(stage.reference().pathsPerPixel, 128);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));  // in which more could be traced
    EXPECT_EQ(draw(stage, view).pixels, traced.pixels);
    Vec3d sumOfRelit(0.0), sumOfTraced(0.0);
    for (std::size_t i = 0; i < relit.pixels.size(); ++i) {
        sumOfRelit += Vec3d(relit.pixels[i]);
        sumOfTraced += Vec3d(traced.pixels[i]);
    }
    constexpr double kNoise = 0.02;  // of the mean; and the ball is one of facets
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(sumOfTraced[channel] / sumOfRelit[channel], 1.0, kNoise);
    EXPECT_GE(psnrOf(traced, relit), 25.0);
}

/// Until nothing more is to come, as a window does.
void settle(Stage& stage, const ViewState& view) {
    for (int i = 0; i < 2000; ++i) {
        stage.update(view);
        stage.draw(view, kWidth, kHeight, 1);
        if (!stage.isBusy()) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    FAIL() << "it is busy for ever";
}

TEST_F(StageTest, RevisionChangesWhenTheSameViewIsShownOtherwiseAndNotElse) {
    ViewState view = viewOf(writeRoom());
    Stage stage({.limits = kLimits});
    stage.update(view);
    EXPECT_TRUE(stage.isBusy());
    const StageRevision unread = stage.revision();
    ASSERT_NO_FATAL_FAILURE(settle(stage, view));
    const StageRevision read = stage.revision();
    EXPECT_NE(read.lights, unread.lights);
    EXPECT_NE(read.objects, unread.objects);
    for (int i = 0; i < 3; ++i) {
        stage.update(view);
        stage.draw(view, kWidth, kHeight, 1);
        EXPECT_EQ(stage.revision(), read);
    }
    view.lights[0].stops = 1.0;
    stage.update(view);
    EXPECT_NE(stage.revision().lights, read.lights);
    EXPECT_EQ(stage.revision().objects, read.objects);
    view.objects.clear();
    stage.update(view);
    EXPECT_NE(stage.revision().objects, read.objects);
    EXPECT_FALSE(stage.isBusy());
}

TEST_F(StageTest, MirrorsAppearOnceTheirLightIsPrefiltered) {
    ViewState view = viewOf(writeMetal(0.1f));
    const Image awaited = drawAlone(view, true);
    Stage stage({.limits = kLimits, .relightsOnCard = false});
    const Image first = draw(stage, view);
    EXPECT_TRUE(stage.isBusy());
    const StageRevision before = stage.revision();
    ASSERT_NO_FATAL_FAILURE(settle(stage, view));
    EXPECT_NE(stage.revision().mirrors, before.mirrors);
    EXPECT_GE(psnrOf(draw(stage, view), awaited), kLeastPsnr);
    EXPECT_LE(psnrOf(first, awaited), 30.0);
}

}  // namespace
}  // namespace prt::viewer
