#pragma once

#include <array>
#include <string>

#include "prt/gpu/gpu_programs.h"

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
    /// @param programs     may be shared
    /// @throws Error       unsupported, if the driver refuses the plainest
    explicit SurfacePrograms(std::string definitions, SharedGpuPrograms programs = {});

    /// OpenGL's name of a program, which is linked when it is first asked for.
    ///
    /// @throws Error  unsupported
    unsigned find(const SurfaceFeatures& features) const;

  private:
    std::string definitions_;
    SharedGpuPrograms programs_;
    mutable std::array<unsigned, 8> names_{};  ///< [textures][mirrors][lines]; 0: not yet found
};

}  // namespace prt
