#pragma once

#include "prt/gpu/gl_name.h"
#include "prt/gpu/shader_program.h"

namespace prt {

/// A fragment shader for every pixel of the viewport, behind shaders/screen.vert.
class ScreenPass {
  public:
    explicit ScreenPass(const ShaderText& fragmentShader);

    /// Makes its program current, for its uniforms to be set, and the texture that it reads texel
    /// by texel. Leaves depth test, culling and blending off.
    void use(unsigned texture) const;
    void draw() const;

  private:
    GlName program_;
    GlName layout_;   ///< of no attributes
    GlName sampler_;  ///< the nearest texel
};

}  // namespace prt
