#pragma once

#include <cstddef>
#include <memory>

#include "prt/scene/scene.h"

namespace prt {

/// Meshes, materials and textures of a scene in the memory of the graphics card.
class GpuScene {
  public:
    /// @param scene   textures decoded; undecoded ones count as white
    /// @throws Error  limitExceeded for a texture larger than the driver takes, outOfMemory
    explicit GpuScene(const Scene& scene);
    ~GpuScene();
    GpuScene(GpuScene&&) noexcept;
    GpuScene& operator=(GpuScene&&) noexcept;

    std::size_t vertexCount() const;
    const Bounds& bounds() const;
    bool hasTextures() const;

    /// Draws all triangles with the program that is current, which is GpuRadiance's. One-sided
    /// surfaces are invisible from behind.
    void drawTriangles() const;

  private:
    struct Content;
    std::unique_ptr<Content> content_;
};

}  // namespace prt
