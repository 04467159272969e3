#include "prt/render/reflection.h"

#include <gtest/gtest.h>

#include <cmath>

#include "prt/base/random.h"
#include "prt/math/frame.h"
#include "prt/math/quadrature.h"
#include "tests/brdf/brdf_samples.h"

namespace prt {
namespace {

using test::drawUpward;
using test::makeAllKinds;
using test::makeGgx;

constexpr double kFloatRounding = 1e-5;

Vec3f drawDirection(RandomStream& random) {
    const Vec3d up = drawUpward(random);
    return Vec3f(random.nextUnitFloat() < 0.5f ? up : -up);
}

/// In world space, whatever frame the normal is given.
TEST(Reflection, AMirrorSendsTheViewToTheOtherSideOfTheNormal) {
    RandomStream random(1, 0);
    for (int i = 0; i < 200; ++i) {
        const Vec3f normal = drawDirection(random);
        Vec3f view = drawDirection(random);
        if (view.dot(normal) < 0.0f) view = -view;
        const Vec3f mirrored = normal * (2.0f * normal.dot(view)) - view;
        const Reflection reflection = makeReflection(makeGgx(0.0), normal, view);
        const ReflectedDirection drawn = drawReflected(reflection, normal, 0.3, 0.7);
        // The smoothest GGX there is strays by some of its α = 10⁻⁴; more where it grazes.
        if (normal.dot(view) < 0.1f) continue;
        EXPECT_NEAR((drawn.direction - mirrored).length(), 0.0f, 1e-3f);
        EXPECT_NEAR(drawn.weight.x, 1.0f, 1e-3f);
    }
}

TEST(Reflection, ItsScatteringIsTheBrdfTimesTheCosineOfWorldDirections) {
    RandomStream random(2, 0);
    for (const auto& [name, brdf] : makeAllKinds()) {
        if (name == "measured") continue;  // rounding moves directions to other cells
        for (int i = 0; i < 200; ++i) {
            const Vec3f normal = drawDirection(random);
            const Frame<double> frame = frameFromNormal(Vec3d(normal).normalized());
            // Isotropy: any turn of both about the normal gives the same.
            const Vec3d incident = drawUpward(random), view = drawUpward(random);
            const Reflection reflection =
                makeReflection(brdf, normal, Vec3f(frame.worldFromLocal(view)));
            const Scattering scattering =
                evaluateReflection(reflection, normal, Vec3f(frame.worldFromLocal(incident)));
            const Vec3d expected = evaluateBrdf(brdf, incident, view) * incident.z;
            const double density = brdfDensity(brdf, incident, view);
            EXPECT_NEAR((scattering.value - expected).length(), 0.0,
                        kFloatRounding * (1.0 + expected.length()))
                << name;
            EXPECT_NEAR(scattering.density, density, kFloatRounding * (1.0 + density)) << name;
            const Scattering below =
                evaluateReflection(reflection, normal, Vec3f(-frame.worldFromLocal(incident)));
            EXPECT_EQ(below.value, Vec3d(0.0));
            EXPECT_EQ(below.density, 0.0);
        }
    }
}

TEST(Reflection, DrawnDirectionsWeighTheirScatteringOverTheirDensity) {
    RandomStream random(3, 0);
    for (const auto& [name, brdf] : makeAllKinds()) {
        if (name == "measured") continue;  // as above
        for (int i = 0; i < 200; ++i) {
            const Vec3f normal = drawDirection(random);
            Vec3f view = drawDirection(random);
            if (view.dot(normal) < 0.05f) continue;
            const Reflection reflection = makeReflection(brdf, normal, view);
            const double u = random.nextUnitDouble();
            const ReflectedDirection drawn =
                drawReflected(reflection, normal, u, random.nextUnitDouble());
            if (drawn.direction.dot(normal) < 0.01f) continue;
            const Scattering scattering = evaluateReflection(reflection, normal, drawn.direction);
            EXPECT_NEAR(scattering.density / drawn.density, 1.0, 1e-4) << name;
            EXPECT_NEAR((scattering.value / scattering.density - Vec3d(drawn.weight)).length(), 0.0,
                        1e-4)
                << name;
        }
    }
}

TEST(Reflection, AViewBelowTheHorizonIsRaisedToIt) {
    const Vec3f normal(0.0f, 0.0f, 1.0f);
    for (const Vec3f& view :
         {Vec3f(0.6f, 0.0f, -0.8f), Vec3f(-0.1f, 0.2f, -0.9f).normalized(), -normal}) {
        const Reflection reflection = makeReflection(makeGgx(0.4), normal, view);
        EXPECT_GT(reflection.view.z, 0.0);
        EXPECT_LT(reflection.view.z, 1e-3);
        EXPECT_NEAR(reflection.view.length(), 1.0, 1e-12);
        // Towards the same side.
        EXPECT_GE(reflection.view.dot(Vec3d(view.x, view.y, 0.0)), 0.0);
    }
    // Others stay.
    const Vec3f view = Vec3f(0.5f, -0.3f, 0.2f).normalized();
    const Reflection reflection = makeReflection(makeGgx(0.4), normal, view);
    EXPECT_NEAR(reflection.view.z, static_cast<double>(view.z), 1e-7);
}

}  // namespace
}  // namespace prt
