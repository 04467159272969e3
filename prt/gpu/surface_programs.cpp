#include "prt/gpu/surface_programs.h"

#include <utility>

#include "prt/gpu/shader_program.h"

namespace prt {
namespace {

std::string define(const SurfaceFeatures& features) {
    std::string definitions;
    if (features.textures) definitions += "#define TEXTURED\n";
    if (features.lines) definitions += "#define LINED\n";
    if (features.mirrors) definitions += "#define MIRRORED\n";
    return definitions;
}

GlName link(const std::string& definitions, bool hasMirrors) {
    const ShaderText vertex = findShader("shaders/relight.vert");
    const ShaderText fragment = findShader("shaders/surface.frag");
    if (!hasMirrors) return linkProgram(vertex, fragment, definitions);
    const std::array called = {findShader("shaders/mirrors.frag"),
                               findShader("shaders/lat_long.frag")};
    return linkProgram(vertex, fragment, definitions, called);
}

}  // namespace

SurfacePrograms::SurfacePrograms(std::string definitions, SharedGpuPrograms programs)
    : definitions_(std::move(definitions)),
      programs_(programs ? std::move(programs) : std::make_shared<GpuPrograms>()) {
    find({.textures = false});
}

unsigned SurfacePrograms::find(const SurfaceFeatures& features) const {
    const std::size_t index = 4u * features.textures + 2u * features.mirrors + 1u * features.lines;
    if (names_[index] == 0) {
        const std::string definitions = definitions_ + define(features);
        names_[index] = programs_->find("surface\n" + definitions,
                                        [&] { return link(definitions, features.mirrors); });
    }
    return names_[index];
}

}  // namespace prt
