#pragma once

#include <span>
#include <string>

#include "prt/gpu/gl_name.h"
#include "prt/gpu/shader_program.h"
#include "prt/scene/scene.h"

namespace prt {

struct ScreenPassOptions {
    /// Of the texture that is read, which is the same again on its left and right.
    TextureFilter filter = TextureFilter::nearest;
    std::string definitions{};             ///< as for linkProgram
    std::span<const ShaderText> called{};  ///< as for linkProgram
};

/// A fragment shader for every pixel of the viewport, behind shaders/screen.vert.
class ScreenPass {
  public:
    explicit ScreenPass(const ShaderText& fragmentShader, const ScreenPassOptions& options = {});

    /// Makes its program and texture current, for its uniforms to be set. Leaves depth test,
    /// culling and blending off.
    void use(unsigned texture) const;
    void draw() const;

  private:
    GlName program_;
    GlName layout_;  ///< of no attributes
    GlName sampler_;
};

}  // namespace prt
