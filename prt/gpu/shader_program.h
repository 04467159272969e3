#pragma once

#include <span>
#include <string>
#include <string_view>

#include "prt/gpu/gpu_programs.h"

namespace prt {

/// A text of shaders/, whose first line is its #version.
struct ShaderText {
    std::string_view name;  ///< "shaders/relight.vert"
    std::string_view text;
};

/// Those of the library, which carries them in itself. @param name  one that exists
ShaderText findShader(std::string_view name);

/// A program of two shaders.
///
/// @param definitions  lines of #define for all, behind their first lines
/// @param called       fragment shaders with functions that fragmentShader calls
/// @throws Error       unsupported, with the shader's name and what the driver says first of it
GlName linkProgram(const ShaderText& vertexShader, const ShaderText& fragmentShader,
                   const std::string& definitions = {}, std::span<const ShaderText> called = {});

/// A program of a compute shader, with the same definitions and errors.
GlName linkComputeProgram(const ShaderText& shader, const std::string& definitions = {});

/// The same, shared; OpenGL's name.
unsigned findComputeProgram(GpuPrograms& programs, const ShaderText& shader,
                            const std::string& definitions);

}  // namespace prt
