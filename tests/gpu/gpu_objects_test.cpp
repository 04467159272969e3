#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "prt/base/random.h"
#include "prt/gpu/gpu_vertex_radiance.h"
#include "prt/gpu/gpu_view.h"
#include "tests/gpu/decorated_room.h"
#include "tests/gpu/gl_test.h"
#include "tests/gpu/ray_picture.h"

namespace prt {
namespace {

using test::kCamera;
constexpr int kWidth = test::RayPicture::kWidth;
constexpr int kHeight = test::RayPicture::kHeight;

/// As for one object: rounding of vertices to a 256th of a pixel remains.
constexpr double kLeastPsnr = 50.0;

std::vector<ExitRadiance> makeRandomRadiance(const Scene& scene, std::uint64_t seed) {
    RandomStream random(seed, 4);
    std::vector<ExitRadiance> radiance(scene.vertexCount());
    for (ExitRadiance& vertex : radiance)
        vertex.perBaseColor =
            Vec3f(random.nextUnitFloat(), random.nextUnitFloat(), random.nextUnitFloat());
    return radiance;
}

/// A scene on the card, and on the CPU as it stands in the world.
struct Placed {
    Affine3d worldFromObject;
    Scene placed;
    std::vector<ExitRadiance> exit;
    GpuScene scene;
    GpuVertexRadiance radiance;

    Placed(const Scene& given, const Affine3d& where, std::uint64_t seed)
        : worldFromObject(where),
          placed(test::transformScene(given, where.linear, 1.0, Vec3f(where.translation))),
          exit(makeRandomRadiance(given, seed)),
          scene(given),
          radiance(given.vertexCount()) {
        radiance.upload(exit);
    }

    GpuObject object() const { return {&scene, &radiance, worldFromObject}; }
};

/// @param together  becomes one scene of all; textures are those of the last that has any
test::RayPicture traceAll(Scene& together, const std::vector<const Placed*>& all) {
    std::vector<ExitRadiance> exit;
    for (const Placed* one : all) {
        const std::size_t firstMaterial = together.materials.size();
        if (!one->placed.images.empty()) together.images = one->placed.images;
        for (Mesh mesh : one->placed.meshes) {
            mesh.material += firstMaterial;
            together.meshes.push_back(std::move(mesh));
        }
        for (const Material& material : one->placed.materials)
            together.materials.push_back(material);
        exit.insert(exit.end(), one->exit.begin(), one->exit.end());
    }
    return {together, std::move(exit), kCamera};
}

class GpuObjects : public test::GlTest {
  protected:
    const Scene room_ = test::makeDecoratedRoom();
    const Mat3d rotation_ = rotationZ(0.8) * rotationX(-0.2);
};

void expectAgreement(const Image& picture, const test::RayPicture& rays, double leastShare) {
    const test::Agreement agreement = test::compareWithRays(picture, rays);
    EXPECT_GE(agreement.psnr, kLeastPsnr);
    EXPECT_GE(agreement.insideShare, leastShare);
    EXPECT_GE(agreement.meanSquare, 0.005);
}

TEST_F(GpuObjects, TurnedAndMovedObjectIsTheOneWhoseVerticesAreTurnedAndMoved) {
    const Placed room(room_, {rotation_, {0.2, 0.3, -0.2}}, 1);
    const GpuTarget target(kWidth, kHeight);
    drawGpuView(std::array{room.object()}, kCamera, target);
    Scene together;
    expectAgreement(target.readRadiance(), traceAll(together, {&room}), 0.6);
}

TEST_F(GpuObjects, ObjectsNearAndFarHideOneAnotherAsOneScene) {
    const Placed nearRoom(room_, {rotation_, {-0.9, -0.2, 0.0}}, 1);
    const Placed farRoom(room_, {rotationZ(-0.5), {0.0, 11.0, 0.9}}, 2);
    const Scene ball = test::assembleScene({{makeSphere({0.0f, 0.0f, 0.0f}, 0.5f, 16)}});
    const Placed crossing(ball, {Mat3d(), {0.3, 0.0, 0.5}}, 3);
    const GpuTarget target(kWidth, kHeight);
    drawGpuView(std::array{crossing.object(), farRoom.object(), nearRoom.object()}, kCamera,
                target);
    Scene together;
    const test::RayPicture rays = traceAll(together, {&nearRoom, &farRoom, &crossing});
    expectAgreement(target.readRadiance(), rays, 0.5);

    std::array<int, 3> seenCounts{};  // of each object's pixels
    for (int i = 0; i < kWidth * kHeight; ++i) {
        const Hit hit = rays.look(i % kWidth + 0.5, i / kWidth + 0.5).hit;
        if (!hit.escaped) ++seenCounts[hit.point.mesh / room_.meshes.size()];
    }
    for (const int count : seenCounts)
        EXPECT_GE(count, 300);
}

Image drawColumns(const Placed& placed, const GpuTarget& target, const PixelColumns& columns,
                  const Camera& camera = kCamera) {
    drawGpuView(std::array{placed.object()}, camera, target, {.columns = columns});
    return target.readRadiance();
}

TEST_F(GpuObjects, ColumnsShowWhatTheWholePictureShowsThereAndLeaveTheOthers) {
    const Placed left(room_, {}, 1);
    const Placed right(room_, {rotation_, {}}, 2);
    for (const int sampleCount : {1, 4}) {
        const GpuTarget target(kWidth, kHeight, sampleCount);
        const Image ofLeft = drawColumns(left, target, {});
        const Image ofRight = drawColumns(right, target, {});
        for (const int split : {-5, 0, 61, kWidth, kWidth + 7}) {
            drawColumns(left, target, {.end = split});
            const Image both = drawColumns(right, target, {.first = split});
            for (int y = 0; y < kHeight; ++y) {
                for (int x = 0; x < kWidth; ++x)
                    ASSERT_EQ(both.at(x, y), (x < split ? ofLeft : ofRight).at(x, y))
                        << x << ' ' << y << ' ' << split;
            }
        }
    }
}

TEST_F(GpuObjects, PictureMadeElsewhereStandsInItsColumnsUntilTheyAreDrawn) {
    const Placed placed(room_, {}, 1);
    RandomStream random(2, 2);
    Image given(kWidth, kHeight);
    for (Vec3f& pixel : given.pixels)
        pixel = Vec3f(random.nextUnitFloat() - 0.5f, 40.0f, random.nextUnitFloat());
    for (const int sampleCount : {1, 4}) {
        GpuTarget target(kWidth, kHeight, sampleCount);
        const Image drawn = drawColumns(placed, target, {});
        target.writeRadiance(given, {.first = 50, .end = 90});
        const Image written = target.readRadiance();
        const Image redrawn = drawColumns(placed, target, {.end = 60});
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                ASSERT_EQ(written.at(x, y), (x >= 50 && x < 90 ? given : drawn).at(x, y));
                ASSERT_EQ(redrawn.at(x, y), (x >= 60 && x < 90 ? given : drawn).at(x, y));
            }
        }
    }
}

TEST_F(GpuObjects, SmallerPictureIsWrittenByItsNearestTexels) {
    GpuTarget target(7, 4);
    Image small(3, 2);
    for (std::size_t i = 0; i < small.pixels.size(); ++i)
        small.pixels[i] = Vec3f(static_cast<float>(i));
    target.writeRadiance(small);
    const Image shown = target.readRadiance();
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 7; ++x)
            EXPECT_EQ(shown.at(x, y).x, std::floor((x + 0.5) * 3 / 7) + 3 * (y / 2));
    }
}

/// Whether all places about the middle of a pixel show the triangle that the middle shows.
bool isAlone(const test::RayPicture& rays, int column, int row, double reachPixels) {
    const Hit middle = rays.look(column + 0.5, row + 0.5).hit;
    constexpr int kDirectionCount = 8;
    for (int i = 0; i < kDirectionCount; ++i) {
        const double angle = 2.0 * 3.14159265358979324 * i / kDirectionCount;
        const Hit beside = rays.look(column + 0.5 + reachPixels * std::cos(angle),
                                     row + 0.5 + reachPixels * std::sin(angle))
                               .hit;
        if (beside.escaped != middle.escaped || beside.point.mesh != middle.point.mesh ||
            beside.point.triangle != middle.point.triangle)
            return false;
    }
    return true;
}

TEST_F(GpuObjects, LinesLieOnTheVisibleEdgesOfTrianglesAndNowhereElse) {
    const Scene bare = test::makeFurnishedRoom();
    const Placed room(bare, {rotationZ(0.2), {0.0, 0.1, 0.1}}, 1);
    const GpuTarget target(kWidth, kHeight);
    const Image plain = drawColumns(room, target, {});
    drawGpuView(std::array{room.object()}, kCamera, target, {.wireFrame = true});
    const Image lined = target.readRadiance();
    const Image again = drawColumns(room, target, {});
    EXPECT_EQ(again.pixels, plain.pixels);  // lines leave nothing behind

    Scene together;
    const test::RayPicture rays = traceAll(together, {&room});
    constexpr float kLeastContrast = 0.1f;  // seen at a glance
    int aloneCount = 0, edgeCount = 0, lineCount = 0;
    for (int row = 0; row < kHeight; ++row) {
        for (int column = 0; column < kWidth; ++column) {
            const Vec3f change = lined.at(column, row) - plain.at(column, row);
            if (isAlone(rays, column, row, 1.5)) {
                ++aloneCount;
                ASSERT_EQ(change, Vec3f(0.0f)) << column << ' ' << row;
            } else if (!isAlone(rays, column, row, 0.25) &&
                       !rays.look(column + 0.5, row + 0.5).hit.escaped) {
                ++edgeCount;
                lineCount += change.length() > kLeastContrast;
            }
        }
    }
    EXPECT_GE(aloneCount, kWidth * kHeight / 2);
    EXPECT_GE(edgeCount, 200);
    EXPECT_GE(lineCount, 0.9 * edgeCount);  // the far side of an outline has none of its own
}

}  // namespace
}  // namespace prt
