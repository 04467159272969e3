// Nothing is lost: a bake that is killed, interrupted or out of disk goes on where it was.

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "prt/base/random.h"
#include "tests/cli/run_prt.h"

namespace prt::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using Arguments = std::vector<std::string>;

Arguments operator+(Arguments arguments, const Arguments& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

/// A teapot whose bake takes half a second, in nine units.
class CliCheckpoint : public testing::Test {
  protected:
    void SetUp() override { run({"scene", "teapot", "-o", "teapot.glb"}); }

    std::string run(const Arguments& arguments, int exitCode = 0) const {
        const CommandResult result = runPrt(folder, arguments);
        EXPECT_EQ(result.exitCode, exitCode) << result.errors;
        return result.errors;
    }
    fs::path file(const std::string& name) const { return folder.path() / name; }
    std::string output() const { return readText(file("out.prt.glb")); }
    std::string bakeAlone(const Arguments& more = {}) const {
        run(kBake + Arguments{"-o", "out.prt.glb"} + more);
        const std::string bytes = output();
        fs::remove(file("out.prt.glb"));
        return bytes;
    }
    void waitForAUnit() const {
        for (int attempt = 0; attempt < 2000; ++attempt) {
            std::error_code ignored;
            for (const auto& entry : fs::directory_iterator(file("kept"), ignored))
                if (entry.path().extension() == ".unit") return;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        FAIL() << "no unit";
    }

    static inline const Arguments kBake = {"bake", "teapot.glb", "--samples",
                                           "128",  "--bands",    "3"};
    static inline const Arguments kResumable =
        kBake + Arguments{"-o", "out.prt.glb", "--checkpoint", "kept"};

    TemporaryFolder folder;
};

TEST_F(CliCheckpoint, TwentyKillsAtRandomTimesChangeNoByte) {
    const Arguments longer = {"--max-edge", "0.04"};
    const Clock::time_point begin = Clock::now();
    const std::string expected = bakeAlone(longer);
    const std::chrono::duration<double> oneBake = Clock::now() - begin;

    RandomStream random(1, 0);
    int kills = 0;
    for (int attempt = 0; attempt < 200 && kills < 20; ++attempt) {
        const PrtProcess bake(folder, kResumable + longer);
        std::this_thread::sleep_for(oneBake * random.nextUnitDouble());
        bake.sendSignal(SIGKILL);
        if (bake.wait().signal == SIGKILL) ++kills;
        if (!fs::exists(file("out.prt.glb"))) continue;
        ASSERT_EQ(output(), expected) << "after " << kills << " kills";
        fs::remove(file("out.prt.glb"));
        fs::remove_all(file("kept"));
    }
    EXPECT_EQ(kills, 20);
    run(kResumable + longer);
    EXPECT_EQ(output(), expected);
    for (const auto& entry : fs::directory_iterator(file("kept")))
        EXPECT_EQ(entry.path().string().find(".part-"), std::string::npos) << entry.path();
}

TEST_F(CliCheckpoint, AnInterruptSaysHowToGoOn) {
    const std::string expected = bakeAlone();
    for (const int signal : {SIGINT, SIGTERM}) {
        const PrtProcess bake(folder, kResumable);
        waitForAUnit();
        const Clock::time_point begin = Clock::now();
        bake.sendSignal(signal);
        const CommandResult result = bake.wait();
        EXPECT_LT(Clock::now() - begin, std::chrono::seconds(10));
        EXPECT_EQ(result.exitCode, 75) << result.errors;
        EXPECT_NE(result.errors.find("prt: interrupted (the same command goes on"),
                  std::string::npos)
            << result.errors;
        EXPECT_FALSE(fs::exists(file("out.prt.glb")));
        EXPECT_NE(run(kResumable).find("came from the checkpoint"), std::string::npos);
        EXPECT_EQ(output(), expected);
        fs::remove(file("out.prt.glb"));
        fs::remove_all(file("kept"));
    }
}

TEST_F(CliCheckpoint, AFullDiskStopsTheBakeAndFreedSpaceLetsItGoOn) {
    const std::string expected = bakeAlone();
    constexpr rlim_t kLessThanAUnit = 1 << 20;
    const CommandResult result = PrtProcess(folder, kResumable, kLessThanAUnit).wait();
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_NE(result.errors.find("prt: error: kept/fronts-"), std::string::npos) << result.errors;
    EXPECT_NE(result.errors.find("cannot be written"), std::string::npos) << result.errors;
    EXPECT_FALSE(fs::exists(file("out.prt.glb")));
    run(kResumable);
    EXPECT_EQ(output(), expected);
}

TEST_F(CliCheckpoint, OtherSettingsAreRefusedByName) {
    run(kBake + Arguments{"--checkpoint", "kept", "--units", "0:1"});
    const auto refuse = [&](const Arguments& more, const std::string& words) {
        const std::string errors = run(kResumable + more, 2);
        EXPECT_NE(errors.find("prt: error: kept: "), std::string::npos) << errors;
        EXPECT_NE(errors.find(words), std::string::npos) << errors;
    };
    refuse({"--seed", "7"}, "seed: 1 in the checkpoint, 7 asked for");
    refuse({"--max-edge", "none"}, "max-edge: ");
    run({"scene", "cornell", "-o", "teapot.glb"});
    refuse({}, "geometry: ");
    EXPECT_FALSE(fs::exists(file("out.prt.glb")));
}

TEST_F(CliCheckpoint, SharesAreMergedToTheSameBytes) {
    const std::string expected = bakeAlone({"--method", "u16"});
    const auto share = [&](const std::string& to, const std::string& units) {
        return run(kBake + Arguments{"--checkpoint", to, "--units", units});
    };
    const Arguments merge = {"merge", "teapot.glb",  "a",        "b",
                             "-o",    "out.prt.glb", "--method", "u16"};
    // Two machines at once on the same units, and a third that leaves some out.
    {
        const PrtProcess first(folder, kBake + Arguments{"--checkpoint", "a", "--units", "0:4"});
        const PrtProcess second(folder, kBake + Arguments{"--checkpoint", "a", "--units", "0:4"});
        EXPECT_EQ(second.wait().exitCode, 0);
        EXPECT_EQ(first.wait().exitCode, 0);
    }
    const std::string report = share("b", "6:10000");
    EXPECT_NE(report.find("6 of 9 units missing in b"), std::string::npos) << report;
    const std::string errors = run(merge, 1);
    EXPECT_NE(errors.find("a: of 9 units these are missing: 4 to 5"), std::string::npos) << errors;
    share("b", "4:6");
    run(merge);
    EXPECT_EQ(output(), expected);
    EXPECT_NE(run({"merge", "teapot.glb", "lost", "-o", "out.prt.glb"}, 1).find("lost: holds no"),
              std::string::npos);
}

TEST_F(CliCheckpoint, TooLittleMemoryIsSaidBeforeTheWork) {
    constexpr rlim_t kHalfAGigabyte = 1 << 29;
    const CommandResult result = PrtProcess(folder,
                                            {"bake", "teapot.glb", "-o", "out.prt.glb", "--samples",
                                             "4096", "--bands", "10", "--threads", "1"},
                                            {}, kHalfAGigabyte)
                                     .wait();
    EXPECT_EQ(result.exitCode, 1) << result.errors;
    EXPECT_NE(result.errors.find("prt: error: the bake needs "), std::string::npos)
        << result.errors;
    EXPECT_NE(result.errors.find("and there are 537 MB"), std::string::npos) << result.errors;
}

TEST_F(CliCheckpoint, OptionsThatMakeNoSenseTogetherAreWrongUsage) {
    for (const Arguments& more : std::vector<Arguments>{
             {"--units", "0:1"},
             {"-o", "out.prt.glb", "--checkpoint", "kept", "--units", "0:1"},
             {"--checkpoint", "kept"},
             {"--checkpoint", "kept", "--units", "2:1"},
             {"--checkpoint", "kept", "--units", "2"},
             {"--checkpoint", "kept", "--units", "-1:2"},
             {"-o", "out.prt.glb", "--checkpoint", "kept", "--transport", "unshadowed"}})
        run(Arguments{"bake", "teapot.glb"} + more, 2);
    EXPECT_FALSE(fs::exists(file("kept")));
}

}  // namespace
}  // namespace prt::test
