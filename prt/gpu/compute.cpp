#include "prt/gpu/compute.h"

#include <string>

#include <epoxy/gl.h>

#include "prt/base/error.h"

namespace prt {
namespace {

std::size_t countGroups(std::size_t itemCount) {
    return (itemCount + kComputeGroupSize - 1) / kComputeGroupSize;
}

}  // namespace

void requireComputed(std::size_t itemCount, std::size_t largestBytes) {
    GLint64 mostBytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &mostBytes);
    GLint mostGroups = 0;
    glGetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 0, &mostGroups);
    if (largestBytes > static_cast<std::size_t>(mostBytes) ||
        countGroups(itemCount) > static_cast<std::size_t>(mostGroups))
        throw Error(ErrorCode::limitExceeded,
                    "relighting " + std::to_string(itemCount) + " receivers takes " +
                        std::to_string(largestBytes) +
                        " bytes at once, and the driver lets a "
                        "shader have " +
                        std::to_string(mostBytes) + " for " +
                        std::to_string(static_cast<std::size_t>(mostGroups) * kComputeGroupSize),
                    {}, "compress the asset, or draw on the CPU");
}

void bindBuffer(unsigned place, const GlName& buffer) {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, place, buffer.get());
}

void computeFor(std::size_t itemCount, std::size_t rowCount) {
    if (itemCount == 0) return;
    glDispatchCompute(static_cast<GLuint>(countGroups(itemCount)), static_cast<GLuint>(rowCount),
                      1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace prt
