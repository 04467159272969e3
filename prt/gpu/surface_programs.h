#pragma once

#include <array>
#include <string>

#include "prt/gpu/gl_name.h"

namespace prt {

/// What a program of shaders/surface.frag can show. A rasteriser on the CPU goes through all that a
/// program can, used or not.
struct SurfaceFeatures {
    bool textures = true;
    bool mirrors = false;
    bool lines = false;
};

/// The programs of shaders/relight.vert and surface.frag, and of mirrors.frag where it is needed.
class SurfacePrograms {
  public:
    /// @param definitions  of relight.vert
    /// @throws Error       unsupported, if the driver refuses the plainest
    explicit SurfacePrograms(std::string definitions);

    /// OpenGL's name of a program, which is linked when it is first asked for.
    ///
    /// @throws Error  unsupported
    unsigned find(const SurfaceFeatures& features) const;

  private:
    std::string definitions_;
    mutable std::array<GlName, 8> programs_;  ///< [textures][mirrors][lines]
};

}  // namespace prt
