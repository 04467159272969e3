#include "apps/prt/environment_output.h"

#include <fmt/format.h>

#include "apps/common/picture.h"
#include "apps/prt/arguments.h"
#include "apps/prt/interrupts.h"
#include "apps/prt/staged_folder.h"
#include "prt/io/image_io.h"
#include "prt/light/prefilter.h"

namespace prt::cli {
namespace {

/// One EXR a roughness, and one for diffuse surfaces: vertical strips of six faces, linear
/// radiance.
void writePrefiltered(const LightSum& sum, const EnvironmentOutput& output) {
    const Environment source = drawLights(sum, SphereMap::latLong, 512);
    const PrefilterOptions options{.faceSize = output.prefilteredSize};
    const PrefilteredEnvironment prefiltered = prefilterEnvironment(source, options);
    const DeferInterrupts whileWriting;
    StagedFolder folder(output.prefiltered);
    for (std::size_t k = 0; k < options.roughnesses.size(); ++k)
        writeExr(folder.path() / fmt::format("roughness-{:.2f}.exr", options.roughnesses[k]),
                 prefiltered.mirrors[k].radiance);
    writeExr(folder.path() / "diffuse.exr", prefiltered.diffuse.radiance);
    stopIfInterrupted();
    folder.commit();
}

}  // namespace

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
    command
        .add_option("--prefilter", output.prefiltered,
                    "also make a folder of cubes that rough mirrors and matt surfaces look up")
        ->type_name("DIR");
    addIntegerOption(command, "--prefilter-size", output.prefilteredSize, 1, 1024,
                     "texels along their faces");
}

void checkEnvironmentOutput(const EnvironmentOutput& output) {
    if (!output.path.empty()) requireSuffix(output.path, kPictureSuffixes);
    if (output.prefiltered.empty()) return;
    const DeferInterrupts whileProbing;
    StagedFolder::check(output.prefiltered);
}

void writeEnvironmentOutput(const LightSum& sum, const EnvironmentOutput& output) {
    if (!output.path.empty()) {
        const Environment drawn = drawLights(sum, output.layout, output.cellSize);
        const DeferInterrupts whileWriting;
        writePicture(output.path, drawn.radiance);
    }
    if (!output.prefiltered.empty()) writePrefiltered(sum, output);
}

}  // namespace prt::cli
