#include "prt/gpu/gpu_lobe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "prt/base/random.h"
#include "prt/gpu/gpu_display.h"
#include "prt/gpu/gpu_vertex_radiance.h"
#include "prt/gpu/lobe_shape.h"
#include "prt/image/tone_curve.h"
#include "prt/scene/framing.h"
#include "prt/scene/procedural.h"
#include "prt/trace/ray_scene.h"
#include "tests/gpu/gl_test.h"
#include "tests/support/scenes.h"

namespace prt {
namespace {

constexpr int kWidth = 180;
constexpr int kHeight = 130;

Lighting makeRandomFunction(int bandCount, std::uint64_t seed) {
    RandomStream random(seed, 3);
    Lighting function(bandCount);
    for (Vec3d& coefficient : function.coefficients)
        for (int channel = 0; channel < 3; ++channel)
            coefficient[channel] = 2.0 * random.nextUnitDouble() - 1.0;
    return function;
}

double valueOf(const Lighting& function, const Vec3d& direction) {
    return luminance(reconstruct(function, direction));
}

TEST(LobeShape, RadiusIsTheMagnitudeOverTheLargest) {
    const Mesh sphere = makeSphere(Vec3f(0.0f), 1.0f, 90);
    for (const int bandCount : {1, 3, kMaxBandCount}) {
        const Lighting function = makeRandomFunction(bandCount, 5);
        const std::vector<LobeVertex> lobe = shapeLobe(sphere, function);
        ASSERT_EQ(lobe.size(), sphere.vertexCount());
        double largest = 0.0;
        for (const Vec3f& direction : sphere.positions)
            largest = std::max(largest, std::abs(valueOf(function, Vec3d(direction))));
        for (std::size_t i = 0; i < lobe.size(); ++i) {
            const Vec3f& direction = sphere.positions[i];
            const auto expected = static_cast<float>(valueOf(function, Vec3d(direction)) / largest);
            ASSERT_NEAR(lobe[i].value, expected, 1e-5f);
            ASSERT_NEAR((lobe[i].position - direction * std::abs(expected)).length(), 0.0f, 1e-5f);
        }
    }
}

TEST(LobeShape, NormalsAreThoseOfTheSurface) {
    const Mesh sphere = makeSphere(Vec3f(0.0f), 1.0f, 180);
    const Lighting function = makeRandomFunction(4, 9);
    const std::vector<LobeVertex> lobe = shapeLobe(sphere, function);
    const double scale = valueOf(function, Vec3d(sphere.positions[0])) / double(lobe[0].value);
    // Of |p| − |f(p)|, which vanishes on the surface, by differences.
    const auto height = [&](const Vec3d& p) {
        return p.length() - std::abs(valueOf(function, p.normalized()) / scale);
    };
    constexpr double kStep = 1e-4;
    constexpr double kLeastCosine = 0.996;  // of 5°, triangles being 2° wide
    int checkCount = 0;
    for (const LobeVertex& vertex : lobe) {
        if (std::abs(vertex.value) < 0.02f) continue;
        const Vec3d p(vertex.position);
        Vec3d gradient;
        for (int axis = 0; axis < 3; ++axis) {
            Vec3d step(0.0);
            step[axis] = kStep;
            gradient[axis] = height(p + step) - height(p - step);
        }
        EXPECT_GT(gradient.normalized().dot(Vec3d(vertex.normal)), kLeastCosine);
        ++checkCount;
    }
    EXPECT_GE(checkCount, 5000);
}

TEST(LobeShape, ColorIsThatOfTheFunctionAsBrightAsCanBeOrTheOneGiven) {
    const Mesh sphere = makeSphere(Vec3f(0.0f), 1.0f, 8);
    const Lighting function = scale(makeBasisLighting(1, 0), Vec3d(0.1, 0.4, 0.2));
    for (const LobeVertex& vertex : shapeLobe(sphere, function)) {
        EXPECT_NEAR(vertex.color.y, 1.0f, 1e-6f);
        EXPECT_LT(vertex.color.x, vertex.color.z);
        EXPECT_LT(vertex.color.z, vertex.color.y);
    }
    for (const LobeVertex& vertex : shapeLobe(sphere, function, Vec3f(0.1f, 0.2f, 0.3f)))
        EXPECT_EQ(vertex.color, Vec3f(0.1f, 0.2f, 0.3f));
}

TEST(LobeShape, OfNothingIsAPoint) {
    for (const LobeVertex& vertex : shapeLobe(makeSphere(Vec3f(0.0f), 1.0f, 8), Lighting(2))) {
        EXPECT_EQ(vertex.position, Vec3f(0.0f));
        EXPECT_EQ(vertex.value, 0.0f);
    }
}

/// What a pixel shows.
enum class Shown { picture, positive, negative };

bool isSame(const Rgba8& a, const Rgba8& b) {
    return a.red == b.red && a.green == b.green && a.blue == b.blue;
}

/// As the colours of lobes and the grey of pictures make it.
Shown tellShown(const Rgba8& shown, const Rgba8& before) {
    if (isSame(shown, before)) return Shown::picture;
    return shown.red > shown.blue ? Shown::positive : Shown::negative;
}

/// What all places about a pixel's middle show, if it is the same.
template <class Look>
std::optional<Shown> lookInside(int column, int row, const Look& look) {
    const std::optional<Shown> middle = look(column + 0.5, row + 0.5);
    for (const double dx : {-1.2, -0.6, 0.0, 0.6, 1.2})
        for (const double dy : {-1.2, -0.6, 0.0, 0.6, 1.2})
            if (look(column + 0.5 + dx, row + 0.5 + dy) != middle) return std::nullopt;
    return middle;
}

/// How many pixels show each, as they must.
template <class Look>
std::array<int, 3> countAsExpected(const Rgba8Image& picture, const Rgba8Image& before,
                                   const Look& look) {
    std::array<int, 3> counts{};
    int wrongCount = 0;
    for (int row = 0; row < picture.height; ++row) {
        for (int column = 0; column < picture.width; ++column) {
            const std::optional<Shown> expected = lookInside(column, row, look);
            if (!expected) continue;
            const Shown shown = tellShown(picture.at(column, row), before.at(column, row));
            if (shown != *expected) {
                if (++wrongCount < 5) ADD_FAILURE() << "at " << column << ", " << row;
            }
            ++counts[static_cast<std::size_t>(*expected)];
        }
    }
    EXPECT_EQ(wrongCount, 0);
    return counts;
}

class GpuLobeTest : public test::GlTest {
  protected:
    static constexpr LobeColors kColors{.positive = kWarmLobe};
};

class GlobeTest : public GpuLobeTest {
  protected:
    static constexpr PictureSquare kSquare{.left = 51, .top = 7, .side = 110};

    /// On a picture that is grey.
    static Rgba8Image drawGlobe(GpuLobe& lobe, const Camera& camera,
                                const Mat3d& worldFromLobe = {}) {
        GpuTarget radiance(kWidth, kHeight);
        radiance.writeRadiance(Image(kWidth, kHeight, Vec3f(0.2f)));
        const GpuTarget picture(kWidth, kHeight, 1, TargetFormat::codeValues);
        picture.beginDrawing();
        GpuDisplay().draw(radiance);
        picture.finishDrawing();
        lobe.drawInCorner(camera, worldFromLobe, kSquare);
        return picture.readCodeValues();
    }

    /// From the middle of the square, half its side being 1.
    static Vec3d placeInSquare(double x, double y) {
        const double half = 0.5 * kSquare.side;
        return {(x - kSquare.left - half) / half, (kSquare.top + half - y) / half, 0.0};
    }
};

TEST_F(GlobeTest, ConstantIsADiscAndNothingElse) {
    GpuLobe lobe;
    const Camera camera = lookAt({3.0f, 2.0f, 5.0f}, {0.0f, 1.0f, 0.0f}, 0.6f);
    const Rgba8Image before = drawGlobe(lobe, camera);
    lobe.setFunction(makeBasisLighting(1, 0), kColors);
    const auto counts = countAsExpected(drawGlobe(lobe, camera), before, [&](double x, double y) {
        return placeInSquare(x, y).length() < 0.92 ? Shown::positive : Shown::picture;
    });
    EXPECT_GE(counts[0], 10000);
    EXPECT_GE(counts[1], 7000);
}

TEST_F(GlobeTest, DiscBehindItDimsWhatIsInItAndNothingElse) {
    GpuLobe lobe;
    const Rgba8Image picture = drawGlobe(lobe, Camera());
    const Rgba8 grey = picture.at(0, 0);
    for (int row = 0; row < kHeight; ++row) {
        for (int column = 0; column < kWidth; ++column) {
            const double fromMiddle = placeInSquare(column + 0.5, row + 0.5).length();
            const Rgba8& shown = picture.at(column, row);
            if (fromMiddle < 0.98) {
                ASSERT_LT(shown.red, grey.red - 20) << column << ", " << row;
            } else if (fromMiddle > 1.0) {
                ASSERT_TRUE(isSame(shown, grey)) << column << ", " << row;
            }
        }
    }
}

/// r = |cos θ| are two balls, whose centres are at ±½ and which touch.
TEST_F(GlobeTest, SecondZonalIsTwoBallsThatTurnWithTheCameraAndTheLight) {
    const Mat3d worldFromLobe = rotationX(0.7) * rotationY(-0.4);
    const Vec3d axis = worldFromLobe * Vec3d(0.0, 0.0, 1.0);
    GpuLobe lobe;
    for (const Vec3f& eye : {Vec3f(3.0f, 1.0f, 2.0f), Vec3f(-1.0f, -2.0f, 0.5f)}) {
        const Camera camera = lookAt(eye, {0.2f, 0.1f, 0.0f}, 0.6f);
        lobe.setFunction(Lighting(1));
        const Rgba8Image before = drawGlobe(lobe, camera);
        lobe.setFunction(makeBasisLighting(2, shIndex(1, 0)), kColors);
        const Vec3d forward(camera.forward), up(camera.up), right = forward.cross(up);
        const auto look = [&](double x, double y) {
            const Vec3d place = placeInSquare(x, y) / 0.92;
            const Vec3d center = axis * 0.5;
            const auto heightOf = [&](double sign) {  // towards the eye
                const Vec3d across = place - Vec3d(center.dot(right), center.dot(up), 0.0) * sign;
                const double rest = 0.25 - across.length2();
                return rest < 0.0 ? -std::numeric_limits<double>::infinity()
                                  : std::sqrt(rest) - sign * center.dot(forward);
            };
            const double positive = heightOf(1.0), negative = heightOf(-1.0);
            if (std::isinf(positive) && std::isinf(negative)) return Shown::picture;
            return positive > negative ? Shown::positive : Shown::negative;
        };
        const auto counts = countAsExpected(drawGlobe(lobe, camera, worldFromLobe), before, look);
        EXPECT_GE(counts[1], 1000);
        EXPECT_GE(counts[2], 700);
    }
}

/// A grey room that stands somewhere, and the picture of it.
class LobeInSceneTest : public GpuLobeTest {
  protected:
    void SetUp() override {
        GpuLobeTest::SetUp();
        if (IsSkipped()) return;
        gpuScene_.emplace(scene_);
        radiance_.emplace(scene_.vertexCount());
        radiance_->upload(
            std::vector<ExitRadiance>(scene_.vertexCount(), {.constant = Vec3f(0.3f)}));
        object_ = {&*gpuScene_, &*radiance_, worldFromObject_};
    }

    /// The room, shown; and the lobe in it if there is one.
    Rgba8Image drawRoom(GpuLobe* lobe, const LobePlace& place, int sampleCount,
                        const PixelColumns& columns = {}) const {
        const GpuTarget target(kWidth, kHeight, sampleCount);
        const GpuTarget picture(kWidth, kHeight, 1, TargetFormat::codeValues);
        drawGpuView(std::span(&object_, 1), camera_, target);
        picture.beginDrawing();
        GpuDisplay().draw(target);
        picture.finishDrawing();
        if (lobe) lobe->drawInScene(target, std::span(&object_, 1), camera_, place, columns);
        return picture.readCodeValues();
    }

    /// What rays see of the two balls of y_10 and of the room; none where they touch.
    std::optional<Shown> look(double x, double y, const LobePlace& place) const {
        const double pixel =
            2.0 * std::tan(0.5 * static_cast<double>(camera_.verticalFovRadians)) / kHeight;
        const Vec3d eye(camera_.eye), forward(camera_.forward), up(camera_.up);
        const Vec3d direction = (forward + forward.cross(up) * ((x - 0.5 * kWidth) * pixel) +
                                 up * ((0.5 * kHeight - y) * pixel))
                                    .normalized();
        const Vec3d axis = place.worldFromLobe * Vec3d(0.0, 0.0, 1.0);
        const double radius = 0.5 * place.largestRadius;
        const auto meetBall = [&](double sign) {
            const Vec3d toCenter = place.center + axis * (sign * radius) - eye;
            const double middle = toCenter.dot(direction);
            const double rest = radius * radius - toCenter.length2() + middle * middle;
            return rest < 0.0 ? std::numeric_limits<double>::infinity() : middle - std::sqrt(rest);
        };
        const double positive = meetBall(1.0), negative = meetBall(-1.0);
        const double ball = std::min(positive, negative), room = meetRoom(eye, direction);
        if (std::abs(ball - room) < kTouching * place.largestRadius) return std::nullopt;
        if (!(ball < room)) return Shown::picture;
        return positive < negative ? Shown::positive : Shown::negative;
    }

    /// The walls are seen from inside only.
    double meetRoom(const Vec3d& eye, const Vec3d& direction) const {
        const Mat3d objectFromWorld = worldFromObject_.linear.transposed();
        const Ray ray{Vec3f(objectFromWorld * (eye - worldFromObject_.translation)),
                      Vec3f(objectFromWorld * direction)};
        const Hit hit = rays_.intersect(ray);
        return hit.escaped ? std::numeric_limits<double>::infinity() : static_cast<double>(hit.t);
    }

    /// As far from a surface a lobe may be seen and hidden at once.
    static constexpr double kTouching = 0.01;

    const Affine3d worldFromObject_{rotationX(-1.5) * rotationZ(0.2), {0.3, -0.8, -1.0}};
    Scene scene_ = test::makeRoomScene();
    RayScene rays_{scene_};
    Camera camera_ = lookAt({0.4f, 0.9f, 3.2f}, {0.3f, 0.1f, -1.0f}, 0.7f);
    std::optional<GpuScene> gpuScene_;
    std::optional<GpuVertexRadiance> radiance_;
    GpuObject object_;
};

TEST_F(LobeInSceneTest, SurfacesHideWhatIsBehindThem) {
    GpuLobe lobe;
    lobe.setFunction(makeBasisLighting(2, shIndex(1, 0)), kColors);
    std::array<int, 3> sums{};
    RandomStream random(6, 6);
    for (int i = 0; i < 6; ++i) {
        const auto draw = [&] { return 2.0 * random.nextUnitDouble() - 1.0; };
        const LobePlace place{
            .center = transformPoint(worldFromObject_, {0.9 * draw(), draw(), 0.8 + 0.8 * draw()}),
            .largestRadius = 0.6 + 0.3 * draw(),
            .worldFromLobe = rotationX(3.0 * draw()) * rotationY(3.0 * draw())};
        const int sampleCount = i % 2 == 0 ? 1 : 4;
        const Rgba8Image before = drawRoom(nullptr, place, sampleCount);
        const auto counts = countAsExpected(drawRoom(&lobe, place, sampleCount), before,
                                            [&](double x, double y) { return look(x, y, place); });
        for (std::size_t k = 0; k < 3; ++k)
            sums[k] += counts[k];
    }
    EXPECT_GE(sums[0], 80000);
    EXPECT_GE(sums[1], 1200);
    EXPECT_GE(sums[2], 1200);
}

TEST_F(LobeInSceneTest, OnlyTheColumnsThatAreAskedForAreDrawnTo) {
    GpuLobe lobe;
    lobe.setFunction(makeBasisLighting(2, shIndex(1, 0)), kColors);
    const LobePlace place{.center = {0.3, 0.4, 0.5}, .largestRadius = 0.8};
    const Rgba8Image before = drawRoom(nullptr, place, 1);
    const Rgba8Image whole = drawRoom(&lobe, place, 1);
    const Rgba8Image part = drawRoom(&lobe, place, 1, {100, 120});
    int differentCount = 0;
    for (int row = 0; row < kHeight; ++row) {
        for (int column = 0; column < kWidth; ++column) {
            const bool isDrawn = column >= 100 && column < 120;
            EXPECT_TRUE(isSame(part.at(column, row), (isDrawn ? whole : before).at(column, row)));
            differentCount += !isSame(whole.at(column, row), before.at(column, row));
        }
    }
    EXPECT_GE(differentCount, 1000);
}

TEST_F(LobeInSceneTest, BehindTheEyeNothingIsSeenAndAroundItNothingFails) {
    GpuLobe lobe;
    lobe.setFunction(makeBasisLighting(1, 0), kColors);
    const Vec3d eye(camera_.eye), forward(camera_.forward);
    const LobePlace behind{.center = eye - forward, .largestRadius = 0.8};
    const Rgba8Image before = drawRoom(nullptr, behind, 1);
    const Rgba8Image picture = drawRoom(&lobe, behind, 1);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
        ASSERT_TRUE(isSame(picture.pixels[i], before.pixels[i]));

    // From inside there is its inner side everywhere, but for what the room hides.
    const Rgba8Image inside =
        drawRoom(&lobe, {.center = eye + forward * 0.1, .largestRadius = 0.5}, 1);
    for (std::size_t i = 0; i < inside.pixels.size(); ++i)
        ASSERT_FALSE(isSame(inside.pixels[i], before.pixels[i]));
}

}  // namespace
}  // namespace prt
