#pragma once

#include <span>

#include "prt/gpu/gl_name.h"
#include "prt/gpu/shader_program.h"
#include "prt/scene/scene.h"

namespace prt {

/// A fragment shader for every pixel of the viewport, behind shaders/screen.vert.
class ScreenPass {
  public:
    /// @param filter  of the texture that it reads, which is the same again on its left and right
    /// @param called  as for linkProgram
    explicit ScreenPass(const ShaderText& fragmentShader,
                        TextureFilter filter = TextureFilter::nearest,
                        std::span<const ShaderText> called = {});

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
