// prt compare: what its report holds, and that it agrees with path tracing.

#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "prt/io/image_io.h"
#include "tests/cli/run_prt.h"

namespace prt::test {
namespace {

using Json = nlohmann::json;

/// Baked scenes for all tests.
class Compare : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = new TemporaryFolder;
        run({"scene", "blocker", "-o", "slab.glb"});
        run({"bake", "slab.glb", "-o", "slab.prt.glb", "--bands", "10", "--samples", "128",
             "--bounces", "1"});
        run({"bake", "slab.glb", "-o", "shadowed.prt.glb", "--bands", "2", "--samples", "16",
             "--transport", "shadowed"});
    }
    static void TearDownTestSuite() { delete folder_; }

    static void run(const std::vector<std::string>& arguments) {
        const CommandResult result = runPrt(*folder_, arguments);
        EXPECT_EQ(result.exitCode, 0) << result.errors;
    }

    static std::vector<std::string> compareTo(const std::string& report,
                                              const std::vector<std::string>& more) {
        std::vector<std::string> arguments = {
            "compare", "slab.prt.glb",        "-o", report, "--size",
            "80x45",   "--reference-samples", "64"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }

    static Json compare(const std::string& report, const std::vector<std::string>& more) {
        run(compareTo(report, more));
        return Json::parse(readText(file(report) / "comparison.json"));
    }

    static std::filesystem::path file(const std::string& name) { return folder_->path() / name; }
    static const TemporaryFolder& folder() { return *folder_; }

  private:
    static inline TemporaryFolder* folder_ = nullptr;
};

TEST_F(Compare, TheReportIsWholeAndNeedsNoNetwork) {
    compare("whole", {"--light", "sun:40,55,30", "--triple", "--band-counts", "3:4"});
    const std::string page = readText(file("whole") / "index.html");
    EXPECT_EQ(page.find("http"), std::string::npos);
    for (const char* word : {"PSNR", "FLIP", "RMSE", "noise", "baked with", "times"})
        EXPECT_NE(page.find(word), std::string::npos) << word;

    const std::regex link("(?:src|href|value)=\"([^\"]*\\.(?:png|json))\"");
    std::set<std::string> shown;
    for (std::sregex_iterator match(page.begin(), page.end(), link), end; match != end; ++match)
        shown.insert((*match)[1]);
    EXPECT_EQ(shown.size(), 13u);  // 3 + 2 · 2 + 3 + 2 pictures, and the numbers
    for (const std::string& name : shown)
        EXPECT_TRUE(std::filesystem::exists(file("whole") / name)) << name;
    EXPECT_EQ(readImage(file("whole") / "light1-relit.exr").width, 80);
}

TEST_F(Compare, TheBakeAgreesWithPathTracingUnderTheSameBands) {
    const Json report = compare("agree", {"--light", "uniform:0.5,0.6,0.7"});
    const Json& light = report.at("lights").at(0);
    for (const char* reference : {"the_light_in_its_bands", "the_light_itself"}) {
        const Json& against = light.at("against").at(reference);
        EXPECT_LT(against.at("largest_relative_rmse_without_noise"), 0.015) << against;
        EXPECT_LT(against.at("at_vertices").at("largest_relative_rmse_without_noise"), 0.015)
            << against;
        EXPECT_GT(against.at("noise_rmse"), 0.0);
        EXPECT_GT(against.at("psnr_db"), 35.0);
    }
}

/// T-18: the error falls with the number of bands and with the size of the light; a light of no
/// extent stays bad.
TEST_F(Compare, BandsAndLargeLightsMakeTheErrorFall) {
    const Json report = compare("bands", {"--light", "sun:40,55,0", "--light", "sun:40,55,20",
                                          "--light", "sun:40,55,40", "--band-counts", "2:10"});
    std::vector<std::vector<double>> errors;
    for (const Json& light : report.at("lights")) {
        errors.emplace_back();
        for (const Json& row : light.at("by_band_count"))
            errors.back().push_back(row.at("relative_rmse_without_noise"));
        ASSERT_EQ(errors.back().size(), 9u);
    }
    constexpr double kNoise = 0.004;
    for (std::size_t light = 0; light < 3; ++light) {
        for (std::size_t i = 1; i < 9; ++i)
            EXPECT_LT(errors[light][i], errors[light][i - 1] + kNoise)
                << "light " << light << ", " << i + 2 << " bands";
        EXPECT_LT(errors[light][8], 0.5 * errors[light][0]);
    }
    for (std::size_t i = 0; i < 9; ++i) {
        EXPECT_LT(errors[1][i], errors[0][i]) << i + 2 << " bands";
        EXPECT_LT(errors[2][i], errors[1][i]) << i + 2 << " bands";
    }
    EXPECT_GT(errors[0][8], 0.04);
    EXPECT_LT(errors[2][8], 0.02);
}

TEST_F(Compare, EachKindOfTransportIsWorthSomething) {
    const Json report = compare("triple", {"--light", "uniform:1", "--triple"});
    const Json& rows = report.at("lights").at(0).at("by_transport");
    ASSERT_EQ(rows.size(), 3u);
    const auto error = [&](std::size_t i) {
        return rows.at(i).at("rmse_without_noise").get<double>();
    };
    EXPECT_GT(error(0), error(1));
    EXPECT_GT(error(1), error(2));
}

/// Shadowed transport is held against paths without a bounce.
TEST_F(Compare, TheReferenceMakesTheBouncesOfTheAsset) {
    EXPECT_EQ(compare("one", {"--light", "uniform:1"}).at("bounces"), 1);
    const Json shadowed = compare("none", {"--light", "uniform:1", "--transport", "shadowed"});
    EXPECT_EQ(shadowed.at("bounces"), 0);
    EXPECT_LT(shadowed.at("lights")
                  .at(0)
                  .at("against")
                  .at("the_light_itself")
                  .at("largest_relative_rmse_without_noise"),
              0.02);
    EXPECT_EQ(compare("inf", {"--light", "uniform:1", "--bounces", "inf"}).at("bounces"), "inf");
}

TEST_F(Compare, AnyNumberOfThreadsGivesTheSamePictures) {  // C10
    for (const std::string threads : {"1", "3"})
        compare("threads" + threads, {"--light", "sun:40,55,10", "--threads", threads});
    for (const char* name :
         {"light1-relit.exr", "light1-path-traced.exr", "light1-path-traced-in-bands.exr"})
        EXPECT_EQ(readText(file("threads1") / name), readText(file("threads3") / name)) << name;
    compare("seed", {"--light", "sun:40,55,10", "--seed", "2"});
    EXPECT_NE(readText(file("threads1") / "light1-path-traced.exr"),
              readText(file("seed") / "light1-path-traced.exr"));
}

TEST_F(Compare, AnInterruptLeavesNothing) {
    // In a folder of its own, where no other run has said anything yet.
    const TemporaryFolder own;
    std::filesystem::copy(file("slab.prt.glb"), own.path() / "slab.prt.glb");
    const PrtProcess process(own, {"compare", "slab.prt.glb", "--light", "uniform:1", "-o", "r",
                                   "--reference-samples", "1000000"});
    for (int attempt = 0;
         attempt < 1000 && process.errorsSoFar().find("render") == std::string::npos; ++attempt)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    process.sendSignal(SIGTERM);
    const CommandResult result = process.wait();
    EXPECT_EQ(result.exitCode, 75) << result.errors;
    EXPECT_EQ(own.fileCount(), 1);
}

TEST_F(Compare, WrongInputIsOneSentenceAndNoFolder) {
    struct Wrong {
        std::vector<std::string> arguments;
        int exitCode;
        std::string word;
    };
    writeText(file("taken.txt"), "mine");
    const std::vector<Wrong> wrongs = {
        {{"compare", "lost.prt.glb", "--light", "uniform:1", "-o", "r"}, 1, "lost.prt.glb"},
        {{"compare", "slab.glb", "--light", "uniform:1", "-o", "r"}, 1, "slab.glb"},
        {compareTo("r", {"--light", "lost.exr"}), 1, "lost.exr"},
        {compareTo("nowhere/r", {"--light", "uniform:1"}), 1, "nowhere/r"},
        {compareTo("taken.txt", {"--light", "uniform:1"}), 2, "taken.txt"},
        {compareTo(".", {"--light", "uniform:1"}), 2, "exists already"},
        {compareTo("r", {"--light", "moon:1"}), 2, "moon:1"},
        {compareTo("r", {}), 2, "--light"},
        {compareTo("r", {"--light", "uniform:1", "--camera", "lost"}), 2, "lost"},
        {compareTo("r", {"--light", "uniform:1", "--band-counts", "3:2"}), 2, "--band-counts"},
        {{"compare", "slab.prt.glb", "--light", "uniform:1", "-o", "r", "--reference-samples", "1"},
         2,
         "--reference-samples"},
        {{"compare", "shadowed.prt.glb", "--light", "uniform:1", "-o", "r", "--band-counts", "3"},
         2,
         "2 bands"},
        {{"compare", "shadowed.prt.glb", "--light", "uniform:1", "-o", "r", "--transport",
          "interreflected"},
         2,
         "without interreflected"},
    };
    const std::ptrdiff_t fileCount = folder().fileCount();
    for (const Wrong& wrong : wrongs) {
        const CommandResult result = runPrt(folder(), wrong.arguments);
        EXPECT_EQ(result.exitCode, wrong.exitCode) << result.errors;
        EXPECT_NE(result.errors.find("prt: error: "), std::string::npos) << result.errors;
        EXPECT_NE(result.errors.find(wrong.word), std::string::npos) << result.errors;
        EXPECT_EQ(folder().fileCount(), fileCount) << wrong.word;
    }
    EXPECT_EQ(readText(file("taken.txt")), "mine");
}

}  // namespace
}  // namespace prt::test
