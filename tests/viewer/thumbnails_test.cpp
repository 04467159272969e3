#include "apps/viewer/thumbnails.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace prt::viewer {
namespace {

using Stage = LoadingStatus::Stage;

/// The upper half is sky, the lower half is ground.
Image makeHalves(int width, const Vec3f& sky, const Vec3f& ground) {
    Image image(width, width / 2, ground);
    for (int y = 0; y < width / 4; ++y)
        for (int x = 0; x < width; ++x)
            image.at(x, y) = sky;
    return image;
}

TEST(Thumbnails, ShowsTheImagesOfAFolderByName) {
    const test::TemporaryFolder folder;
    writeExr(folder.path() / "b.exr", makeHalves(256, {0.0f, 0.0f, 50.0f}, Vec3f(0.0f)));
    writePng(folder.path() / "a.PNG", Rgba8Image(64, 32, {255, 128, 0, 255}));
    test::writeText(folder.path() / "c.txt", "no image, and not called one");
    std::filesystem::create_directory(folder.path() / "d.png");
    Thumbnails thumbnails;
    thumbnails.open(folder.path());
    thumbnails.finish();
    ASSERT_EQ(thumbnails.status().stage, Stage::ready);
    ASSERT_EQ(thumbnails.all().size(), 2u);
    EXPECT_EQ(thumbnails.all()[0].source, folder.path() / "a.PNG");
    const Rgba8Image& sky = *thumbnails.all()[1].picture;
    EXPECT_EQ(sky.width, 96);
    EXPECT_EQ(sky.height, 48);
    // However bright it is, the sky is neither black nor another colour.
    EXPECT_GT(sky.at(10, 10).blue, 128);
    EXPECT_EQ(sky.at(10, 10).red, 0);
    EXPECT_EQ(sky.at(10, 40).blue, 0);
    const Rgba8 orange = thumbnails.all()[0].picture->at(50, 20);
    EXPECT_GT(orange.red, orange.green);
    EXPECT_GT(orange.green, orange.blue);
}

TEST(Thumbnails, ABrightAndADimLightLookAlike) {
    const test::TemporaryFolder folder;
    for (const float brightness : {1e-3f, 1.0f, 1e3f})
        writeExr(folder.path() / (std::to_string(brightness) + ".exr"),
                 makeHalves(200, Vec3f(0.5f, 0.7f, 1.0f) * brightness, Vec3f(0.1f) * brightness));
    Thumbnails thumbnails;
    thumbnails.open(folder.path());
    thumbnails.finish();
    ASSERT_EQ(thumbnails.all().size(), 3u);
    for (const Thumbnail& thumbnail : thumbnails.all()) {
        EXPECT_NEAR(thumbnail.picture->at(5, 5).red, thumbnails.all()[0].picture->at(5, 5).red, 1);
        EXPECT_GT(thumbnail.picture->at(5, 5).red, 100);
        EXPECT_LT(thumbnail.picture->at(5, 40).red, 150);
    }
}

TEST(Thumbnails, AWrongFileHasASentenceAndNoPicture) {
    const test::TemporaryFolder folder;
    test::writeText(folder.path() / "a.hdr", "not what it is called");
    writePng(folder.path() / "b.png", Rgba8Image(40, 37));
    writePng(folder.path() / "c.png", Rgba8Image(16, 8));
    writePng(folder.path() / "d.png", Rgba8Image(128, 64));
    Thumbnails thumbnails({.limits = {.maxWidth = 100}});
    thumbnails.open(folder.path());
    thumbnails.finish();
    for (const std::size_t wrong : {0, 1, 3}) {
        const Thumbnail& thumbnail = thumbnails.all()[wrong];
        EXPECT_EQ(thumbnail.status.stage, Stage::failed) << wrong;
        EXPECT_NE(thumbnail.status.message.find(thumbnail.source), std::string::npos);
        EXPECT_FALSE(thumbnail.picture);
    }
    EXPECT_TRUE(thumbnails.all()[2].picture);
}

TEST(Thumbnails, KeepsWhatStaysAndForgetsWhatGoes) {
    const test::TemporaryFolder folder;
    writePng(folder.path() / "a.png", Rgba8Image(16, 8));
    writePng(folder.path() / "b.png", Rgba8Image(16, 8));
    Thumbnails thumbnails;
    thumbnails.open(folder.path());
    thumbnails.finish();
    const std::weak_ptr<const Rgba8Image> a = thumbnails.all()[0].picture;
    const std::weak_ptr<const Rgba8Image> b = thumbnails.all()[1].picture;
    std::filesystem::remove(folder.path() / "a.png");
    writePng(folder.path() / "c.png", Rgba8Image(16, 8));
    thumbnails.open(folder.path());
    EXPECT_TRUE(a.expired());
    ASSERT_EQ(thumbnails.all().size(), 2u);
    EXPECT_EQ(thumbnails.all()[0].picture, b.lock());
    thumbnails.finish();
    EXPECT_TRUE(thumbnails.all()[1].picture);
    thumbnails.open({});
    EXPECT_TRUE(thumbnails.all().empty());
    EXPECT_TRUE(b.expired());
}

TEST(Thumbnails, AFolderThatIsNoneIsTold) {
    const test::TemporaryFolder folder;
    Thumbnails thumbnails;
    thumbnails.open(folder.path() / "missing");
    EXPECT_EQ(thumbnails.status().stage, Stage::failed);
    EXPECT_NE(thumbnails.status().message.find("missing"), std::string::npos);
    EXPECT_TRUE(thumbnails.all().empty());
    thumbnails.open(folder.path());
    EXPECT_EQ(thumbnails.status().stage, Stage::ready);
    EXPECT_EQ(thumbnails.status().message, "");
}

TEST(Thumbnails, OfAFullFolderShowsTheFirst) {
    const test::TemporaryFolder folder;
    for (const char* name : {"c.png", "a.png", "b.png"})
        writePng(folder.path() / name, Rgba8Image(16, 8));
    Thumbnails thumbnails({.mostCount = 2});
    thumbnails.open(folder.path());
    thumbnails.finish();
    ASSERT_EQ(thumbnails.all().size(), 2u);
    EXPECT_EQ(thumbnails.all()[1].source, folder.path() / "b.png");
    EXPECT_NE(thumbnails.status().message.find("3 images"), std::string::npos);
}

}  // namespace
}  // namespace prt::viewer
