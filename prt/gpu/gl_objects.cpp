#include "prt/gpu/gl_objects.h"

#include <algorithm>

#include <epoxy/gl.h>

#include "prt/base/error.h"
#include "prt/gpu/shader_interface.h"

namespace prt {

void checkGpuMemory(const std::string& what) {
    bool isMemoryOut = false;
    for (GLenum error = glGetError(); error != GL_NO_ERROR; error = glGetError())
        isMemoryOut |= error == GL_OUT_OF_MEMORY;
    if (isMemoryOut)
        throw Error(ErrorCode::outOfMemory, "the graphics card has no memory left for " + what);
}

GlName makeBuffer(std::size_t byteCount, const std::string& what) {
    unsigned name = 0;
    glGenBuffers(1, &name);
    GlName buffer(name, [](unsigned given) { glDeleteBuffers(1, &given); });
    glBindBuffer(GL_COPY_WRITE_BUFFER, name);
    glBufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(std::max<std::size_t>(byteCount, 1)),
                 nullptr, GL_STATIC_DRAW);
    checkGpuMemory(what);
    return buffer;
}

void writeBuffer(const GlName& buffer, std::size_t offset, std::span<const std::byte> bytes) {
    if (bytes.empty()) return;
    glBindBuffer(GL_COPY_WRITE_BUFFER, buffer.get());
    glBufferSubData(GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(offset),
                    static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

void readBuffer(const GlName& buffer, std::span<std::byte> bytes) {
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glBindBuffer(GL_COPY_READ_BUFFER, buffer.get());
    glGetBufferSubData(GL_COPY_READ_BUFFER, 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

void requireShaderBuffers(std::size_t largestBytes) {
    GLint blockCount = 0;
    glGetIntegerv(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, &blockCount);
    if (blockCount < buffers::kCount)
        throw Error(ErrorCode::unsupported,
                    "the graphics driver lets vertex shaders read " + std::to_string(blockCount) +
                        " buffers, not the " + std::to_string(buffers::kCount) +
                        " that relighting takes",
                    {}, "draw on the CPU");
    GLint64 mostBytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &mostBytes);
    if (largestBytes > static_cast<std::size_t>(mostBytes))
        throw Error(ErrorCode::limitExceeded,
                    "the transfer takes " + std::to_string(largestBytes) +
                        " bytes, more than the " + std::to_string(mostBytes) +
                        " that the graphics driver lets a shader read",
                    {}, "compress the asset, or draw on the CPU");
}

GlName makeTexture(unsigned target) {
    unsigned name = 0;
    glGenTextures(1, &name);
    GlName texture(name, [](unsigned given) { glDeleteTextures(1, &given); });
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(target, name);
    return texture;
}

void requireTextureSize(int width, int height, const std::string& what, const std::string& hint) {
    GLint mostTexels = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &mostTexels);
    if (width > mostTexels || height > mostTexels)
        throw Error(ErrorCode::limitExceeded,
                    what + " is " + std::to_string(width) + " × " + std::to_string(height) +
                        " texels, and the graphics driver takes no more than " +
                        std::to_string(mostTexels) + " along a side",
                    {}, hint);
}

GlName makeSampler(int wrapU, int wrapV, int filter) {
    unsigned name = 0;
    glGenSamplers(1, &name);
    GlName sampler(name, [](unsigned given) { glDeleteSamplers(1, &given); });
    glSamplerParameteri(name, GL_TEXTURE_WRAP_S, wrapU);
    glSamplerParameteri(name, GL_TEXTURE_WRAP_T, wrapV);
    glSamplerParameteri(name, GL_TEXTURE_MIN_FILTER, filter);
    glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER, filter);
    return sampler;
}

}  // namespace prt
