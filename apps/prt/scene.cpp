#include <memory>
#include <string>

#include <fmt/format.h>

#include "apps/prt/arguments.h"
#include "apps/prt/commands.h"
#include "apps/prt/interrupts.h"
#include "prt/gltf/glb_writer.h"
#include "prt/scene/procedural.h"

namespace prt::cli {
namespace {

struct SceneArguments {
    std::string name;
    std::string output;
    bool list = false;
};

void listScenes() {
    for (const ProceduralScene& scene : proceduralScenes())
        fmt::print("{:<20} {}\n", scene.name, scene.description);
}

void writeProceduralScene(const SceneArguments& arguments) {
    requireSuffix(arguments.output, ".glb");
    const Scene scene = makeProceduralScene(arguments.name);
    const DeferInterrupts whileWriting;
    writeGlb(arguments.output, scene);
}

}  // namespace

void addSceneCommand(CLI::App& app) {
    const auto arguments = std::make_shared<SceneArguments>();
    CLI::App* command = app.add_subcommand("scene", "Make a scene by code, to try the others on");
    command->footer("Example: prt scene cornell -o cornell.glb");
    CLI::Option* name =
        command->add_option("NAME", arguments->name, "one of the names that --list shows");
    CLI::Option* output =
        command->add_option("-o,--output", arguments->output, "the binary glTF to write");
    output->type_name("OUT.glb");
    CLI::Option* list =
        command->add_flag("--list", arguments->list, "show the names, and what each is for");
    list->excludes(name)->excludes(output);

    command->callback([arguments, name, output] {
        if (arguments->list) return listScenes();
        if (name->count() == 0) throw CLI::RequiredError("NAME or --list");
        if (output->count() == 0) throw CLI::RequiredError("-o OUT.glb");
        writeProceduralScene(*arguments);
    });
}

}  // namespace prt::cli
