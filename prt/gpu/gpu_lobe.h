#pragma once

#include <optional>
#include <span>

#include "prt/gpu/gpu_view.h"
#include "prt/gpu/screen_pass.h"
#include "prt/light/lighting.h"

namespace prt {

/// A colour for functions of one channel, linear.
inline constexpr Vec3f kWarmLobe(0.8f, 0.31f, 0.05f);

/// Colours of a lobe, linear.
struct LobeColors {
    std::optional<Vec3f> positive{};              ///< none: those of the function's three channels
    Vec3f negative = Vec3f(0.03f, 0.17f, 0.65f);  ///< where the function is below 0
};

/// Where a lobe stands in a scene.
struct LobePlace {
    Vec3d center{0.0, 0.0, 0.0};  ///< world space
    double largestRadius = 1.0;   ///< metres, more than 0
    Mat3d worldFromLobe{};        ///< a rotation
};

/// A square part of a picture.
struct PictureSquare {
    int left = 0;  ///< pixels from the picture's left edge
    int top = 0;   ///< and from its upper one
    int side = 240;
};

/// A spherical function drawn as the closed surface r(ω) = |f(ω)|, as shapeLobe makes it, lightly
/// shaded by a lamp that goes with the camera. It is laid over a picture that is shown already:
/// neither exposure nor tone curve changes it.
///
/// Drawing leaves depth test, culling, blending and scissor off.
class GpuLobe {
  public:
    /// Of the function 0, of which nothing is seen.
    GpuLobe();

    /// @param function  its bands beyond kMaxBandCount go unused
    void setFunction(const Lighting& function, const LobeColors& colors = {});

    /// Draws it as it stands among objects that hide it. Over the viewport of the framebuffer that
    /// is bound, which shows `scene` pixel for pixel.
    ///
    /// @param scene, objects, camera  a picture, and what drawGpuView has made it of
    /// @param columns                 that are drawn to
    void drawInScene(const GpuTarget& scene, std::span<const GpuObject> objects,
                     const Camera& camera, const LobePlace& place,
                     const PixelColumns& columns = {});

    /// Draws it on a disc that dims what is behind it, over a part of the viewport of the
    /// framebuffer that is bound, seen from afar in the directions in which the camera sees the
    /// world.
    void drawInCorner(const Camera& camera, const Mat3d& worldFromLobe,
                      const PictureSquare& square);

  private:
    struct Pass;
    void draw(const Pass& pass);
    void drawSurface(const Pass& pass);
    void makeTriangles(int segmentCount);

    GlName program_;
    ScreenPass overlayPass_;
    int segmentCount_ = 0;
    Mesh sphere_;  ///< of so many segments
    GlName vertices_;
    GlName indices_;
    GlName layout_;
    Vec3f negativeColor_{0.0f, 0.0f, 0.0f};
    float longestEdge_ = 0.0f;          ///< of its triangles
    std::optional<GpuTarget> overlay_;  ///< at least as large as what has been drawn
};

}  // namespace prt
