#include "prt/gpu/shader_program.h"

#include <algorithm>
#include <array>

#include <epoxy/gl.h>

#include "prt/base/assert.h"
#include "prt/base/error.h"
#include "prt/gpu/shader_texts.h"

namespace prt {
namespace {

/// What a log says before anything else, and where nothing is said, that.
std::string firstLine(const std::string& log) {
    const std::size_t begin = log.find_first_not_of(" \t\r\n");
    if (begin == std::string::npos) return "the driver does not say why";
    return log.substr(begin, log.find_first_of("\r\n", begin) - begin);
}

/// @param name  a shader or a program, as the two functions have it
std::string readLog(GLuint name, PFNGLGETSHADERIVPROC getNumber,
                    PFNGLGETSHADERINFOLOGPROC getText) {
    GLint length = 0;
    getNumber(name, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 0)), '\0');
    GLsizei written = 0;
    getText(name, length, &written, log.data());
    log.resize(static_cast<std::size_t>(written));
    return log;
}

GlName compileShader(GLenum kind, const ShaderText& shader, const std::string& definitions) {
    const std::size_t firstLineEnd = shader.text.find('\n') + 1;
    const std::array<std::string, 3> parts = {std::string(shader.text.substr(0, firstLineEnd)),
                                              definitions + "#line 2\n",
                                              std::string(shader.text.substr(firstLineEnd))};
    std::array<const char*, 3> texts{};
    std::ranges::transform(parts, texts.begin(), [](const auto& part) { return part.c_str(); });

    GlName name(glCreateShader(kind), [](unsigned given) { glDeleteShader(given); });
    glShaderSource(name.get(), static_cast<GLsizei>(texts.size()), texts.data(), nullptr);
    glCompileShader(name.get());
    GLint isCompiled = GL_FALSE;
    glGetShaderiv(name.get(), GL_COMPILE_STATUS, &isCompiled);
    if (!isCompiled)
        throw Error(ErrorCode::unsupported,
                    "the graphics driver does not compile this shader: " +
                        firstLine(readLog(name.get(), glGetShaderiv, glGetShaderInfoLog)),
                    std::string(shader.name));
    return name;
}

/// Links what is attached.
///
/// @param shader  that an error names, with what is said of the others
void link(const GlName& program, const ShaderText& shader, const std::string& others) {
    glLinkProgram(program.get());
    GLint isLinked = GL_FALSE;
    glGetProgramiv(program.get(), GL_LINK_STATUS, &isLinked);
    if (!isLinked)
        throw Error(ErrorCode::unsupported,
                    "the graphics driver does not link this shader" + others + ": " +
                        firstLine(readLog(program.get(), glGetProgramiv, glGetProgramInfoLog)),
                    std::string(shader.name));
}

}  // namespace

ShaderText findShader(std::string_view name) {
    const auto found = std::ranges::find(kShaderTexts, name, &ShaderText::name);
    PRT_ASSERT(found != std::end(kShaderTexts), "a shader of the library");
    return *found;
}

GlName linkProgram(const ShaderText& vertexShader, const ShaderText& fragmentShader,
                   const std::string& definitions, std::span<const ShaderText> called) {
    const GlName vertex = compileShader(GL_VERTEX_SHADER, vertexShader, definitions);
    const GlName fragment = compileShader(GL_FRAGMENT_SHADER, fragmentShader, definitions);
    GlName program(glCreateProgram(), [](unsigned given) { glDeleteProgram(given); });
    glAttachShader(program.get(), vertex.get());
    glAttachShader(program.get(), fragment.get());
    for (const ShaderText& part : called)
        glAttachShader(program.get(), compileShader(GL_FRAGMENT_SHADER, part, definitions).get());
    link(program, vertexShader, " with " + std::string(fragmentShader.name));
    return program;
}

GlName linkComputeProgram(const ShaderText& shader, const std::string& definitions) {
    const GlName compute = compileShader(GL_COMPUTE_SHADER, shader, definitions);
    GlName program(glCreateProgram(), [](unsigned given) { glDeleteProgram(given); });
    glAttachShader(program.get(), compute.get());
    link(program, shader, "");
    return program;
}

unsigned findComputeProgram(GpuPrograms& programs, const ShaderText& shader,
                            const std::string& definitions) {
    return programs.find(std::string(shader.name) + "\n" + definitions,
                         [&] { return linkComputeProgram(shader, definitions); });
}

}  // namespace prt
