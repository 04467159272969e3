// prt --help teaches.

#include <gtest/gtest.h>

#include <string>

#include "tests/cli/run_prt.h"

namespace prt::test {
namespace {

constexpr std::size_t kTerminalWidth = 110;

TEST(CliHelp, EverySubcommandHasAnExampleAndFitsTheTerminal) {
    const TemporaryFolder folder;
    const std::string overview = runPrt(folder, {"--help"}).output;
    for (const std::string command : {"scene", "bake", "merge", "compress", "light", "brdf",
                                      "render", "export", "web", "compare", "info", "check"}) {
        EXPECT_NE(overview.find("\n  " + command + " "), std::string::npos) << overview;
        const CommandResult result = runPrt(folder, {command, "--help"});
        EXPECT_EQ(result.exitCode, 0);
        EXPECT_NE(result.output.find("prt " + command + " "), std::string::npos) << result.output;
        EXPECT_NE(result.output.find("Example"), std::string::npos) << result.output;
        EXPECT_EQ(result.output.find('\x1b'), std::string::npos) << "colours without a terminal";
        for (std::size_t start = 0; start < result.output.size();) {
            const std::size_t end = result.output.find('\n', start);
            EXPECT_LE(end - start, kTerminalWidth) << result.output.substr(start, end - start);
            start = end + 1;
        }
    }
}

TEST(CliHelp, VersionIsPrinted) {
    const TemporaryFolder folder;
    EXPECT_EQ(runPrt(folder, {"--version"}).output, "prt " PRT_VERSION "\n");
}

TEST(CliScene, ListNamesScenesThatCanBeMade) {
    const TemporaryFolder folder;
    const CommandResult list = runPrt(folder, {"scene", "--list"});
    EXPECT_NE(list.output.find("teapot"), std::string::npos);
    EXPECT_NE(list.output.find("cornell"), std::string::npos);
}

TEST(CliOutput, AFullStandardOutputIsAnError) {
    const TemporaryFolder folder;
    constexpr rlim_t kFewBytes = 100;
    const CommandResult result =
        PrtProcess(folder, {"light", "uniform:1", "--bands", "10"}, kFewBytes).wait();
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_NE(result.errors.find("standard output: cannot be written"), std::string::npos)
        << result.errors;
}

}  // namespace
}  // namespace prt::test
