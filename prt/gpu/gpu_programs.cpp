#include "prt/gpu/gpu_programs.h"

namespace prt {

unsigned GpuPrograms::find(const std::string& key, const std::function<GlName()>& link) {
    const auto known = programs_.find(key);
    if (known != programs_.end()) return known->second.get();
    return programs_.emplace(key, link()).first->second.get();
}

}  // namespace prt
