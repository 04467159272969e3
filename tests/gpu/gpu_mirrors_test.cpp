#include "prt/gpu/gpu_mirrors.h"

#include <algorithm>
#include <array>
#include <vector>

#include <gtest/gtest.h>

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

/// As without mirrors: rounding of vertices to a 256th of a pixel remains.
constexpr double kLeastPsnr = 50.0;

/// Every texel another, so that no two directions show the same; lobes for some roughnesses only.
MirrorEnvironment makeRandomMirrors(const Mat3d& worldFromEnvironment) {
    static const MirrorEnvironment kStill = [] {
        RandomStream random(9, 3);
        Environment environment{SphereMap::latLong, Image(64, 32)};
        for (Vec3f& texel : environment.radiance.pixels)
            texel = Vec3f(random.nextUnitFloat(), random.nextUnitFloat(), random.nextUnitFloat()) *
                    10.0f;
        return makeMirrorEnvironment(environment, {},
                                     {.mostRoughness = 0.6, .faceSize = 32, .sampleCount = 64});
    }();
    MirrorEnvironment turned = kStill;
    turned.worldFromEnvironment = worldFromEnvironment;
    return turned;
}

/// Nothing but mirrors that are seen more and less clearly, and here and there not at all.
std::vector<ExitRadiance> makeRandomVisibilities(std::size_t vertexCount) {
    RandomStream random(5, 6);
    std::vector<ExitRadiance> radiance(vertexCount);
    for (ExitRadiance& vertex : radiance)
        vertex.mirrorVisibility = std::max(1.4f * random.nextUnitFloat() - 0.4f, 0.0f);
    return radiance;
}

/// A ball as seen from a room, where a mirror shows all directions, views at the rim among them;
/// its normals lean.
Scene makeLeaningRoom() {
    Scene scene = test::makeDecoratedRoom();
    RandomStream random(6, 6);
    for (Mesh& mesh : scene.meshes) {
        for (Vec3f& normal : mesh.normals) {
            const Vec3f lean(random.nextUnitFloat() - 0.5f, random.nextUnitFloat() - 0.5f,
                             random.nextUnitFloat() - 0.5f);
            normal = (normal + lean * 0.8f).normalized();
        }
    }
    for (Material& material : scene.materials)
        material.emissiveFactor = Vec3f(0.0f);
    return scene;
}

class GpuMirrorsTest : public test::GlTest {
  protected:
    void expectSamePicture(const Affine3d& worldFromObject, const Mat3d& worldFromEnvironment) {
        const MirrorEnvironment environment = makeRandomMirrors(worldFromEnvironment);
        const GpuMirrors mirrors(environment);
        const Image picture = draw(worldFromObject, &mirrors);
        const Scene placed = test::transformScene(scene_, worldFromObject.linear, 1.0,
                                                  Vec3f(worldFromObject.translation));
        const test::Agreement agreement =
            test::compareWithRays(picture, test::RayPicture(placed, exit_, kCamera, &environment));
        EXPECT_GE(agreement.psnr, kLeastPsnr);
        EXPECT_GE(agreement.insideShare, 0.6);
        EXPECT_GE(agreement.meanSquare, 0.002);
    }

    Image draw(const Affine3d& worldFromObject, const GpuMirrors* mirrors) {
        GpuVertexRadiance radiance(exit_.size());
        radiance.upload(exit_);
        return draw(radiance, worldFromObject, mirrors);
    }

    Image draw(const GpuRadiance& radiance, const Affine3d& worldFromObject,
               const GpuMirrors* mirrors) {
        const GpuScene scene(scene_);
        const GpuTarget target(kWidth, kHeight);
        drawGpuView(std::array{GpuObject{&scene, &radiance, worldFromObject}}, kCamera, target,
                    {.mirrors = mirrors});
        return target.readRadiance();
    }

    Scene scene_ = makeLeaningRoom();
    std::vector<ExitRadiance> exit_ = makeRandomVisibilities(scene_.vertexCount());
};

TEST_F(GpuMirrorsTest, MirroredLightIsThatOfRaysInEveryDirection) {
    for (const Mat3d& towards : {Mat3d(), rotationX(1.5), rotationY(2.0) * rotationX(0.7)})
        expectSamePicture({}, towards);
}

TEST_F(GpuMirrorsTest, TurnedObjectMirrorsWhatStandsStill) {
    expectSamePicture({rotationZ(0.4) * rotationX(-0.2), {0.1, 0.2, 0.0}}, rotationZ(0.7));
}

TEST_F(GpuMirrorsTest, TurnedLightIsMirroredTurned) {
    const Mat3d rotation = rotationY(0.8) * rotationX(0.3);
    GpuMirrors mirrors(makeRandomMirrors({}));
    mirrors.turn(rotation);
    const GpuMirrors turned(makeRandomMirrors(rotation));
    EXPECT_EQ(draw({}, &mirrors).pixels, draw({}, &turned).pixels);
}

TEST_F(GpuMirrorsTest, WithoutAnEnvironmentNothingIsMirrored) {
    const GpuMirrors mirrors(makeRandomMirrors({}));
    GpuVertexRadiance radiance(exit_.size());
    radiance.upload(exit_);
    const Image black(kWidth, kHeight);
    EXPECT_EQ(draw(radiance, {}, nullptr).pixels, black.pixels);
    EXPECT_NE(draw(radiance, {}, &mirrors).pixels, black.pixels);
    EXPECT_EQ(draw(radiance, {}, nullptr).pixels, black.pixels);  // as before
}

TEST_F(GpuMirrorsTest, MirrorsAddToTheOtherLight) {
    RandomStream random(1, 1);
    for (ExitRadiance& vertex : exit_) {
        vertex.perBaseColor = Vec3f(random.nextUnitFloat());
        vertex.constant = Vec3f(0.1f * random.nextUnitFloat());
    }
    expectSamePicture({}, rotationZ(2.0));
}

}  // namespace
}  // namespace prt
