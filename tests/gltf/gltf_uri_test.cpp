// What a glTF file may name: data, and files in its own folder.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "prt/base/error.h"
#include "tests/gltf/safe_reading.h"

namespace prt::test {
namespace {

namespace fs = std::filesystem;

/// A triangle whose buffer is beside it, or wherever the URI says.
std::string makeFileWithUri(const std::string& uri) {
    GltfBuilder builder = makeTriangleFile();
    builder.json["buffers"] = {{{"byteLength", builder.bytes.size()}, {"uri", uri}}};
    return builder.gltf();
}

TEST(GltfUri, UrisMayNotLeaveTheFolder) {
    // The file that each would reach is there, so that only the check stands between.
    const ScratchFolder folder;
    const std::vector<std::byte> bytes = makeTriangleFile().bytes;
    const std::string outside = folder.write("outside.bin", bytes).string();
    folder.write("asset/inside.bin", bytes);
    folder.write("asset/deep/inside.bin", bytes);
    fs::create_symlink(outside, folder.path() / "asset/link.bin");
    fs::create_directory_symlink(folder.path(), folder.path() / "asset/up");
    fs::create_symlink("inside.bin", folder.path() / "asset/alias.bin");
    const auto isReadThrough = [&](const std::string& uri) {
        return isRead(folder.write("asset/scene.gltf", makeFileWithUri(uri)));
    };
    for (const char* uri : {"inside.bin", "./inside.bin", "deep/inside.bin", "deep/./inside.bin",
                            "%69nside.bin", "alias.bin"})
        EXPECT_TRUE(isReadThrough(uri)) << uri;

    const std::vector<std::string> refused = {"../outside.bin",
                                              "deep/../../outside.bin",
                                              "deep/../inside.bin",
                                              "./../outside.bin",
                                              "%2e%2e/outside.bin",
                                              "%2E%2e%2Foutside.bin",
                                              "..%2foutside.bin",
                                              ".%2e/outside.bin",
                                              "..\\outside.bin",
                                              "%2e%2e%5coutside.bin",
                                              "deep\\inside.bin",
                                              outside,
                                              "/" + outside,
                                              "file://" + outside,
                                              "FILE://" + outside,
                                              "file:" + outside,
                                              "file%3A//" + outside,
                                              "http://localhost/inside.bin",
                                              "https:inside.bin",
                                              "C:/outside.bin",
                                              "C:outside.bin",
                                              "%2F" + outside.substr(1),
                                              "link.bin",
                                              "up/outside.bin",
                                              "",
                                              "inside.bin%00",
                                              "inside.bin%",
                                              "inside.bin%2",
                                              "inside.bin%zz",
                                              std::string("inside.bin\0", 11),
                                              "inside.bin\n",
                                              ".",
                                              "deep",
                                              "$(cat inside.bin)",
                                              "`cat inside.bin`",
                                              "~/inside.bin",
                                              "*.bin",
                                              "/dev/stdin",
                                              "%252e%252e/outside.bin"};
    for (const std::string& uri : refused)
        EXPECT_FALSE(isReadThrough(uri)) << uri;
}

TEST(GltfUri, DataUrisMustBeWhole) {
    const std::string good =
        "data:application/octet-stream;base64," + encodeBase64(makeTriangleFile().bytes);
    const auto isReadThrough = [&](const std::string& uri) { return isRead(makeFileWithUri(uri)); };
    EXPECT_TRUE(isReadThrough(good));
    EXPECT_TRUE(isReadThrough("data:;base64," + encodeBase64(makeTriangleFile().bytes)));
    std::string percents = "data:,";
    for (const std::byte byte : makeTriangleFile().bytes)
        percents += byte == std::byte{0} ? "%00" : byte == std::byte{0x3f} ? "?" : "%80";
    EXPECT_TRUE(isReadThrough(percents));
    EXPECT_FALSE(isReadThrough(percents.substr(0, percents.size() - 1)));
    EXPECT_FALSE(isReadThrough("data:;" + good.substr(good.find(";base64"))));
    for (const std::string& uri : std::vector<std::string>{
             "data:", "data:,", "data:;base64,", "data:application/octet-stream,AAAA",
             good.substr(0, good.size() - 4), good.substr(0, good.size() - 7), good + "=",
             good + "\n", "data:;base64,====", "data:;base64,A===",
             "data:;base64," + std::string(48, '*'), "data:;base64,=" + std::string(47, 'A')})
        EXPECT_FALSE(isReadThrough(uri)) << uri;
}

TEST(GltfUri, AMissingBufferIsNotFound) {
    const ScratchFolder folder;
    try {
        readGltf(folder.write("scene.gltf", makeFileWithUri("absent.bin")));
        FAIL() << "a file that is not there was read";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::notFound);
        EXPECT_EQ(fs::path(error.where()).filename(), "absent.bin");
    }
}

TEST(GltfUri, ABufferNamedManyTimesCountsEachTime) {
    const ScratchFolder folder;
    GltfBuilder builder = makeTriangleFile();
    folder.write("big.bin", std::string(1 << 20, 'x'));
    builder.json["buffers"] = Json::array();
    for (int i = 0; i < 100; ++i)
        builder.json["buffers"].push_back({{"byteLength", 1 << 20}, {"uri", "big.bin"}});
    const fs::path path = folder.write("scene.gltf", builder.finished().dump());
    EXPECT_NO_THROW(readGltf(path));
    EXPECT_THROW(readGltf(path, {.maxFileBytes = 50 << 20}), Error);
}

}  // namespace
}  // namespace prt::test
