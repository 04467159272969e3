#include "prt/gpu/gpu_picture.h"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "prt/base/random.h"
#include "prt/gpu/gpu_vertex_radiance.h"
#include "prt/render/camera_rays.h"
#include "tests/gpu/decorated_room.h"
#include "tests/gpu/gl_test.h"
#include "tests/support/surface_pixels.h"

namespace prt {
namespace {

using test::kCamera;

const RenderOptions kView{.width = 160, .height = 120};

/// Over pixels that show one mesh only, where rays in other places of the same strata see nearly
/// the same, and rounding remains.
constexpr double kLeastPsnr = 50.0;

class GpuPicture : public test::GlTest {
  protected:
    GpuPicture() {
        // Smooth, since rays of a pixel look through random places of their strata.
        for (TextureImage& image : scene_.images)
            for (Rgba8& texel : image.pixels.pixels)
                texel = {static_cast<std::uint8_t>(128 + texel.red / 8),
                         static_cast<std::uint8_t>(128 + texel.green / 8),
                         static_cast<std::uint8_t>(128 + texel.blue / 8), texel.alpha};
        RandomStream random(8, 1);
        for (ExitRadiance& vertex : exit_)
            vertex = {.perBaseColor = Vec3f(random.nextUnitFloat()),
                      .constant = Vec3f(0.2f * random.nextUnitFloat()),
                      .mirrorVisibility = random.nextUnitFloat()};
        Environment& sky = environment_;
        for (int y = 0; y < sky.radiance.height; ++y)
            for (int x = 0; x < sky.radiance.width; ++x)
                sky.radiance.at(x, y) = Vec3f(0.5f + 0.4f * std::sin(0.2f * static_cast<float>(x)),
                                              0.02f * static_cast<float>(y), 0.4f);
    }

    Scene scene_ = test::makeDecoratedRoom();
    std::vector<ExitRadiance> exit_ = std::vector<ExitRadiance>(scene_.vertexCount());
    Environment environment_{SphereMap::latLong, Image(64, 32)};
    const Mat3d rotation_ = rotationY(1.0) * rotationX(0.4);
};

TEST_F(GpuPicture, IsThatOfRenderViewWithBackgroundAndMirrors) {
    const MirrorEnvironment mirrors =
        makeMirrorEnvironment(environment_, rotation_, {.faceSize = 16, .sampleCount = 64});
    const RayScene rays(scene_);
    RenderOptions options = kView;
    options.background = &environment_;
    options.worldFromBackground = rotation_;
    options.mirrors = &mirrors;
    const Image expected = renderView(scene_, rays, exit_, kCamera, options);

    const GpuScene gpuScene(scene_);
    GpuVertexRadiance radiance(exit_.size());
    radiance.upload(exit_);
    const GpuBackground background(environment_);
    const GpuMirrors gpuMirrors(mirrors);
    const Image drawn = drawGpuPicture(std::array{GpuObject{&gpuScene, &radiance}}, kCamera,
                                       {.width = kView.width,
                                        .height = kView.height,
                                        .background = &background,
                                        .worldFromBackground = rotation_,
                                        .mirrors = &gpuMirrors});

    const std::vector<bool> isWhole = test::findSurfacePixels(scene_, rays, kCamera, kView);
    const test::PixelAgreement inside = test::comparePixels(drawn, expected, isWhole, true);
    EXPECT_GE(inside.psnr, kLeastPsnr);
    EXPECT_GE(inside.share, 0.8);
    // Where surfaces meet, sixteen places here and sixteen there.
    constexpr double kLeastPsnrOfEdges = 30.0;
    EXPECT_GE(test::comparePixels(drawn, expected, isWhole, false).psnr, kLeastPsnrOfEdges);
}

TEST_F(GpuPicture, OnePlaceAPixelIsOneView) {
    const GpuScene gpuScene(scene_);
    GpuVertexRadiance radiance(exit_.size());
    radiance.upload(exit_);
    const std::array objects = {GpuObject{&gpuScene, &radiance}};
    const GpuTarget target(kView.width, kView.height);
    drawGpuView(objects, kCamera, target);
    EXPECT_EQ(drawGpuPicture(objects, kCamera,
                             {.width = kView.width, .height = kView.height, .samplesPerAxis = 1})
                  .pixels,
              target.readRadiance().pixels);
}

TEST_F(GpuPicture, ShiftedViewSeesTheNextPixels) {
    const GpuScene gpuScene(scene_);
    GpuVertexRadiance radiance(exit_.size());
    radiance.upload(exit_);
    const GpuBackground background(environment_);
    const std::array objects = {GpuObject{&gpuScene, &radiance, {rotationZ(0.1), {0, 0, 0}}}};
    const GpuTarget target(kView.width, kView.height);
    const auto draw = [&](const Vec2f& shiftPixels) {
        drawGpuView(objects, kCamera, target,
                    {.background = &background, .shiftPixels = shiftPixels});
        return target.readRadiance();
    };
    const Image middle = draw({0.0f, 0.0f});
    const Image shifted = draw({3.0f, 2.0f});
    int otherCount = 0;  // by rounding, at edges
    for (int y = 2; y < kView.height; ++y)
        for (int x = 0; x + 3 < kView.width; ++x)
            otherCount += (shifted.at(x, y) - middle.at(x + 3, y - 2)).length() > 1e-3f;
    EXPECT_LE(otherCount, 20);
}

TEST_F(GpuPicture, CanBeCancelled) {
    const GpuScene gpuScene(scene_);
    const GpuVertexRadiance radiance(exit_.size());
    try {
        drawGpuPicture(std::array{GpuObject{&gpuScene, &radiance}}, kCamera,
                       {.width = 8, .height = 8, .progress = [](const Progress& progress) {
                            return progress.done == 0;
                        }});
        FAIL() << "it went on";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cancelled);
    }
}

}  // namespace
}  // namespace prt
