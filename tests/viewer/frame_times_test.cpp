#include "apps/viewer/frame_times.h"

#include <gtest/gtest.h>

namespace prt::viewer {
namespace {

TEST(FrameTimes, PercentilesAreTimesThatSoManyFramesDidNotExceed) {
    FrameTimes times;
    EXPECT_EQ(times.percentile(0.5), 0.0);
    for (int i = 100; i >= 1; --i)
        times.add(i);
    EXPECT_EQ(times.percentile(0.0), 1.0);
    EXPECT_EQ(times.percentile(0.5), 50.0);
    EXPECT_EQ(times.percentile(0.95), 95.0);
    EXPECT_EQ(times.percentile(1.0), 100.0);
}

TEST(FrameTimes, OldFramesAreForgotten) {
    FrameTimes times(3);
    for (const double time : {9.0, 1.0, 2.0, 3.0})
        times.add(time);
    EXPECT_EQ(times.milliseconds(), (std::vector<float>{1.0f, 2.0f, 3.0f}));
    EXPECT_EQ(times.percentile(1.0), 3.0);
    EXPECT_EQ(times.percentile(0.5), 2.0);  // one of three is not half of them
}

}  // namespace
}  // namespace prt::viewer
