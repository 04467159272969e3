#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/prt/bake_work.h"
#include "apps/prt/commands.h"
#include "prt/base/error.h"

namespace prt::cli {
namespace {

constexpr const char* kFooter =
    R"(Example: prt merge statue.glb part1 part2 -o statue.prt.glb

The folders say how the scene was to be baked. What the units of their rays do not hold, the other
sides of double-sided surfaces and the bounces, is made here and kept in the first folder. The asset
is the same to the last byte as that of a single prt bake. See prt bake --help for how to share.)";

}  // namespace

void addMergeCommand(CLI::App& app) {
    struct State {
        BakeArguments arguments;
        std::vector<std::filesystem::path> folders;
    };
    const auto state = std::make_shared<State>();
    BakeArguments& arguments = state->arguments;
    CLI::App* command = app.add_subcommand(
        "merge", "Put together what prt bake --units made: SCENE and DIR... to OUT.prt.glb");
    command->footer(kFooter);
    command->add_option("SCENE", arguments.scene, "the scene that was baked")->required();
    command->add_option("DIR", state->folders, "the folders with the units")->required();
    command->add_option("-o,--output", arguments.output, "the asset to write")
        ->type_name("OUT.prt.glb")
        ->required();
    addRunOptions(*command, arguments);

    command->callback([state] {
        CheckpointOptions& checkpoint = state->arguments.bake.checkpoint;
        checkpoint.folder = state->folders.front();
        checkpoint.otherFolders.assign(state->folders.begin() + 1, state->folders.end());
        checkpoint.requireFronts = true;
        adoptFolderSettings(checkpoint.folder, state->arguments);
        if (isGlossy(state->arguments.bake.transport))
            throw Error(ErrorCode::invalidOption,
                        "holds glossy transport, which is baked by one machine",
                        checkpoint.folder.string(), "go on with prt bake --checkpoint");
        bakeToAsset(state->arguments);
    });
}

}  // namespace prt::cli
