#include "prt/transport/checkpoint.h"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>

#include "prt/base/error.h"
#include "tests/support/temporary_folder.h"

namespace prt {
namespace {

using test::readText;
using test::TemporaryFolder;
using test::writeText;
using Bytes = std::vector<std::byte>;

constexpr std::uint64_t kWork = 0x0123456789abcdef;

Bytes makeBytes(const std::string& text) {
    Bytes bytes(text.size());
    std::memcpy(bytes.data(), text.data(), text.size());
    return bytes;
}

std::string makeText(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void expectError(ErrorCode code, const std::string& word, const std::function<void()>& call) {
    try {
        call();
        ADD_FAILURE() << "no error: " << word;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), code) << error.message();
        EXPECT_NE(error.message().find(word), std::string::npos) << word << " in " << error.what();
    }
}

TEST(UnitFile, GivesItsPayloadBack) {
    const UnitKey key{"fronts", 3, 300, 400};
    for (const std::string text : {"", "seven", "some text that is longer than a word"}) {
        const Bytes file = encodeUnit(kWork, key, makeBytes(text));
        EXPECT_EQ(makeText(readUnit(file, kWork, key)), text);
    }
}

TEST(UnitFile, IsRefusedCutShortAndWithAnyByteChanged) {
    const UnitKey key{"fronts", 3, 300, 400};
    Bytes file = encodeUnit(kWork, key, makeBytes("payload"));
    for (std::size_t size = 0; size < file.size(); ++size)
        EXPECT_THROW(readUnit(std::span(file).first(size), kWork, key), Error) << size;
    for (std::byte& byte : file) {
        const std::byte before = byte;
        for (int value = 0; value < 256; ++value) {
            byte = static_cast<std::byte>(value);
            if (byte == before) continue;
            EXPECT_THROW(readUnit(file, kWork, key), Error);
        }
        byte = before;
    }
    file.push_back(std::byte{0});
    EXPECT_THROW(readUnit(file, kWork, key), Error);
}

TEST(UnitFile, IsRefusedInThePlaceOfAnother) {
    const UnitKey key{"backs-1", 3, 300, 400};
    const Bytes file = encodeUnit(kWork, key, makeBytes("payload"));
    expectError(ErrorCode::malformed, "another bake", [&] { readUnit(file, kWork + 1, key); });
    for (const UnitKey& other : {UnitKey{"backs-2", 3, 300, 400}, UnitKey{"backs-1", 4, 300, 400},
                                 UnitKey{"backs-1", 3, 301, 400}, UnitKey{"backs-1", 3, 300, 399}})
        expectError(ErrorCode::malformed, "another unit", [&] { readUnit(file, kWork, other); });
}

TEST(Manifest, GivesItsSettingsBackInOrder) {
    const std::vector<Setting> settings = {{"samples", "1024"}, {"bands", "5"}, {"a", ""}};
    EXPECT_EQ(readManifest(makeBytes(encodeManifest(settings))), settings);
    EXPECT_TRUE(readManifest(makeBytes(encodeManifest({}))).empty());
}

TEST(Manifest, IsReadOrRefusedWhateverItsBytes) {
    const std::string text = encodeManifest(std::vector<Setting>{{"samples", "1024"}});
    const auto tryReading = [](const std::string& damaged) {
        try {
            readManifest(makeBytes(damaged));
            return true;
        } catch (const Error&) {
            return false;
        }
    };
    // All but the line break at the end is needed.
    for (std::size_t size = 0; size + 1 < text.size(); ++size)
        EXPECT_FALSE(tryReading(text.substr(0, size))) << size;
    for (std::size_t i = 0; i < text.size(); ++i)
        for (int value = 0; value < 256; ++value) {
            std::string damaged = text;
            damaged[i] = static_cast<char>(value);
            tryReading(damaged);
        }
    for (const std::string wrong :
         {"[]", "7", R"({"kind": 1})", R"({"kind": "OpenPRT checkpoint"})",
          R"({"kind": "OpenPRT checkpoint", "version": 1})",
          R"({"kind": "OpenPRT checkpoint", "version": 1, "settings": [1]})",
          R"({"kind": "OpenPRT checkpoint", "version": 1, "settings": {"a": 1}})",
          R"({"kind": "OpenPRT checkpoint", "version": 1, "settings": {"a": "\u001b[31m"}})",
          R"({"kind": "OpenPRT checkpoint", "version": 2, "settings": {}})"})
        EXPECT_FALSE(tryReading(wrong)) << wrong;
    EXPECT_FALSE(tryReading(std::string(100'000, '[')));
}

/// A folder in which a work of two settings has kept one unit.
class CheckpointTest : public testing::Test {
  protected:
    void SetUp() override {
        Checkpoint checkpoint(folder(), {}, kSettings);
        checkpoint.store(kKey, makeBytes("payload"));
    }

    std::filesystem::path folder() const { return temporary_.path() / "kept"; }
    std::filesystem::path other() const { return temporary_.path() / "other"; }
    std::filesystem::path unitFile() const { return folder() / "rays-000007.unit"; }

    static std::optional<std::string> load(Checkpoint& checkpoint, const UnitKey& key = kKey) {
        std::optional<std::string> found;
        checkpoint.load(key,
                        [&](std::span<const std::byte> payload) { found = makeText(payload); });
        return found;
    }

    static inline const std::vector<Setting> kSettings = {{"samples", "1024"}, {"bands", "5"}};
    static inline const UnitKey kKey = {"rays", 7, 70, 80};

  private:
    TemporaryFolder temporary_;
};

TEST_F(CheckpointTest, AUnitIsFoundAgain) {
    Checkpoint checkpoint(folder(), {}, kSettings);
    EXPECT_EQ(load(checkpoint), "payload");
    EXPECT_TRUE(checkpoint.contains(kKey));
    EXPECT_FALSE(load(checkpoint, {"rays", 8, 80, 90}));
    EXPECT_FALSE(checkpoint.contains({"rays", 8, 80, 90}));
    EXPECT_TRUE(checkpoint.warnings().empty());
}

TEST_F(CheckpointTest, OtherSettingsAreRefusedByName) {
    const auto resume = [&](const std::vector<Setting>& settings) {
        return [this, settings] { Checkpoint(folder(), {}, settings); };
    };
    expectError(ErrorCode::invalidOption, "samples: 1024 in the checkpoint, 512 asked for",
                resume({{"samples", "512"}, {"bands", "5"}}));
    expectError(ErrorCode::invalidOption, "bands: 5 in the checkpoint, 6 asked for",
                resume({{"samples", "1024"}, {"bands", "6"}}));
    expectError(ErrorCode::invalidOption, "seed: nothing in the checkpoint, 1 asked for",
                resume({{"samples", "1024"}, {"bands", "5"}, {"seed", "1"}}));
    expectError(ErrorCode::invalidOption, "bands: 5 in the checkpoint, nothing asked for",
                resume({{"samples", "1024"}}));
}

TEST_F(CheckpointTest, AFolderOfOtherFilesIsRefused) {
    std::filesystem::create_directory(other());
    writeText(other() / "thesis.tex", "the only copy");
    expectError(ErrorCode::invalidOption, "no checkpoint",
                [&] { Checkpoint(other(), {}, kSettings); });
    EXPECT_EQ(readText(other() / "thesis.tex"), "the only copy");
    expectError(ErrorCode::writeFailed, "thesis.tex",
                [&] { Checkpoint(other() / "thesis.tex", {}, kSettings); });
    expectError(ErrorCode::notFound, "other", [&] { readFolderSettings(other()); });
}

TEST_F(CheckpointTest, ADamagedManifestIsRefused) {
    writeText(folder() / "manifest.json", "{");
    expectError(ErrorCode::malformed, "manifest.json",
                [&] { Checkpoint(folder(), {}, kSettings); });
}

TEST_F(CheckpointTest, ADamagedUnitIsLeftOutWithAWarning) {
    const std::string whole = readText(unitFile());
    std::string flipped = whole;
    flipped[20] = static_cast<char>(flipped[20] ^ 16);
    for (const std::string& damaged : {std::string(), whole.substr(0, whole.size() / 2), flipped}) {
        writeText(unitFile(), damaged);
        Checkpoint checkpoint(folder(), {}, kSettings);
        EXPECT_FALSE(load(checkpoint));
        ASSERT_EQ(checkpoint.warnings().size(), 1u);
        EXPECT_NE(checkpoint.warnings()[0].find("rays-000007.unit"), std::string::npos);
        checkpoint.store(kKey, makeBytes("again"));
        EXPECT_EQ(load(checkpoint), "again");
    }
}

TEST_F(CheckpointTest, WhatAReaderRefusesIsDamageToo) {
    Checkpoint checkpoint(folder(), {}, kSettings);
    EXPECT_FALSE(checkpoint.load(kKey, [](std::span<const std::byte>) {
        throw Error(ErrorCode::malformed, "makes no sense");
    }));
    ASSERT_EQ(checkpoint.warnings().size(), 1u);
    EXPECT_NE(checkpoint.warnings()[0].find("makes no sense"), std::string::npos);
}

TEST_F(CheckpointTest, UnitsOfOtherFoldersAreFound) {
    EXPECT_EQ(load(*std::make_unique<Checkpoint>(other(), std::vector{folder()}, kSettings)),
              "payload");
    expectError(ErrorCode::invalidOption, "samples", [&] {
        Checkpoint(other(), {folder()}, {{"samples", "1"}});
    });
    // Damage in one folder does not matter where another has the unit whole.
    std::filesystem::copy(unitFile(), other());
    writeText(other() / "rays-000007.unit", "");
    Checkpoint both(other(), {folder()}, kSettings);
    EXPECT_EQ(load(both), "payload");
    EXPECT_EQ(both.warnings().size(), 1u);
}

TEST_F(CheckpointTest, WhatAKilledProcessLeftIsSweptUnlessAnotherIsAtWork) {
    const std::filesystem::path left = folder() / "rays-000008.unit.part-a1B2c3";
    const std::filesystem::path foreign = folder() / "notes.part-a1B2c3";
    writeText(left, "half a unit");
    writeText(foreign, "not ours");
    {
        const Checkpoint alone(folder(), {}, kSettings);
        EXPECT_FALSE(std::filesystem::exists(left));
        EXPECT_TRUE(std::filesystem::exists(foreign));
        writeText(left, "another's unit, being written");
        const Checkpoint second(folder(), {}, kSettings);
        EXPECT_TRUE(std::filesystem::exists(left));
    }
    const Checkpoint later(folder(), {}, kSettings);
    EXPECT_FALSE(std::filesystem::exists(left));
}

}  // namespace
}  // namespace prt
