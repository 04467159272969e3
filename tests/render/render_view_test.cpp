#include "prt/render/render_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <optional>
#include <vector>

#include "prt/base/error.h"
#include "prt/base/random.h"
#include "prt/scene/framing.h"
#include "prt/scene/procedural.h"
#include "tests/support/scenes.h"

namespace prt {
namespace {

using test::assembleScene;
using test::makePatch;
using test::makeQuad;
using test::Part;

constexpr float kRightAngle = std::numbers::pi_v<float> / 2.0f;
const Vec3f kBlack(0.0f);
const Vec3f kWhite(1.0f);

// Looks along −z from the origin with half a picture height to the unit of distance, so a square at
// z = −1 with corners (±1, ±1) fills a square picture.
Camera makeSquareCamera() {
    Camera camera;
    camera.verticalFovRadians = kRightAngle;
    return camera;
}

RenderOptions makeOptions(int width, int height, int samplesPerAxis = 2) {
    RenderOptions options;
    options.width = width;
    options.height = height;
    options.samplesPerAxis = samplesPerAxis;
    options.threadCount = 1;
    return options;
}

// Faces +z.
Mesh makeWall(float z, float left, float right, float bottom, float top) {
    return makeQuad({left, bottom, z}, {right, bottom, z}, {right, top, z}, {left, top, z});
}

// Faces −z.
Mesh makeWallSeenFromBehind(float z) {
    const float size = 2.0f * std::abs(z);
    return makeQuad({size, -size, z}, {-size, -size, z}, {-size, size, z}, {size, size, z});
}

Image renderUniform(const Scene& scene, const Vec3f& radiance, const Camera& camera,
                    const RenderOptions& options) {
    const std::vector<Vec3f> vertexRadiance(scene.vertexCount(), radiance);
    return renderView(scene, RayScene(scene), vertexRadiance, camera, options);
}

void expectUniform(const Image& image, const Vec3f& radiance) {
    for (const Vec3f& pixel : image.pixels)
        ASSERT_EQ(pixel, radiance);
}

// The left half of every wall becomes white, the right half black.
void attachHalfWhiteTexture(Scene& scene, std::optional<TextureUse> Material::*slot) {
    TextureImage texture;
    texture.pixels = Rgba8Image(2, 1);
    texture.pixels.at(1, 0) = {0, 0, 0, 255};
    scene.images.push_back(texture);
    TextureUse use;
    use.filter = TextureFilter::nearest;
    for (Material& material : scene.materials)
        material.*slot = use;
    for (Mesh& mesh : scene.meshes)
        mesh.uvSets[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
}

TEST(RenderView, PixelsAreBaseColourTimesRadianceExactly) {
    Scene scene = assembleScene({{makeWall(-1, -2, 2, -1, 1), Vec3f(0.5f, 0.25f, 1.0f)}});
    attachHalfWhiteTexture(scene, &Material::baseColorTexture);
    const Vec3f radiance(0.3f, 2.0f, -0.25f);  // negative light stays negative (C5)
    const Image image = renderUniform(scene, radiance, makeSquareCamera(), makeOptions(8, 4, 3));
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 8; ++x)
            EXPECT_EQ(image.at(x, y), x < 4 ? Vec3f(0.15f, 0.5f, -0.25f) : kBlack) << x << " " << y;
    }
}

TEST(RenderView, EmissionIsFactorTimesTextureAndIsAdded) {
    Scene scene = assembleScene({{makeWall(-1, -2, 2, -1, 1), Vec3f(0.5f)}});
    scene.materials[0].emissiveFactor = {4.0f, 2.0f, 0.0f};
    const RenderOptions options = makeOptions(8, 4, 1);
    expectUniform(renderUniform(scene, kWhite, makeSquareCamera(), options),
                  Vec3f(4.5f, 2.5f, 0.5f));
    attachHalfWhiteTexture(scene, &Material::emissiveTexture);
    const Image image = renderUniform(scene, kWhite, makeSquareCamera(), options);
    EXPECT_EQ(image.at(0, 0), Vec3f(4.5f, 2.5f, 0.5f));
    EXPECT_EQ(image.at(7, 3), Vec3f(0.5f));
}

// Where a point comes to lie, in pixels from the top left corner: similar triangles.
Vec2f projectPoint(const Camera& camera, const Vec3f& point, int width, int height) {
    const Vec3f fromEye = point - camera.eye;
    const Vec3f right = camera.forward.cross(camera.up);
    const float depth = fromEye.dot(camera.forward);
    const auto halfHeight = static_cast<float>(height) / 2.0f;
    const float focalPixels = halfHeight / std::tan(camera.verticalFovRadians / 2.0f);
    return {static_cast<float>(width) / 2.0f + focalPixels * fromEye.dot(right) / depth,
            halfHeight - focalPixels * fromEye.dot(camera.up) / depth};
}

// The centre of the light within some pixels of a place; not a number where there is none.
Vec2f centroidNear(const Image& image, const Vec2f& place, float radius) {
    Vec2f sum(0.0f);
    float weight = 0.0f;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const Vec2f centre(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            if ((centre - place).length() > radius) continue;
            sum += centre * image.at(x, y).x;
            weight += image.at(x, y).x;
        }
    }
    return {sum.x / weight, sum.y / weight};
}

// One small bright patch at each corner of a box.
void expectCornersInPlace(const Camera& camera) {
    constexpr float kTolerancePixels = 0.1f;
    constexpr float kPatchSize = 0.1f;  // two to four pixels wide
    constexpr float kSearchRadiusPixels = 7.0f;
    std::vector<Vec3f> corners;
    std::vector<Part> patches;
    for (int i = 0; i < 8; ++i) {
        corners.emplace_back(i & 1 ? 1.0f : -1.0f, i & 2 ? 0.75f : -0.75f, i & 4 ? 1.0f : -1.0f);
        const Vec3f towardsEye = (camera.eye - corners.back()).normalized();
        patches.push_back({makePatch(corners.back(), towardsEye, kPatchSize), kWhite});
    }
    const Image image =
        renderUniform(assembleScene(patches), kWhite, camera, makeOptions(160, 120, 8));
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec2f expected = projectPoint(camera, corners[i], 160, 120);
        const Vec2f seen = centroidNear(image, expected, kSearchRadiusPixels);
        EXPECT_NEAR(seen.x, expected.x, kTolerancePixels) << "corner " << i;
        EXPECT_NEAR(seen.y, expected.y, kTolerancePixels) << "corner " << i;
    }
}

TEST(RenderView, CornersOfABoxLieWhereAPinholeProjectsThem) {
    Camera ahead = makeSquareCamera();
    ahead.eye = {0.0f, 0.0f, 3.0f};
    expectCornersInPlace(ahead);
    expectCornersInPlace(lookAt({2.0f, 1.5f, 3.5f}, {0.1f, 0.0f, 0.0f}, 0.9f));
}

TEST(RenderView, RightIsRightAndUpIsUp) {
    const Scene scene = assembleScene({{makeWall(-1, 0, 1, 0, 1), kWhite}});
    const Image image = renderUniform(scene, kWhite, makeSquareCamera(), makeOptions(2, 2));
    EXPECT_EQ(image.at(1, 0), kWhite);
    EXPECT_EQ(image.at(0, 0), kBlack);
    EXPECT_EQ(image.at(1, 1), kBlack);
}

// A vertical edge is uncertain in one of the n columns of strata.
TEST(RenderView, AnEdgePixelShowsItsCoverageToOneOverTheRootOfTheSamples) {
    constexpr int kSize = 16;
    for (const int samplesPerAxis : {1, 2, 4, 8, 16}) {
        for (const float coverage : {0.1f, 0.37f, 0.5f, 0.81f}) {
            // The edge crosses the pixels of column 8 at this fraction of their width.
            const float edge = 2.0f * (8.0f + coverage) / kSize - 1.0f;
            const Scene scene = assembleScene({{makeWall(-1, -2, edge, -2, 2), kWhite}});
            const Image image = renderUniform(scene, kWhite, makeSquareCamera(),
                                              makeOptions(kSize, kSize, samplesPerAxis));
            const float bound = 1.0f / static_cast<float>(samplesPerAxis) + 1e-6f;
            for (int y = 0; y < kSize; ++y) {
                EXPECT_NEAR(image.at(8, y).x, coverage, bound);
                EXPECT_EQ(image.at(7, y), kWhite);
                EXPECT_EQ(image.at(9, y), kBlack);
            }
        }
    }
}

// The mean over the pixels of a column has no bias: its standard deviation is at most
// 1 / (2 n √n √height).
TEST(RenderView, SamplesAreJitteredWithoutBias) {
    constexpr int kSize = 64;
    constexpr double kSigmas = 4.0;
    constexpr float kCoverage = 0.3f;
    const float edge = 2.0f * (32.0f + kCoverage) / kSize - 1.0f;
    const Scene scene = assembleScene({{makeWall(-1, -2, edge, -2, 2), kWhite}});
    for (const int n : {1, 2, 4}) {
        const Image image =
            renderUniform(scene, kWhite, makeSquareCamera(), makeOptions(kSize, kSize, n));
        double mean = 0.0;
        for (int y = 0; y < kSize; ++y)
            mean += static_cast<double>(image.at(32, y).x) / kSize;
        EXPECT_NEAR(mean, kCoverage, kSigmas / (2.0 * n * std::sqrt(static_cast<double>(n)) * 8.0));
    }
}

// B = depth on a floor one unit below the eye; a row between the tangents a and b below the
// horizon shows ∫ 1/t dt / (b − a).
TEST(RenderView, RadianceIsInterpolatedInTheTriangleWithPerspective) {
    constexpr double kTolerance = 2e-3;  // four standard deviations of the steepest row
    constexpr int kSize = 32;
    const Mesh floor = makeQuad({-50, -1, 0}, {50, -1, 0}, {50, -1, -20}, {-50, -1, -20});
    const Scene scene = assembleScene({{floor, kWhite}});
    std::vector<Vec3f> depth;
    for (const Vec3f& position : floor.positions)
        depth.push_back(Vec3f(-position.z));
    const Image image = renderView(scene, RayScene(scene), depth, makeSquareCamera(),
                                   makeOptions(kSize, kSize, 16));
    for (int y = kSize / 2 + 2; y < kSize; ++y) {
        const double a = (y - kSize / 2) * 2.0 / kSize;
        const double b = a + 2.0 / kSize;
        const double expected = std::log(b / a) / (b - a);
        for (const int x : {0, 13, 31})
            EXPECT_NEAR(image.at(x, y).x, expected, kTolerance * expected) << x << " " << y;
    }
}

/// Any numbers for the vertices of two walls.
std::vector<ExitRadiance> drawExitRadiance(const Scene& scene) {
    RandomStream random(5, 0);
    const auto draw = [&] {
        return Vec3f(random.nextUnitFloat(), random.nextUnitFloat(), random.nextUnitFloat());
    };
    std::vector<ExitRadiance> exit(scene.vertexCount());
    for (ExitRadiance& radiance : exit) {
        radiance.perBaseColor = draw() - Vec3f(0.25f);
        radiance.constant = draw();
    }
    return exit;
}

TEST(RenderView, ExitRadianceIsBaseColourTimesOnePartAndTheOtherAndEmission) {
    constexpr float kRounding = 1e-6f;
    Scene scene = assembleScene({{makeWall(-1, -2, 0, -1, 1), Vec3f(0.5f, 0.25f, 1.0f)},
                                 {makeWall(-1, 0, 2, -1, 1), Vec3f(0.125f)}});
    scene.materials[1].emissiveFactor = {4.0f, 2.0f, 0.0f};
    attachHalfWhiteTexture(scene, &Material::baseColorTexture);
    Scene white = scene;
    for (Material& material : white.materials) {
        material = {};
        material.baseColorFactor = Vec4f(1.0f);
    }
    const std::vector<ExitRadiance> exit = drawExitRadiance(scene);
    std::vector<Vec3f> perBaseColor, constant;
    for (const ExitRadiance& radiance : exit) {
        perBaseColor.push_back(radiance.perBaseColor);
        constant.push_back(radiance.constant);
    }
    const Camera camera = makeSquareCamera();
    const RenderOptions options = makeOptions(32, 16);
    const RayScene rays(scene), whiteRays(white);
    const Image shown = renderView(scene, rays, exit, camera, options);
    const Image diffuse = renderView(scene, rays, perBaseColor, camera, options);
    const Image added = renderView(white, whiteRays, constant, camera, options);
    for (std::size_t i = 0; i < shown.pixels.size(); ++i)
        ASSERT_TRUE(shown.pixels[i].equalWithAbsError(diffuse.pixels[i] + added.pixels[i],
                                                      8.0f * kRounding))
            << i;
}

TEST(RenderView, ExitRadianceOfADiffuseSurfaceShowsTheDiffusePictureExactly) {
    const Scene scene = assembleScene(
        {{makeWall(-1, -2, 0, -1, 1), Vec3f(0.3f)}, {makeWall(-1, 0, 2, -1, 1), kWhite}});
    std::vector<ExitRadiance> exit = drawExitRadiance(scene);
    std::vector<Vec3f> radiance;
    for (ExitRadiance& vertex : exit) {
        vertex.constant = kBlack;
        radiance.push_back(vertex.perBaseColor);
    }
    const RayScene rays(scene);
    EXPECT_EQ(renderView(scene, rays, exit, makeSquareCamera(), makeOptions(16, 8)).pixels,
              renderView(scene, rays, radiance, makeSquareCamera(), makeOptions(16, 8)).pixels);
}

TEST(RenderView, VerticesAreNumberedMeshAfterMesh) {
    const Scene scene =
        assembleScene({{makeWall(-1, -2, 0, -1, 1), kWhite}, {makeWall(-1, 0, 2, -1, 1), kWhite}});
    std::vector<Vec3f> vertexRadiance(8, Vec3f(3.0f));
    std::fill_n(vertexRadiance.begin() + 4, 4, Vec3f(5.0f));
    const Image image =
        renderView(scene, RayScene(scene), vertexRadiance, makeSquareCamera(), makeOptions(2, 1));
    EXPECT_EQ(image.at(0, 0), Vec3f(3.0f));
    EXPECT_EQ(image.at(1, 0), Vec3f(5.0f));
}

TEST(RenderView, OneSidedSurfacesAreInvisibleFromBehind) {
    const Part target{makeWall(-10, -20, 20, -20, 20), Vec3f(0.25f)};
    const RenderOptions options = makeOptions(4, 4);
    const Scene near = assembleScene({target, {makeWallSeenFromBehind(-1), kWhite}});
    expectUniform(renderUniform(near, kWhite, makeSquareCamera(), options), Vec3f(0.25f));

    // A millimetre before the target, and another back face right behind the first.
    const Scene tight = assembleScene({target,
                                       {makeWallSeenFromBehind(-9.998f), kWhite},
                                       {makeWallSeenFromBehind(-9.999f), kWhite}});
    expectUniform(renderUniform(tight, kWhite, makeSquareCamera(), options), Vec3f(0.25f));
}

TEST(RenderView, DoubleSidedSurfacesAreVisibleFromBehind) {
    const Scene scene = assembleScene({{makeWall(-10, -20, 20, -20, 20), Vec3f(0.25f)},
                                       {makeWallSeenFromBehind(-1), Vec3f(0.5f), true}});
    expectUniform(renderUniform(scene, kWhite, makeSquareCamera(), makeOptions(4, 4)), Vec3f(0.5f));
}

TEST(RenderView, LooksIntoAClosedRoomFromOutside) {
    const Vec3f half(1.0f);
    const Scene room = assembleScene({{makeBox(-half, half, true, 2), Vec3f(0.5f)}});
    Camera camera = makeSquareCamera();
    camera.eye = {0.0f, 0.0f, 2.5f};  // the room's front fills two thirds of the picture
    const Image image = renderUniform(room, kWhite, camera, makeOptions(12, 12, 4));
    for (int y = 0; y < 12; ++y) {
        for (int x = 0; x < 12; ++x) {
            const bool isRoom = x >= 2 && x < 10 && y >= 2 && y < 10;
            ASSERT_EQ(image.at(x, y), isRoom ? Vec3f(0.5f) : kBlack) << x << " " << y;
        }
    }
}

TEST(RenderView, RaysGiveUpBehindVeryManyBackFaces) {
    std::vector<Part> walls = {{makeWall(-200, -400, 400, -400, 400), kWhite}};
    for (int i = 1; i <= 100; ++i)
        walls.push_back({makeWallSeenFromBehind(static_cast<float>(-i)), kWhite});
    const Scene scene = assembleScene(walls);
    expectUniform(renderUniform(scene, kWhite, makeSquareCamera(), makeOptions(2, 2)), kBlack);
}

// Radiance 2 + ω, so that every direction looks different.
Environment makeDirectionEnvironment() {
    constexpr int kHeight = 128;
    Environment environment;
    environment.radiance = Image(2 * kHeight, kHeight);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < 2 * kHeight; ++x) {
            const SphereTexel texel = sphereTexel(SphereMap::latLong, 2 * kHeight, kHeight, x, y);
            environment.radiance.at(x, y) = Vec3f(2.0f) + Vec3f(texel.direction);
        }
    }
    return environment;
}

TEST(RenderView, TheBackgroundIsSeenWhereNoSurfaceIs) {
    constexpr float kTexel = 0.02f;  // interpolation in the environment, and the width of a pixel
    constexpr int kSize = 64;
    const Environment environment = makeDirectionEnvironment();
    const Scene scene = assembleScene({{makeWall(-1, 0, 2, -2, 2), Vec3f(0.125f)}});
    RenderOptions options = makeOptions(kSize, kSize);
    options.background = &environment;
    for (const Mat3d& worldFromBackground : {Mat3d(), rotationX(0.5) * rotationY(2.0)}) {
        options.worldFromBackground = worldFromBackground;
        const Image image = renderUniform(scene, kWhite, makeSquareCamera(), options);
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                if (x >= kSize / 2) {
                    ASSERT_EQ(image.at(x, y), Vec3f(0.125f));
                    continue;
                }
                const Vec3f centre(2.0f * (static_cast<float>(x) + 0.5f) / kSize - 1.0f,
                                   1.0f - 2.0f * (static_cast<float>(y) + 0.5f) / kSize, -1.0f);
                const Vec3f expected =
                    Vec3f(2.0f) + worldFromBackground.transposed() * centre.normalized();
                ASSERT_TRUE(image.at(x, y).equalWithAbsError(expected, kTexel)) << x << " " << y;
            }
        }
    }
}

// C10.
TEST(RenderView, AnyNumberOfThreadsGivesTheSameBits) {
    const Scene scene = assembleScene({{makeSphere({0.0f, 0.0f, -2.0f}, 1.0f, 16), Vec3f(0.7f)}});
    RenderOptions options = makeOptions(61, 47, 3);
    const Image one = renderUniform(scene, kWhite, makeSquareCamera(), options);
    options.threadCount = 3;
    const Image three = renderUniform(scene, kWhite, makeSquareCamera(), options);
    EXPECT_EQ(
        std::memcmp(one.pixels.data(), three.pixels.data(), one.pixels.size() * sizeof(Vec3f)), 0);
    options.seed = 2;
    const Image other = renderUniform(scene, kWhite, makeSquareCamera(), options);
    EXPECT_NE(one.pixels, other.pixels);
}

TEST(RenderView, ReportsEveryPixelAndCanBeCancelled) {
    const Scene scene = assembleScene({{makeWall(-1, -1, 1, -1, 1), kWhite}});
    RenderOptions options = makeOptions(40, 30, 1);
    Progress last;
    options.progress = [&](const Progress& progress) {
        last = progress;
        return true;
    };
    renderUniform(scene, kWhite, makeSquareCamera(), options);
    EXPECT_EQ(last.unit, "pixels");
    EXPECT_EQ(last.done, 1200u);
    EXPECT_EQ(last.total, 1200u);

    options.progress = [](const Progress& progress) { return progress.done == 0; };
    try {
        renderUniform(scene, kWhite, makeSquareCamera(), options);
        FAIL() << "not cancelled";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cancelled);
    }
}

TEST(RenderView, RefusesOptionsOutOfRange) {
    const Scene scene = assembleScene({{makeWall(-1, -1, 1, -1, 1), kWhite}});
    const auto expectRefused = [&](const Camera& camera, const RenderOptions& options) {
        try {
            renderUniform(scene, kWhite, camera, options);
            ADD_FAILURE() << "no error";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::invalidOption);
        }
    };
    for (const int bad : {0, -1, 1 << 30}) {
        expectRefused(makeSquareCamera(), makeOptions(bad, 4));
        expectRefused(makeSquareCamera(), makeOptions(4, bad));
        expectRefused(makeSquareCamera(), makeOptions(4, 4, bad));
    }
    for (const float fov : {0.0f, -1.0f, 4.0f, std::nanf("")}) {
        Camera camera;
        camera.verticalFovRadians = fov;
        expectRefused(camera, makeOptions(4, 4));
    }
}

TEST(RenderView, AnEmptySceneShowsTheBackground) {
    expectUniform(renderUniform(Scene(), kWhite, makeSquareCamera(), makeOptions(3, 2)), kBlack);
}

}  // namespace
}  // namespace prt
