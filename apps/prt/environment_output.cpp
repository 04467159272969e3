#include "apps/prt/environment_output.h"

#include "apps/prt/arguments.h"
#include "apps/prt/interrupts.h"
#include "apps/prt/picture.h"

namespace prt::cli {

void addEnvironmentOptions(CLI::App& command, EnvironmentOutput& output) {
    command
        .add_option("--environment", output.path,
                    "also write the light itself, turned and scaled, as an image")
        ->type_name("OUT.exr|png");
    addParsedOption(command, "--layout", output.layout, parseSphereMap, sphereMapNames(),
                    "of that image")
        ->default_str("lat-long");
    addIntegerOption(command, "--size", output.cellSize, 1, 4096,
                     "its texels along a face of a cube, or else from top to bottom");
}

void checkEnvironmentOutput(const EnvironmentOutput& output) {
    if (!output.path.empty()) requireSuffix(output.path, kPictureSuffixes);
}

void writeEnvironmentOutput(const LightSum& sum, const EnvironmentOutput& output) {
    if (output.path.empty()) return;
    const Environment drawn = drawLights(sum, output.layout, output.cellSize);
    const DeferInterrupts whileWriting;
    writePicture(output.path, drawn.radiance);
}

}  // namespace prt::cli
