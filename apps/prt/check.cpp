#include "prt/asset/check_asset.h"

#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/common/text.h"
#include "apps/prt/commands.h"
#include "prt/asset/asset.h"
#include "prt/base/error.h"

namespace prt::cli {
namespace {

void checkAsset(const std::string& path) {
    const std::vector<std::string> problems = findAssetProblems(readAsset(path));
    for (const std::string& problem : problems)
        fmt::print("{}\n", problem);
    if (!problems.empty())
        throw Error(ErrorCode::malformed, "has " + formatCount(problems.size(), "problem"), path);
    fmt::print("ok\n");
}

}  // namespace

void addCheckCommand(CLI::App& app) {
    const auto asset = std::make_shared<std::string>();
    CLI::App* command = app.add_subcommand(
        "check", "Look for anything wrong in an asset: checksums, sizes, doubtful numbers");
    command->footer(
        "Example: prt check statue.prt.glb    (prints ok, or one line a problem and exits with "
        "1)");
    command->add_option("ASSET", *asset, "what prt bake wrote")->required();
    command->callback([asset] { checkAsset(*asset); });
}

}  // namespace prt::cli
