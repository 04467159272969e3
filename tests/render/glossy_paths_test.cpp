#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "prt/math/frame.h"
#include "prt/math/quadrature.h"
#include "prt/render/path_tracer.h"
#include "prt/trace/ray_offset.h"
#include "tests/brdf/brdf_samples.h"
#include "tests/render/glossy_points.h"
#include "tests/support/scenes.h"

namespace prt {
namespace {

using test::assembleScene;
using test::glossyOptions;
using test::lookAtVertices;
using test::makeAllKinds;
using test::makeGgx;
using test::makePatch;
using test::makeQuad;
using test::makeWhiteSky;
using test::viewAt;

constexpr double kPi = std::numbers::pi;
constexpr double kSigmas = 4.0;
constexpr double kFloatRounding = 1e-5;
constexpr Vec3f kUp(0.0f, 0.0f, 1.0f);

/// An open plane at the origin that faces up.
Scene makeOpenPlane() {
    return assembleScene({{makePatch(Vec3f(0.0f), kUp, 1.0f)}});
}

/// Of a point that faces up.
ExitPoint exitPointAt(const RayScene& rays, const Vec3f& point, const Brdf& brdf,
                      const Vec3d& view) {
    return {{offsetRayOrigin(rays.tracePoint(point), kUp), kUp},
            makeReflection(brdf, kUp, Vec3f(view))};
}

struct Measured {
    Vec3d mean;
    Vec3d standardError;
};

Measured measure(const Scene& scene, const RayScene& rays, const DistantLight& light,
                 const ExitPoint& point, int sampleCount, const PathTracerOptions& options) {
    const RadianceEstimate estimate =
        estimateExitRadiance(scene, rays, light, {&point, 1}, sampleCount, options);
    const Vec3d& variance = estimate.variance[0];
    return {estimate.mean[0],
            {std::sqrt(variance.x), std::sqrt(variance.y), std::sqrt(variance.z)}};
}

void expectNear(const Measured& measured, const Vec3d& expected, double modelError,
                const std::string& name) {
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(measured.mean[channel], expected[channel],
                    kSigmas * measured.standardError[channel] + modelError)
            << name;
}

/// f_r cos θ_i of world directions.
Vec3d reflect(const Brdf& brdf, const Vec3d& normal, const Vec3d& incident, const Vec3d& view) {
    const Frame<double> frame = frameFromNormal(normal);
    const auto local = [&](const Vec3d& d) {
        return Vec3d(d.dot(frame.tangent), d.dot(frame.bitangent), d.dot(frame.normal));
    };
    return evaluateBrdf(brdf, local(incident), local(view)) * incident.dot(normal);
}

/// ∫ f_r cos θ_i dω over a cone about `axis`, Gauss-Legendre in the angle from it.
Vec3d integrateCone(const Brdf& brdf, const Vec3d& view, const Vec3d& axis, double halfAngle) {
    constexpr int kNodeCount = 64;
    const Frame<double> frame = frameFromNormal(axis);
    Vec3d sum(0.0);
    for (const QuadratureNode& polar : gaussLegendre(kNodeCount)) {
        const double theta = 0.5 * halfAngle * (1.0 + polar.position);
        for (int k = 0; k < 2 * kNodeCount; ++k) {
            const double phi = kPi * (k + 0.5) / kNodeCount;
            const Vec3d direction =
                frame.worldFromLocal({std::sin(theta) * std::cos(phi),
                                      std::sin(theta) * std::sin(phi), std::cos(theta)});
            sum += evaluateBrdf(brdf, direction, view) *
                   (std::max(direction.z, 0.0) * polar.weight * std::sin(theta));
        }
    }
    return sum * (0.5 * halfAngle * kPi / kNodeCount);
}

TEST(GlossyPaths, UnderAWhiteSkyAPlaneShowsItsDirectionalAlbedo) {
    constexpr double kQuadrature = 2e-3;  // of the measured table's cells
    const Scene scene = makeOpenPlane();
    const RayScene rays(scene);
    for (const auto& [name, brdf] : makeAllKinds())
        for (const double degrees : {0.0, 35.0, 60.0, 80.0}) {
            const Vec3d view = viewAt(degrees);
            expectNear(measure(scene, rays, *makeWhiteSky(),
                               exitPointAt(rays, Vec3f(0.0f), brdf, view), 4000, glossyOptions()),
                       integrateCone(brdf, view, Vec3d(kUp), 0.5 * kPi), kQuadrature,
                       name + " at " + std::to_string(degrees));
        }
}

TEST(GlossyPaths, UnderASunAPlaneShowsItsBrdf) {
    const Scene scene = makeOpenPlane();
    const RayScene rays(scene);
    const Vec3d toSun = Vec3d(-0.5, 0.3, 0.7).normalized();
    for (const auto& [name, brdf] : makeAllKinds())
        for (const double degrees : {0.0, 40.0, 75.0}) {
            const Vec3d view = viewAt(degrees);
            const ExitPoint point = exitPointAt(rays, Vec3f(0.0f), brdf, view);
            if (name != "measured") {  // rounding moves directions to other cells
                const Vec3d expected = evaluateBrdf(brdf, toSun, view) * toSun.z;
                expectNear(
                    measure(scene, rays, *makeSunLight(toSun, 0.0), point, 2, glossyOptions()),
                    expected, kFloatRounding * (1.0 + expected.length()), name);
            }
            // A disc of unit irradiance.
            constexpr double kHalfAngle = 0.2;
            const double radiance = 1.0 / (kPi * std::pow(std::sin(kHalfAngle), 2));
            expectNear(measure(scene, rays, *makeSunLight(toSun, kHalfAngle), point, 4000,
                               glossyOptions()),
                       integrateCone(brdf, view, toSun, kHalfAngle) * radiance, 2e-3,
                       name + ", disc");
        }
}

/// x, facing up, sees the underside of plate A, which sees plate B off to the side, which the sun
/// overhead shines on: one path of two bounces, whose integral over both plates is smooth.
class Plates : public testing::Test {
  protected:
    /// ∫ g(point) dA over a square of side 2 by Gauss-Legendre.
    template <class Function>
    static Vec3d integrateSquare(const Vec3d& center, const Function& function) {
        Vec3d sum(0.0);
        const std::vector<QuadratureNode> rule = gaussLegendre(12);
        for (const QuadratureNode& x : rule)
            for (const QuadratureNode& y : rule)
                sum +=
                    function(center + Vec3d(x.position, y.position, 0.0)) * (x.weight * y.weight);
        return sum;
    }

    /// Per area there, of light that comes from `there` over to `here` and leaves it by `towards`.
    Vec3d couple(const Brdf& brdf, const Vec3d& here, const Vec3d& normal, const Vec3d& towards,
                 const Vec3d& there, const Vec3d& thereNormal) const {
        const Vec3d direction = (there - here).normalized();
        return reflect(brdf, normal, direction, towards) *
               (-direction.dot(thereNormal) / (there - here).length2());
    }

    static Mesh makePlate(const Vec3d& center, bool facesUp) {
        const Vec3f c(center);
        const float side = facesUp ? 1.0f : -1.0f;
        return makeQuad(c + Vec3f(-1, -side, 0), c + Vec3f(1, -side, 0), c + Vec3f(1, side, 0),
                        c + Vec3f(-1, side, 0));
    }

    const Vec3d up{0.0, 0.0, 1.0}, x{0.0, 0.0, 0.0}, centerA{0.2, 0.1, 1.0},
        centerB{2.7, 0.3, -0.5};
    const Vec3d view = Vec3d(-0.5, 0.2, 0.7).normalized();
    const Brdf brdfX = makeGltfBrdf(Vec3f(0.8f, 0.5f, 0.3f), {.metallic = 0.6f, .roughness = 0.7f});
    const Brdf brdfA{.lobes = {LambertLobe{Vec3d(0.2, 0.3, 0.4)},
                               PhongLobe{.albedo = Vec3d(0.7, 0.6, 0.5), .exponent = 6.0}}};
    const Brdf brdfB = makeGgx(0.8);
};

TEST_F(Plates, OneBounceIsTheIntegralOverThePlate) {
    const Scene scene = assembleScene({{makePlate(centerA, false)}});
    const RayScene rays(scene);
    const std::vector<Brdf> brdfs = {brdfA};
    const Vec3d toSun = Vec3d(0.4, -0.3, -0.8).normalized();
    const Vec3d expected = integrateSquare(centerA, [&](const Vec3d& a) {
        return couple(brdfX, x, up, view, a, -up) *
               reflect(brdfA, -up, toSun, (x - a).normalized());
    });
    const ExitPoint point = exitPointAt(rays, Vec3f(x), brdfX, view);
    for (const double halfAngle : {0.0, 0.02}) {
        const Measured measured = measure(scene, rays, *makeSunLight(toSun, halfAngle), point,
                                          100'000, glossyOptions(brdfs));
        EXPECT_GT(expected.x, 20.0 * measured.standardError.x);
        expectNear(measured, expected, 1e-4 * expected.x, "one bounce");
    }
}

TEST_F(Plates, TwoBouncesAreTheIntegralOverBothPlates) {
    const Scene scene = assembleScene({{makePlate(centerA, false)}, {makePlate(centerB, true)}});
    const RayScene rays(scene);
    const std::vector<Brdf> brdfs = {brdfA, brdfB};
    const Vec3d expected = integrateSquare(centerA, [&](const Vec3d& a) {
        const Vec3d fromB = integrateSquare(centerB, [&](const Vec3d& b) {
            return couple(brdfA, a, -up, (x - a).normalized(), b, up) *
                   reflect(brdfB, up, up, (a - b).normalized());
        });
        return couple(brdfX, x, up, view, a, -up) * fromB;
    });
    const ExitPoint point = exitPointAt(rays, Vec3f(x), brdfX, view);
    PathTracerOptions options = glossyOptions(brdfs);
    options.walk.bounceCount = 2;
    const Measured measured = measure(scene, rays, *makeSunLight(up, 0.0), point, 200'000, options);
    EXPECT_GT(expected.x, 20.0 * measured.standardError.x);
    expectNear(measured, expected, 1e-4 * expected.x, "two bounces");
    options.walk.bounceCount = 1;
    EXPECT_EQ(measure(scene, rays, *makeSunLight(up, 0.0), point, 1000, options).mean, Vec3d(0.0));
}

// The furnace: a white metal gains nothing, and what is lost is light that met a second facet.
TEST(GlossyPaths, AWhiteMetalInAFurnaceNeverShinesBrighterThanIt) {
    const Scene room = assembleScene(
        {{makeQuad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0})},
         {makeBox({-0.5f, -0.5f, 0.2f}, {0.5f, 0.5f, 0.9f}, false, 1)},
         {makeQuad({-1, 1, 0}, {1, 1, 0}, {1, 1, 2}, {-1, 1, 2}), Vec3f(0.5f), true}});
    const RayScene rays(room);
    for (const double roughness : {0.0, 0.3, 0.6, 1.0}) {
        const std::vector<Brdf> brdfs(3, makeGgx(roughness));
        const RadianceEstimate estimate =
            estimateExitRadiance(room, rays, *makeWhiteSky(), lookAtVertices(room, rays, brdfs),
                                 2000, glossyOptions(brdfs));
        for (std::size_t i = 0; i < estimate.mean.size(); ++i) {
            const double error = kSigmas * std::sqrt(estimate.variance[i].x);
            EXPECT_LE(estimate.mean[i].x, 1.0 + error + kFloatRounding) << roughness;
            if (roughness == 0.0) {
                EXPECT_GE(estimate.mean[i].x, 0.99 - error);
            }
        }
    }
}

TEST(GlossyPaths, NoLightEntersAClosedBoxHoweverItsNormalsLean) {  // C11
    Scene box = assembleScene({{makeBox(Vec3f(-1.0f), Vec3f(1.0f), true, 2)}});
    RandomStream random(1, 0);
    for (Vec3f& normal : box.meshes[0].normals)
        normal = (normal * 0.6f + Vec3f(test::drawUpward(random))).normalized();
    const RayScene rays(box);
    const std::vector<Brdf> brdfs = {makeGgx(0.4)};
    const std::vector<ExitPoint> points = lookAtVertices(box, rays, brdfs);
    for (const auto& light : {makeWhiteSky(), makeSunLight(Vec3d(0.6, 0.0, 0.8), 0.0)})
        for (const Vec3d& radiance :
             estimateExitRadiance(box, rays, *light, points, 64, glossyOptions(brdfs)).mean)
            EXPECT_EQ(radiance, Vec3d(0.0));
}

/// A square in the plane z = 0 whose vertex normals lean by 60° towards +x.
class LeaningNormal : public testing::Test {
  protected:
    LeaningNormal() : scene(makeLeaningSquare()), rays(scene) {
        origin = placePathOrigin(scene, rays, {false, 0.0f, {0, 0, 0.4f, 0.3f}, false});
    }

    static Scene makeLeaningSquare() {
        Scene square = assembleScene({{makeQuad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0})}});
        square.meshes[0].normals.assign(4, Vec3f(std::sqrt(0.75f), 0.0f, 0.5f));
        return square;
    }

    Scene scene;
    RayScene rays;
    PathOrigin origin;
};

TEST_F(LeaningNormal, MirrorsNothingFromBelowTheSurface) {  // C11
    const std::vector<Brdf> brdfs = {makeGgx(0.3)};
    const ExitPoint point{origin, makeReflection(brdfs[0], origin.normal, kUp)};
    const Vec3d mirrored(std::sqrt(0.75), 0.0, -0.5);
    for (const double halfAngle : {0.0, 0.1})
        for (const bool lightSampling : {true, false}) {
            PathTracerOptions options = glossyOptions(brdfs);
            options.lightSampling = lightSampling;
            EXPECT_EQ(
                measure(scene, rays, *makeSunLight(mirrored, halfAngle), point, 1000, options).mean,
                Vec3d(0.0));
        }
}

// Of the sky about the normal the surface hides a part: (1 + cos 60°)/2 of its light arrives.
TEST_F(LeaningNormal, DiffuseLightIsTheSameFromWhereverTheSurfaceIsSeen) {
    const std::vector<Brdf> brdfs = {{.lobes = {LambertLobe{Vec3d(0.8)}}}};
    PathTracerOptions options = glossyOptions(brdfs);
    options.walk.bounceCount = 0;
    for (const Vec3f& view : {kUp, Vec3f(-0.95f, 0.0f, 0.31f).normalized()}) {
        const ExitPoint point{origin, makeReflection(brdfs[0], origin.normal, view)};
        expectNear(measure(scene, rays, *makeWhiteSky(), point, 20'000, options), Vec3d(0.6),
                   kFloatRounding, "leaning");
    }
}

TEST(GlossyPaths, OnlyDoubleSidedBacksReflect) {
    const auto seeWall = [](float x, bool doubleSided) {
        const Scene scene = assembleScene(
            {{makeQuad({0, -9, 0}, {0, 9, 0}, {0, 9, 9}, {0, -9, 9}), Vec3f(0.5f), doubleSided}});
        const RayScene rays(scene);
        const std::vector<Brdf> brdfs = {makeGgx(0.5)};
        const float side = x > 0.0f ? 1.0f : -1.0f;
        const Vec3d view = Vec3d(static_cast<double>(side), 0.0, 0.6).normalized();
        // The mirrored view meets the wall.
        return measure(scene, rays, *makeWhiteSky(),
                       exitPointAt(rays, {x, 0.0f, 0.0f}, makeGgx(0.3), view), 20'000,
                       glossyOptions(brdfs));
    };
    const Measured front = seeWall(1.0f, false), back = seeWall(-1.0f, false),
                   otherSide = seeWall(-1.0f, true);
    EXPECT_LT(back.mean.x, 0.5 * front.mean.x);
    EXPECT_NEAR(otherSide.mean.x, front.mean.x,
                kSigmas * std::hypot(front.standardError.x, otherSide.standardError.x));
}

/// A plate overhead whose corners are said to lie elsewhere, under an open sky: it sends down what
/// its BRDF makes of the sky there, with its own view in their frame.
TEST(GlossyPaths, PathsMayGoOnFromCornersOfTheTriangle) {
    const Scene scene = assembleScene({{makeQuad({-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1})}});
    const RayScene rays(scene);
    const Vec3f tilted = Vec3f(0.3f, 0.0f, -1.0f).normalized();
    const std::vector<PathOrigin> corners(4, {rays.tracePoint({9, 0, 0}), tilted});
    const std::vector<Brdf> brdfs = {makeGgx(0.5)};
    PathTracerOptions options = glossyOptions(brdfs);
    options.walk.vertexFronts = corners;
    options.walk.bounceCount = 1;
    const Vec3d view = viewAt(45.0);
    // A mirror: its rays meet the plate at (−0.5, 0, 1).
    const ExitPoint point = exitPointAt(rays, Vec3f(0.5f, 0.0f, 0.0f), makeGgx(0.0), view);
    const Vec3d back = Vec3d(view.x, 0.0, -view.z);
    const Frame<double> frame = frameFromNormal(Vec3d(tilted));
    const Vec3d local(back.dot(frame.tangent), back.dot(frame.bitangent), back.dot(frame.normal));
    expectNear(measure(scene, rays, *makeWhiteSky(), point, 20'000, options),
               integrateCone(brdfs[0], local, Vec3d(kUp), 0.5 * kPi), 1e-3, "corner");
}

TEST(GlossyPaths, MaterialsAreThoseOfTheSceneUnlessOthersAreGiven) {
    Scene scene = assembleScene({{makePatch(Vec3f(0.0f), kUp, 1.0f), Vec3f(0.8f, 0.5f, 0.2f)}});
    scene.materials[0].metallicFactor = 0.4f;
    scene.materials[0].roughnessFactor = 0.6f;
    const SurfacePoint point{0, 0, 0.3f, 0.3f};
    const Vec3d incident = Vec3d(-0.4, 0.1, 0.7).normalized(), view = viewAt(40.0);
    const auto found = [&](const PathTracerOptions& options) {
        return evaluateBrdf(findBrdf(scene, point, options.walk), incident, view);
    };
    const Vec3d own =
        evaluateBrdf(makeGltfBrdf(Vec3f(0.8f, 0.5f, 0.2f), {.metallic = 0.4f, .roughness = 0.6f}),
                     incident, view);
    EXPECT_EQ(found(glossyOptions()), own);
    EXPECT_EQ(found({}), Vec3d(Vec3f(0.8f, 0.5f, 0.2f)) / kPi);
    const std::vector<Brdf> brdfs = {makeGgx(0.5)};
    EXPECT_EQ(found(glossyOptions(brdfs)), evaluateBrdf(brdfs[0], incident, view));
    EXPECT_EQ(found(glossyOptions(std::vector<Brdf>(1))), own);
}

}  // namespace
}  // namespace prt
