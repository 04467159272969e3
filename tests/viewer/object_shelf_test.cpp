#include "apps/viewer/object_shelf.h"

#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tests/viewer/small_asset.h"

namespace prt::viewer {
namespace {

using Stage = LoadingStatus::Stage;

TEST(ObjectShelf, AFileThatIsNamedTwiceIsReadOnce) {
    const test::TemporaryFolder folder;
    test::writeSmallAsset(folder.path() / "ball.prt.glb");
    ObjectShelf shelf{ImageLimits{}};
    const std::string path = folder.path() / "ball.prt.glb";
    const std::vector<ObjectChoice> objects = {{.asset = path},
                                               {.asset = path, .rotationDegrees = {0, 90, 0}}};
    shelf.update(objects);
    ASSERT_EQ(shelf.statuses().size(), 2u);
    shelf.finish(objects);
    ASSERT_TRUE(shelf.asset(0));
    EXPECT_EQ(shelf.asset(0), shelf.asset(1));
    EXPECT_EQ(shelf.asset(0)->scene.vertexCount(), test::makeSmallAsset().scene.vertexCount());
    EXPECT_EQ(shelf.asset(0)->transfer.bandCount, 3);
}

TEST(ObjectShelf, ABrokenAssetIsToldAndDisturbsNoOther) {
    const test::TemporaryFolder folder;
    test::writeSmallAsset(folder.path() / "ball.prt.glb");
    test::writeText(folder.path() / "broken.prt.glb", "glTF, or so it says");
    ObjectShelf shelf{ImageLimits{}};
    const std::vector<ObjectChoice> objects = {{.asset = folder.path() / "broken.prt.glb"},
                                               {.asset = folder.path() / "ball.prt.glb"},
                                               {.asset = folder.path() / "missing.prt.glb"}};
    shelf.finish(objects);
    for (const std::size_t wrong : {0, 2}) {
        EXPECT_EQ(shelf.statuses()[wrong].stage, Stage::failed);
        EXPECT_NE(shelf.statuses()[wrong].message.find(objects[wrong].asset), std::string::npos);
        EXPECT_FALSE(shelf.asset(wrong));
    }
    EXPECT_EQ(shelf.statuses()[1].stage, Stage::ready);
    EXPECT_TRUE(shelf.asset(1));
}

TEST(ObjectShelf, WhatIsReadStaysAndWhatIsNotNamedGoes) {
    const test::TemporaryFolder folder;
    test::writeSmallAsset(folder.path() / "a.prt.glb");
    test::writeSmallAsset(folder.path() / "b.prt.glb");
    ObjectShelf shelf{ImageLimits{}};
    const ObjectChoice a{.asset = folder.path() / "a.prt.glb"};
    const ObjectChoice b{.asset = folder.path() / "b.prt.glb"};
    shelf.finish(std::vector{a});
    const std::weak_ptr<const Asset> first = shelf.asset(0);
    shelf.finish(std::vector{b, a});
    EXPECT_EQ(shelf.asset(1), first.lock());
    shelf.update(std::vector{b});
    EXPECT_TRUE(first.expired());
    EXPECT_EQ(shelf.statuses()[0].stage, Stage::ready);
}

}  // namespace
}  // namespace prt::viewer
