#include "prt/light/environment_projector.h"

#include <gtest/gtest.h>

#include "drawn_environment.h"
#include "prt/base/random.h"
#include "tests/support/instruction_sets.h"

namespace prt {
namespace {

using test::draw;
using test::kShapes;
using test::maxDifference;
using test::Shape;

/// Frames of noise: no two texels are alike, and all that a map does not show is NaN.
Environment drawFrame(const Shape& shape, int cellSize, std::uint64_t frame) {
    RandomStream random(3, frame);
    return draw(shape, cellSize, [&](const Vec3d&) {
        return Vec3f(random.nextUnitFloat(), 2.0f * random.nextUnitFloat(), 9.0f);
    });
}

TEST(EnvironmentProjector, GivesWhatProjectLightingGivesFrameAfterFrame) {
    // Of a thousand floats a sum, of coefficients up to 9 √4π = 32.
    constexpr double kRounding = 32.0 * 2e-6;
    onEveryInstructionSet([&] {
        for (const Shape& shape : kShapes)
            for (const int cellSize : {3, 30}) {
                if (shape.map == SphereMap::octahedral && cellSize % 2 != 0) continue;
                for (const int bandCount : {1, 5, 10}) {
                    const EnvironmentProjector projector(shape.map, shape.columnCount * cellSize,
                                                         shape.rowCount * cellSize, bandCount);
                    for (const std::uint64_t number : {0, 1}) {
                        const Environment frame = drawFrame(shape, cellSize, number);
                        EXPECT_LT(maxDifference(projector.project(frame.radiance),
                                                projectLighting(frame, bandCount)),
                                  kRounding)
                            << sphereMapName(shape.map) << " of " << cellSize << ", " << bandCount;
                    }
                }
            }
    });
}

}  // namespace
}  // namespace prt
