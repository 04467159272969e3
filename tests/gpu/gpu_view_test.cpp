#include "prt/gpu/gpu_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "prt/base/random.h"
#include "prt/gpu/gpu_display.h"
#include "prt/gpu/gpu_relighter.h"
#include "prt/gpu/gpu_vertex_radiance.h"
#include "tests/gpu/decorated_room.h"
#include "tests/gpu/gl_test.h"
#include "tests/gpu/ray_picture.h"

namespace prt {
namespace {

using test::kBandCount;
using test::kCamera;
using test::makeDecoratedRoom;
using test::makeFloatTransfer;
using test::makeRandomLighting;
using test::makeRandomTransfer;
using test::relightVertices;

constexpr int kWidth = test::RayPicture::kWidth;
constexpr int kHeight = test::RayPicture::kHeight;

/// Of linear values, for a peak of 1. What remains is rounding, of vertices to a 256th of a pixel
/// first of all.
constexpr double kLeastPsnr = 50.0;

Image renderGpuView(const GpuScene& scene, const GpuRadiance& radiance, const Camera& camera,
                    int width, int height, int sampleCount = 1) {
    const GpuTarget target(width, height, sampleCount);
    drawGpuView(std::array{GpuObject{&scene, &radiance}}, camera, target);
    return target.readRadiance();
}

class GpuView : public test::GlTest {
  protected:
    void expectSamePicture(const CompressedTransfer& transfer, const Lighting& lighting,
                           const std::string& what, const Camera& camera = kCamera) {
        GpuRelighter relighter(transfer, transfer.layers.front().transport);
        relighter.relight(lighting);
        expectSamePicture(relighter, relightVertices(transfer, lighting), what, camera);
    }

    void expectSamePicture(const GpuRadiance& radiance, std::vector<ExitRadiance> expected,
                           const std::string& what, const Camera& camera = kCamera) {
        const Image picture = renderGpuView(GpuScene(scene_), radiance, camera, kWidth, kHeight);
        const test::Agreement agreement =
            test::compareWithRays(picture, test::RayPicture(scene_, std::move(expected), camera));
        EXPECT_GE(agreement.psnr, kLeastPsnr) << what;
        EXPECT_GE(agreement.insideShare, 0.6) << what;
        EXPECT_GE(agreement.meanSquare, 0.005) << what;  // there is something to see
    }

    Scene scene_ = makeDecoratedRoom();
};

constexpr std::array kEncodings = {TransferEncoding::float32, TransferEncoding::unorm16,
                                   TransferEncoding::unorm8};
constexpr std::array kTransports = {Transport::shadowed, Transport::interreflected};

TEST_F(GpuView, VectorsOfEveryEncodingGiveThePictureOfRays) {
    for (const Transport transport : kTransports) {
        for (const TransferEncoding encoding : kEncodings) {
            RandomStream random(3, 5);
            CompressedLayer layer = test::makeLayerKind(transport, kBandCount);
            layer.table = test::makeRandomTable(encoding, scene_.vertexCount() + 5,
                                                coefficientsPerReceiver(kBandCount, layer), random);
            expectSamePicture(
                makeRandomTransfer(scene_, layer), makeRandomLighting(kBandCount, 4),
                std::string(encodingName(encoding)) + " " + std::string(transportName(transport)));
        }
    }
}

TEST_F(GpuView, ClustersOfEveryEncodingGiveThePictureOfRays) {
    for (const Transport transport : kTransports) {
        for (const TransferEncoding encoding : kEncodings) {
            const CompressedLayer layer =
                test::makeClusteredLayer(transport, kBandCount, scene_.vertexCount() + 5,
                                         {.weights = encoding, .componentCounts = {2, 0, 9, 4}});
            expectSamePicture(makeRandomTransfer(scene_, layer), makeRandomLighting(kBandCount, 4),
                              "clusters, " + std::string(encodingName(encoding)) + " " +
                                  std::string(transportName(transport)));
        }
    }
}

TEST_F(GpuView, LightOfFewerBandsLeavesTheHigherOnesOut) {
    for (const Transport transport : kTransports) {
        RandomStream random(3, 6);
        CompressedLayer layer = test::makeLayerKind(transport, kBandCount);
        layer.table = test::makeRandomTable(TransferEncoding::unorm16, scene_.vertexCount(),
                                            coefficientsPerReceiver(kBandCount, layer), random);
        expectSamePicture(makeRandomTransfer(scene_, layer), makeRandomLighting(2, 8), "two bands");
    }
}

TEST_F(GpuView, RadianceMadeElsewhereIsShownWithAndWithoutBaseColor) {
    RandomStream random(5, 5);
    const auto draw = [&] {
        return Vec3f(random.nextUnitFloat(), random.nextUnitFloat(), random.nextUnitFloat());
    };
    std::vector<ExitRadiance> both(scene_.vertexCount());
    for (ExitRadiance& radiance : both)
        radiance = {.perBaseColor = draw(), .constant = draw() * 0.3f};
    GpuVertexRadiance radiance(scene_.vertexCount());
    radiance.upload(both);
    expectSamePicture(radiance, both, "both");

    std::vector<Vec3f> diffuse;
    for (ExitRadiance& vertex : both) {
        diffuse.push_back(vertex.perBaseColor);
        vertex.constant = Vec3f(0.0f);
    }
    radiance.upload(diffuse);
    expectSamePicture(radiance, both, "diffuse");
}

TEST_F(GpuView, MoreSamplesComeCloserToTheMeanOfManyRays) {
    const CompressedTransfer transfer = makeFloatTransfer(scene_);
    const Lighting lighting = makeRandomLighting(kBandCount, 4);
    GpuRelighter relighter(transfer, Transport::shadowed);
    relighter.relight(lighting);
    const GpuScene gpuScene(scene_);
    const test::RayPicture rays(scene_, relightVertices(transfer, lighting), kCamera);
    constexpr int kRaysPerAxis = 4;

    std::array<double, 2> squares{};
    const std::array pictures = {renderGpuView(gpuScene, relighter, kCamera, kWidth, kHeight),
                                 renderGpuView(gpuScene, relighter, kCamera, kWidth, kHeight, 4)};
    for (int row = 0; row < kHeight; ++row) {
        for (int column = 0; column < kWidth; ++column) {
            Vec3f mean(0.0f);
            for (int i = 0; i < kRaysPerAxis * kRaysPerAxis; ++i)
                mean += rays.look(column + (i % kRaysPerAxis + 0.5) / kRaysPerAxis,
                                  row + (i / kRaysPerAxis + 0.5) / kRaysPerAxis)
                            .radiance;
            mean /= static_cast<float>(kRaysPerAxis * kRaysPerAxis);
            for (std::size_t i = 0; i < pictures.size(); ++i)
                squares[i] += static_cast<double>((pictures[i].at(column, row) - mean).length2());
        }
    }
    EXPECT_LT(squares[1], 0.5 * squares[0]);
}

TEST_F(GpuView, SceneFarFromTheOriginIsDrawnAsSharply) {
    const Vec3f offset(4096.0f, -2048.0f, 1024.0f);
    scene_ = test::transformScene(scene_, Mat3d(), 1.0, offset);
    Camera camera = kCamera;
    camera.eye += offset;
    const CompressedTransfer transfer = makeFloatTransfer(scene_);
    expectSamePicture(transfer, makeRandomLighting(kBandCount, 4), "far away", camera);
}

TEST_F(GpuView, NothingIsDrawnOfAnEmptyScene) {
    const Scene empty;
    CompressedTransfer transfer;
    transfer.bandCount = 1;
    transfer.layers.push_back(test::makeLayerKind(Transport::shadowed, 1));
    transfer.layers.back().table.numbers = CoefficientTable(0, 1, sizeof(float));
    const Image picture =
        renderGpuView(GpuScene(empty), GpuRelighter(transfer, Transport::shadowed), kCamera, 3, 2);
    EXPECT_EQ(picture.pixels, std::vector<Vec3f>(6, Vec3f(0.0f)));
}

TEST_F(GpuView, ScreenShowsTheCodeValuesOfEncodeForDisplay) {
    const CompressedTransfer transfer = makeFloatTransfer(scene_);
    GpuRelighter relighter(transfer, Transport::shadowed);
    relighter.relight(makeRandomLighting(kBandCount, 4));
    const GpuTarget radiance(kWidth, kHeight);
    const GpuScene gpuScene(scene_);
    drawGpuView(std::array{GpuObject{&gpuScene, &relighter}}, kCamera, radiance);
    const GpuTarget screen(kWidth, kHeight, 1, TargetFormat::codeValues);

    constexpr int kRounding = 1;  // of a code value that is nearly between two
    std::array<bool, 256> isShown{};
    for (const ToneCurve curve : {ToneCurve::none, ToneCurve::aces, ToneCurve::neutral}) {
        for (const float exposureStops : {0.0f, -1.5f, 3.0f}) {
            const DisplayOptions options{exposureStops, curve};
            const Rgba8Image expected = encodeForDisplay(radiance.readRadiance(), options);
            screen.beginDrawing();
            GpuDisplay().draw(radiance, options);
            const Rgba8Image shown = screen.readCodeValues();
            for (std::size_t i = 0; i < shown.pixels.size(); ++i) {
                const Rgba8 &a = shown.pixels[i], &b = expected.pixels[i];
                ASSERT_LE(std::abs(a.red - b.red), kRounding) << i;
                ASSERT_LE(std::abs(a.green - b.green), kRounding) << i;
                ASSERT_LE(std::abs(a.blue - b.blue), kRounding) << i;
                ASSERT_EQ(a.alpha, b.alpha) << i;
                isShown[b.green] = true;
            }
        }
    }
    EXPECT_GE(std::ranges::count(isShown, true), 200);  // dark and bright have been compared
}

TEST_F(GpuView, BackgroundIsTheEnvironmentInTheDirectionOfEachPixel) {
    RandomStream random(9, 3);
    Environment environment{SphereMap::latLong, Image(32, 16)};
    for (Vec3f& texel : environment.radiance.pixels)
        texel = Vec3f(random.nextUnitFloat(), random.nextUnitFloat(), random.nextUnitFloat());
    const GpuBackground background(environment);
    const Mat3d rotation = rotationX(0.4) * rotationZ(2.0);
    const CompressedTransfer transfer = makeFloatTransfer(scene_);
    const GpuRelighter dark(transfer, Transport::shadowed);
    const GpuScene gpuScene(scene_);
    const GpuTarget target(kWidth, kHeight);
    const Lighting none(1);

    // Both poles and the seam are seen by one of these, past the room and above it.
    int seenCount = 0;
    double squares = 0.0;
    for (const Vec3d& towards :
         {Vec3d(0, 1, 0), Vec3d(0, -1, 0), Vec3d(-1, 0, 0), Vec3d(1, 0, 0)}) {
        Camera camera = kCamera;
        camera.forward = Vec3f(rotation * towards);
        camera.up = Vec3f(rotation * Vec3d(0, 0, 1));
        camera.verticalFovRadians = 1.6f;
        drawGpuView(std::array{GpuObject{&gpuScene, &dark}}, camera, target,
                    {&background, rotation});
        const Image picture = target.readRadiance();
        const test::RayPicture rays(scene_, relightVertices(transfer, none), camera);
        for (int row = 0; row < kHeight; ++row) {
            for (int column = 0; column < kWidth; ++column) {
                if (!rays.look(column + 0.5, row + 0.5).hit.escaped ||
                    !rays.lookInside(column, row))
                    continue;
                const Vec3f expected =
                    lookUpRadiance(environment, rotation.transposed() *
                                                    rays.directionThrough(column + 0.5, row + 0.5));
                squares += static_cast<double>((picture.at(column, row) - expected).length2());
                ++seenCount;
            }
        }
    }
    EXPECT_GE(seenCount, 2 * kWidth * kHeight);
    EXPECT_GE(10.0 * std::log10(3.0 * seenCount / squares), kLeastPsnr);
}

/// The code of the error that this throws.
template <class Action>
std::optional<ErrorCode> findErrorCode(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.code();
    }
    return std::nullopt;
}

TEST_F(GpuView, WhatCannotBeDrawnIsRefused) {
    const CompressedTransfer transfer = makeFloatTransfer(scene_);
    const GpuRelighter relighter(transfer, Transport::shadowed);
    const GpuScene gpuScene(scene_);
    const auto render = [&](int width, int height, int sampleCount, float fov) {
        Camera camera = kCamera;
        camera.verticalFovRadians = fov;
        return findErrorCode(
            [&] { renderGpuView(gpuScene, relighter, camera, width, height, sampleCount); });
    };
    EXPECT_EQ(render(8, 8, 1, 1.0f), std::nullopt);
    EXPECT_EQ(render(0, 8, 1, 1.0f), ErrorCode::invalidOption);
    EXPECT_EQ(render(8, 1 << 24, 1, 1.0f), ErrorCode::invalidOption);
    EXPECT_EQ(render(8, 8, 0, 1.0f), ErrorCode::invalidOption);
    EXPECT_EQ(render(8, 8, 4096, 1.0f), ErrorCode::invalidOption);
    EXPECT_EQ(render(8, 8, 1, 0.0f), ErrorCode::invalidOption);
    EXPECT_EQ(render(8, 8, 1, 3.2f), ErrorCode::invalidOption);
    EXPECT_EQ(findErrorCode([&] { GpuRelighter(transfer, Transport::unshadowed); }),
              ErrorCode::invalidOption);

    CompressedTransfer glossy = transfer;
    glossy.layers.push_back(test::makeLayerKind(Transport::glossy, kBandCount));
    EXPECT_EQ(findErrorCode([&] { GpuRelighter(glossy, Transport::glossy); }),
              ErrorCode::unsupported);
}

}  // namespace
}  // namespace prt
