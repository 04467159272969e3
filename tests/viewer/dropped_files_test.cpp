#include "apps/viewer/dropped_files.h"

#include <gtest/gtest.h>

#include "apps/viewer/view_file.h"
#include "prt/io/environment_io.h"
#include "tests/support/temporary_folder.h"

namespace prt::viewer {
namespace {

class DroppedFiles : public testing::Test {
  protected:
    DroppedFiles() {
        view_.objects = {{.asset = "first.prt.glb"}};
        view_.lights = {{.source = "uniform:1"}, {.source = "old.hdr"}};
    }

    std::string file(const std::string& name, const std::string& text) {
        const std::filesystem::path path = folder_.path() / name;
        test::writeText(path, text);
        return path.string();
    }
    std::vector<std::string> drop(const std::vector<std::string>& files, bool replacesLights) {
        return dropFiles(view_, files, {.replacesLights = replacesLights});
    }

    test::TemporaryFolder folder_;
    ViewState view_;
};

TEST_F(DroppedFiles, AnImageIsTheLightInPlaceOfAll) {
    EXPECT_EQ(drop({"a/museum.HDR"}, true), std::vector<std::string>{"museum.HDR is the light"});
    ASSERT_EQ(view_.lights.size(), 1u);
    EXPECT_EQ(view_.lights[0].source, "a/museum.HDR");
}

TEST_F(DroppedFiles, SeveralImagesAreAddedUp) {
    drop({"a.exr", "b.png", "c.jpg"}, true);
    EXPECT_EQ(view_.lights.size(), 3u);
    drop({"d.hdr"}, false);
    EXPECT_EQ(view_.lights.size(), 4u);
    EXPECT_EQ(view_.lights[3].source, "d.hdr");
}

TEST_F(DroppedFiles, AnAssetStandsBesideTheOthersAndAllAreFramed) {
    view_.camera = CameraPose{};
    drop({"second.prt.glb"}, true);
    ASSERT_EQ(view_.objects.size(), 2u);
    EXPECT_EQ(view_.objects[1].asset, "second.prt.glb");
    EXPECT_FALSE(view_.camera);
    EXPECT_EQ(view_.lights.size(), 2u);
}

TEST_F(DroppedFiles, JsonIsAViewOrTheCoefficientsOfALight) {
    const std::string light = file("light.json", lightingToJson(Lighting(2)));
    drop({light}, true);
    ASSERT_EQ(view_.lights.size(), 1u);
    EXPECT_EQ(view_.lights[0].source, light);

    ViewState saved;
    saved.splitPosition = 0.25;
    drop({file("view.json", formatView(saved))}, true);
    EXPECT_EQ(view_.splitPosition, 0.25);
    EXPECT_TRUE(view_.objects.empty());
}

TEST_F(DroppedFiles, OfAFolderTheFirstImageIsTheLightUnlessItHasTheFacesOfACube) {
    file("c.hdr", "");
    const std::string first = file("b.EXR", "");
    file("a.txt", "");
    const std::string folder = folder_.path().string();
    drop({folder}, true);
    ASSERT_EQ(view_.lights.size(), 1u);
    EXPECT_EQ(view_.lights[0].source, first);
    file("px.png", "");
    drop({folder}, true);
    EXPECT_EQ(view_.lights[0].source, folder);
}

TEST_F(DroppedFiles, OtherFilesAreToldAndChangeNothing) {
    const std::string before = formatView(view_);
    const std::vector<std::string> told =
        drop({"thesis.pdf", "no/such/view.json", file("broken.json", "{]"), file("none", ""),
              folder_.path().string()},
             true);
    ASSERT_EQ(told.size(), 5u);
    EXPECT_NE(told[4].find("has no image"), std::string::npos) << told[4];
    EXPECT_TRUE(told[0].starts_with("thesis.pdf is neither")) << told[0];
    EXPECT_NE(told[1].find("no/such/view.json"), std::string::npos) << told[1];
    EXPECT_NE(told[2].find("broken.json"), std::string::npos) << told[2];
    EXPECT_TRUE(told[3].starts_with("none is neither")) << told[3];
    EXPECT_EQ(formatView(view_), before);
}

}  // namespace
}  // namespace prt::viewer
