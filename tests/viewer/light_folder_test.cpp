#include "apps/viewer/light_folder.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace prt::viewer {
namespace {

TEST(LightFolder, IsThatOfTheFirstLightThatIsAFile) {
    const test::TemporaryFolder folder;
    const std::string file = (folder.path() / "a.hdr").string();
    test::writeText(file, "");
    ViewState view;
    view.lights = {{.source = "sun:10,20,5"}, {.source = "no/such.hdr"}};
    EXPECT_EQ(lightFolderOf(view), "");
    view.lights.push_back({.source = file});
    EXPECT_EQ(lightFolderOf(view), folder.path().string());
}

TEST(LightFolder, AnotherImageKeepsStopsAndAzimuth) {
    const test::TemporaryFolder folder;
    const std::string file = (folder.path() / "a.hdr").string();
    test::writeText(file, "");
    ViewState view;
    view.lights = {{.source = "sun:10,20,5"}, {.source = file, .stops = 2.0, .azimuthDegrees = 30}};
    chooseLight(view, "b.hdr");
    ASSERT_EQ(view.lights.size(), 2u);
    EXPECT_EQ(view.lights[1].source, "b.hdr");
    EXPECT_EQ(view.lights[1].stops, 2.0);
    EXPECT_EQ(view.lights[1].azimuthDegrees, 30.0);
    // There is no b.hdr, so that there is no image to replace.
    chooseLight(view, file);
    EXPECT_EQ(view.lights.size(), 3u);
}

}  // namespace
}  // namespace prt::viewer
