#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "prt/gpu/gl_name.h"

namespace prt {

/// Programs of one context, each linked when it is first asked for. Who draws many objects, or ever
/// others, lets them share these: a program takes longer to link than a small asset to load.
class GpuPrograms {
  public:
    /// OpenGL's name of a program, which stays as long as this.
    ///
    /// @param key     what tells it from all others: its shader and definitions
    /// @param link    makes it, the first time
    /// @throws Error  as `link`
    unsigned find(const std::string& key, const std::function<GlName()>& link);

  private:
    std::map<std::string, GlName> programs_;
};

/// Who holds one keeps the programs. Null stands for programs of one's own.
using SharedGpuPrograms = std::shared_ptr<GpuPrograms>;

}  // namespace prt
