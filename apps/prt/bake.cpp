#include <memory>
#include <optional>
#include <string>

#include "apps/prt/arguments.h"
#include "apps/prt/bake_work.h"
#include "apps/prt/commands.h"

namespace prt::cli {
namespace {

constexpr const char* kFooter =
    R"(Example: prt bake statue.glb -o statue.prt.glb --samples 4096 --bounces inf --method cpca

The asset is a glTF with one layer for each transport up to the one asked for, so that all of them
can be shown. The same seed gives the same bytes for any number of threads, on one instruction set.

Diffuse light is a vector a vertex, --bands squared. Glossy light depends on the view, and is a
matrix: --bands squared times --incident-bands squared numbers, 10 KB a vertex at 5 by 5 and in
floats; --method cpca makes about a hundredth of it. Its rays are traced again for each bounce, and for each
part of the light where --memory has no room for all: give it 8 KB a vertex.

With --refine-error vertices are added where shadows bend, and only there: at the same error a third
of the vertices of a small --max-edge are enough.

With --checkpoint DIR nothing is lost: however the bake ends, the same command goes on from what is
in DIR, and makes the same bytes. Other settings or another scene are refused, but --method,
--threads and --memory may change. DIR stays when the asset is written; remove it when you like.

Many machines can share a bake. Each makes some of its units, which a bake counts before it begins,
and prt merge puts them together; give all of them the same --isa:
  prt bake statue.glb --isa avx2 --checkpoint part1 --units 0:200      on one machine
  prt bake statue.glb --isa avx2 --checkpoint part2 --units 200:400    on another
  prt merge statue.glb part1 part2 -o statue.prt.glb)";

/// "a:b", the units from a up to but without b.
std::optional<UnitRange> parseUnits(std::string_view text) {
    const std::size_t colon = text.find(':');
    if (colon == std::string_view::npos) return std::nullopt;
    const std::optional<std::uint64_t> begin = parseWholeNumber(text.substr(0, colon));
    const std::optional<std::uint64_t> end = parseWholeNumber(text.substr(colon + 1));
    if (!begin || !end || *begin > *end) return std::nullopt;
    return UnitRange{*begin, *end};
}

}  // namespace

void addBakeCommand(CLI::App& app) {
    struct State {
        BakeArguments arguments;
        UnitRange units;
    };
    const auto state = std::make_shared<State>();
    BakeArguments& arguments = state->arguments;
    CLI::App* command =
        app.add_subcommand("bake", "Precompute a scene's light transport: SCENE to OUT.prt.glb");
    command->footer(std::string(kFooter) + "\n\n" + kMethodHelp);
    command
        ->add_option("SCENE", arguments.scene, "the scene: .gltf, .glb, .obj or .ply; metres, Y up")
        ->required();
    CLI::Option* output =
        command->add_option("-o,--output", arguments.output, "the asset to write");
    output->type_name("OUT.prt.glb");
    addTransportOptions(*command, arguments);
    addRunOptions(*command, arguments);
    CLI::Option* checkpoint =
        command->add_option("--checkpoint", arguments.bake.checkpoint.folder,
                            "keep finished work in this folder, and go on from what it holds");
    checkpoint->type_name("DIR");
    CLI::Option* units =
        addParsedOption(*command, "--units", state->units, parseUnits, "A:B",
                        "make units A up to but without B of the rays into DIR, and stop");
    units->needs(checkpoint)->excludes(output);

    command->callback([state, command, output, units] {
        state->arguments.brdfTexts = command->get_option("--brdf")->results();
        const BakeOptions& bake = state->arguments.bake;
        if (output->count() + units->count() == 0) throw CLI::RequiredError("--output");
        checkTransportOptions(*command, bake);
        if (command->count("--checkpoint") > 0 && bake.transport == Transport::unshadowed)
            throw CLI::ValidationError("--checkpoint",
                                       "unshadowed transport traces no ray that could be kept");
        if (units->count() > 0 && isGlossy(bake.transport))
            throw CLI::ValidationError("--units",
                                       "glossy transport is baked by one machine, not in shares");
        if (units->count() > 0) return bakeShare(state->arguments, state->units);
        bakeToAsset(state->arguments);
    });
}

}  // namespace prt::cli
