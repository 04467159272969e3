#include "prt/gpu/surface_programs.h"

#include <utility>

#include "prt/gpu/shader_program.h"

namespace prt {
namespace {

GlName link(const std::string& relighting, const SurfaceFeatures& features) {
    const ShaderText vertex = findShader("shaders/relight.vert");
    const ShaderText fragment = findShader("shaders/surface.frag");
    std::string definitions = relighting;
    if (features.textures) definitions += "#define TEXTURED\n";
    if (features.lines) definitions += "#define LINED\n";
    if (!features.mirrors) return linkProgram(vertex, fragment, definitions);
    const std::array called = {findShader("shaders/mirrors.frag"),
                               findShader("shaders/lat_long.frag")};
    return linkProgram(vertex, fragment, definitions + "#define MIRRORED\n", called);
}

}  // namespace

SurfacePrograms::SurfacePrograms(std::string definitions) : definitions_(std::move(definitions)) {
    find({.textures = false});
}

unsigned SurfacePrograms::find(const SurfaceFeatures& features) const {
    const std::size_t index = 4u * features.textures + 2u * features.mirrors + 1u * features.lines;
    GlName& program = programs_[index];
    if (program.get() == 0) program = link(definitions_, features);
    return program.get();
}

}  // namespace prt
