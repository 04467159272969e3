#include "apps/viewer/window_picture.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace prt::viewer {
namespace {

TEST(Screenshot, TakesTheFirstNumberOfWhichThereIsNoFile) {
    const test::TemporaryFolder folder;
    EXPECT_EQ(nextScreenshot(folder.path()), folder.path() / "prt_001");
    test::writeText(folder.path() / "prt_001.png", "");
    EXPECT_EQ(nextScreenshot(folder.path()), folder.path() / "prt_002");
    test::writeText(folder.path() / "prt_002.exr", "");
    test::writeText(folder.path() / "prt_004.exr", "");
    EXPECT_EQ(nextScreenshot(folder.path()), folder.path() / "prt_003");
}

}  // namespace
}  // namespace prt::viewer
