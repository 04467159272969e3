#pragma once

#include <limits>

#include "prt/gpu/gl_name.h"
#include "prt/image/image.h"

namespace prt {

/// How many numbers a channel of a picture can hold.
enum class TargetFormat {
    linearFloat,  ///< 32-bit floats
    codeValues,   ///< 8 bits
};

/// Columns of a picture from the left: first to before end, as far as the picture has them.
struct PixelColumns {
    int first = 0;
    int end = std::numeric_limits<int>::max();
};

/// A picture in the memory of the graphics card, to be drawn to, read back and shown.
class GpuTarget {
  public:
    /// @param sampleCount  a pixel; the driver may take more
    /// @throws Error       invalidOption for a size or sample count beyond the driver's,
    ///                     unsupported if it does not draw so, outOfMemory
    GpuTarget(int width, int height, int sampleCount = 1,
              TargetFormat format = TargetFormat::linearFloat);

    int width() const { return width_; }
    int height() const { return height_; }

    /// What is drawn from here on comes to these columns, in place of all that was there. The
    /// viewport is that of the whole picture.
    ///
    /// @param isCovered  whether each pixel of them will be drawn, so that none need be black
    void beginDrawing(const PixelColumns& columns = {}, bool isCovered = false) const;
    /// Makes one value of the samples of each pixel: before it is read or shown.
    void finishDrawing(const PixelColumns& columns = {}) const;

    /// Puts a picture of floats made on the CPU there: these columns of it, as they are of the same
    /// size, and else by the texel that is nearest to each pixel's middle.
    ///
    /// @param radiance  at least one pixel
    void writeRadiance(const Image& radiance, const PixelColumns& columns = {});

    /// Of floats.
    Image readRadiance() const;
    /// Of code values.
    Rgba8Image readCodeValues() const;

    /// Takes the depth of one sample of each pixel for the pixel's: before depthTexture() is read.
    /// Leaves this picture's framebuffers bound.
    void resolveDepth(const PixelColumns& columns = {}) const;

    /// OpenGL's names of the textures that hold the picture and its depths, the lowest row first.
    unsigned texture() const { return single_.color.get(); }
    unsigned depthTexture() const { return single_.depth.get(); }

  private:
    struct Layers {
        GlName color;
        GlName depth;
        GlName framebuffer;
    };
    Layers makeSingle() const;
    Layers makeMultisampled(int sampleCount) const;
    void resolve(const PixelColumns& columns, unsigned buffers) const;

    int width_;
    int height_;
    unsigned glFormat_;
    Layers single_;
    Layers multisampled_;  ///< empty where a pixel has one sample
};

}  // namespace prt
