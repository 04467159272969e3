// prt bake --memory and --scratch.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "tests/cli/run_prt.h"

namespace prt::test {
namespace {

using Words = std::vector<std::string>;

constexpr std::uint64_t kMebibyte = std::uint64_t(1) << 20;

class LimitedBake : public testing::Test {
  protected:
    void SetUp() override {
        // A room of 60,000 triangles: what its transfer and its hits take is far more than noise.
        std::string room;
        constexpr int kSide = 100;
        for (int i = 0; i <= kSide; ++i)
            for (int k = 0; k <= kSide; ++k)
                for (const char* face :
                     {"0 %u %v", "1 %v %u", "%v 0 %u", "%u 1 %v", "%u %v 0", "%v %u 1"})
                    room += vertex(face, i, k, kSide);
        const auto index = [](int i, int k, int face) {
            return std::to_string(6 * (i * (kSide + 1) + k) + face + 1);
        };
        for (int i = 0; i < kSide; ++i)
            for (int k = 0; k < kSide; ++k)
                for (int face = 0; face < 6; ++face)
                    room += "f " + index(i, k, face) + " " + index(i, k + 1, face) + " " +
                            index(i + 1, k + 1, face) + " " + index(i + 1, k, face) + "\n";
        writeText(folder_.path() / "room.obj", room);
    }

    static std::string vertex(std::string face, int i, int k, int side) {
        const auto put = [&](const char* name, int value) {
            face.replace(face.find(name), 2, std::to_string(value * (1.0 / side)));
        };
        put("%u", i);
        put("%v", k);
        return "v " + face + "\n";
    }

    CommandResult bake(const std::string& output, const Words& options) {
        Words words = {"bake", "room.obj",   "-o",   output,    "--samples",
                       "32",   "--max-edge", "none", "--stats", "stats.json"};
        words.insert(words.end(), options.begin(), options.end());
        return runPrt(folder_, words);
    }

    std::uint64_t peakOfBake(const std::string& output, const Words& options) {
        const CommandResult result = bake(output, options);
        EXPECT_EQ(result.exitCode, 0) << result.errors;
        log_ = result.errors;
        return nlohmann::json::parse(readText(folder_.path() / "stats.json"))
            .at("peak_bytes")
            .get<std::uint64_t>();
    }

    /// What the last bake said, "to come: 1.2 M rays, 345 MB of memory".
    double toldBytes() const {
        std::smatch told;
        EXPECT_TRUE(std::regex_search(log_, told, std::regex("([0-9.]+) MB of memory"))) << log_;
        return told.empty() ? 0.0 : 1e6 * std::stod(told[1]);
    }

    TemporaryFolder folder_;
    std::string log_;
};

TEST_F(LimitedBake, StaysWithinItsMemoryAndMakesTheSameBytes) {
    const std::uint64_t freely = peakOfBake("freely.prt.glb", {});
    const std::uint64_t allowed = freely - 40 * kMebibyte;
    const std::uint64_t limited =
        peakOfBake("limited.prt.glb", {"--memory", std::to_string(allowed)});
    EXPECT_LE(static_cast<double>(limited), 1.05 * static_cast<double>(allowed));
    EXPECT_EQ(readText(folder_.path() / "freely.prt.glb"),
              readText(folder_.path() / "limited.prt.glb"));
}

TEST_F(LimitedBake, OfMatricesStaysWithinItsMemoryAndMakesTheSameBytes) {
    const Words glossy = {"--transport",      "glossy", "--bands", "3",
                          "--incident-bands", "3",      "--brdf",  "lambert:0.5,0.5,0.5",
                          "--bounces",        "1"};
    const std::uint64_t freely = peakOfBake("freely.prt.glb", glossy);
    const std::uint64_t allowed = freely - 80 * kMebibyte;
    EXPECT_NEAR(toldBytes(), static_cast<double>(freely), 0.2 * static_cast<double>(freely));
    Words less = glossy;
    less.insert(less.end(), {"--memory", std::to_string(allowed)});
    const std::uint64_t limited = peakOfBake("limited.prt.glb", less);
    EXPECT_LE(static_cast<double>(limited), 1.05 * static_cast<double>(allowed));
    EXPECT_EQ(readText(folder_.path() / "freely.prt.glb"),
              readText(folder_.path() / "limited.prt.glb"));
}

TEST_F(LimitedBake, TooLittleIsRefusedWithWhatItTakes) {
    const CommandResult result = bake("out.prt.glb", {"--memory", "1M"});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_NE(result.errors.find("cannot do with 1.05 MB of memory, it needs"), std::string::npos)
        << result.errors;
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out.prt.glb"));
}

TEST_F(LimitedBake, AScratchFolderThatIsNotThereIsNamed) {
    const std::uint64_t freely = peakOfBake("freely.prt.glb", {});
    const CommandResult result =
        bake("out.prt.glb",
             {"--memory", std::to_string(freely - 40 * kMebibyte), "--scratch", "not-there"});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_NE(result.errors.find("not-there"), std::string::npos) << result.errors;
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out.prt.glb"));
}

}  // namespace
}  // namespace prt::test
