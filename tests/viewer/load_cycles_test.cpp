#include <gtest/gtest.h>

#include "apps/viewer/light_rig.h"
#include "apps/viewer/object_shelf.h"
#include "prt/base/resident_memory.h"
#include "tests/support/temporary_folder.h"
#include "tests/viewer/small_asset.h"

namespace prt::viewer {
namespace {

/// An asset and three lights are read, the lights are added up, and all is forgotten again.
class LoadCycles : public testing::Test {
  public:
    LoadCycles() {
        test::writeSmallAsset(object_.asset);
        writeExr(folder_.path() / "light.exr", Image(64, 32, Vec3f(0.5f)));
        test::writeText(folder_.path() / "wrong.exr", "no image");
    }

    void run(int count) {
        for (int i = 0; i < count; ++i) {
            shelf_.finish({&object_, 1});
            rig_.finish(lights_);
            ASSERT_TRUE(shelf_.asset(0));
            ASSERT_GT(rig_.sum().coefficients[0].x, 0.0);
            ASSERT_GT(rig_.environment().radiance.at(0, 0).x, 0.0f);
            shelf_.update({});
            rig_.update({});
        }
    }

    double residentMegabytes() const {
        releaseFreeMemory();
        return static_cast<double>(residentBytes()) * 1e-6;
    }

  private:
    const test::TemporaryFolder folder_;
    const ObjectChoice object_{.asset = folder_.path() / "ball.prt.glb"};
    // No process of its own for each: that would be most of the test's time.
    const ImageLimits limits_{.inOwnProcess = false};
    const std::vector<LightChoice> lights_ = {
        {.source = folder_.path() / "light.exr", .stops = 1.0},
        {.source = folder_.path() / "wrong.exr"},
        {.source = folder_.path() / "light.exr", .azimuthDegrees = 30.0}};
    ObjectShelf shelf_{limits_};
    LightRig rig_{limits_};
};

TEST_F(LoadCycles, AThousandLeaveNothingBehind) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    run(100);  // the sanitizers keep what was freed, and look for leaks themselves
#else
    constexpr double kMostGrowth = 0.02;
    ASSERT_NO_FATAL_FAILURE(run(100));
    const double afterHundred = residentMegabytes();
    ASSERT_NO_FATAL_FAILURE(run(900));
    EXPECT_LT(residentMegabytes(), afterHundred * (1.0 + kMostGrowth));
#endif
}

}  // namespace
}  // namespace prt::viewer
