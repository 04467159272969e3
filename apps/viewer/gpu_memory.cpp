#include "apps/viewer/gpu_memory.h"

#include <epoxy/gl.h>

namespace prt::viewer {

std::optional<std::uint64_t> usedCardBytes() {
    constexpr std::uint64_t kUnitBytes = 1024;
    if (!epoxy_has_gl_extension("GL_NVX_gpu_memory_info")) return std::nullopt;
    GLint total = 0, available = 0;
    glGetIntegerv(GL_GPU_MEMORY_INFO_TOTAL_AVAILABLE_MEMORY_NVX, &total);
    glGetIntegerv(GL_GPU_MEMORY_INFO_CURRENT_AVAILABLE_VIDMEM_NVX, &available);
    if (total < available) return std::nullopt;
    return static_cast<std::uint64_t>(total - available) * kUnitBytes;
}

}  // namespace prt::viewer
