#include "prt/gpu/gpu_target.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include <epoxy/gl.h>

#include "prt/base/assert.h"
#include "prt/base/error.h"
#include "prt/gpu/gl_objects.h"

namespace prt {
namespace {

void checkRange(int value, int maximum, const char* what) {
    if (value >= 1 && value <= maximum) return;
    throw Error(ErrorCode::invalidOption, std::string(what) + " is " + std::to_string(value) +
                                              ", not between 1 and " + std::to_string(maximum));
}

int readLimit(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

void checkSize(int width, int height, int sampleCount) {
    std::array<GLint, 2> viewport{};
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
    const int side = std::min(readLimit(GL_MAX_RENDERBUFFER_SIZE), readLimit(GL_MAX_TEXTURE_SIZE));
    checkRange(width, std::min(side, viewport[0]), "the width");
    checkRange(height, std::min(side, viewport[1]), "the height");
    checkRange(sampleCount, readLimit(GL_MAX_SAMPLES), "the number of samples");
}

GlName makeRenderbuffer(GLenum format, int width, int height, int sampleCount) {
    unsigned name = 0;
    glGenRenderbuffers(1, &name);
    GlName buffer(name, [](unsigned given) { glDeleteRenderbuffers(1, &given); });
    glBindRenderbuffer(GL_RENDERBUFFER, name);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, sampleCount, format, width, height);
    return buffer;
}

GlName makeTexture(GLenum format, int width, int height) {
    GlName texture = prt::makeTexture(GL_TEXTURE_2D);
    glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
    return texture;
}

GlName makeFramebuffer() {
    unsigned name = 0;
    glGenFramebuffers(1, &name);
    glBindFramebuffer(GL_FRAMEBUFFER, name);
    return GlName(name, [](unsigned given) { glDeleteFramebuffers(1, &given); });
}

/// Of the framebuffer that is bound.
void checkComplete() {
    checkGpuMemory("the picture");
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw Error(ErrorCode::unsupported,
                    "the graphics driver does not draw to pictures of this format and sample count",
                    {}, "choose fewer samples, or draw on the CPU");
}

/// OpenGL's lowest row comes first, an image's highest.
template <class Pixel>
void flipRows(ImageOf<Pixel>& image) {
    for (int y = 0; y < image.height / 2; ++y) {
        Pixel* upper = &image.at(0, y);
        std::swap_ranges(upper, upper + image.width, &image.at(0, image.height - 1 - y));
    }
}

PixelColumns boundColumns(const PixelColumns& columns, int width) {
    const int first = std::clamp(columns.first, 0, width);
    return {first, std::clamp(columns.end, first, width)};
}

}  // namespace

GpuTarget::GpuTarget(int width, int height, int sampleCount, TargetFormat format)
    : width_(width),
      height_(height),
      glFormat_(format == TargetFormat::linearFloat ? GL_RGBA32F : GL_RGBA8) {
    checkSize(width, height, sampleCount);
    single_ = makeSingle();
    if (sampleCount > 1) multisampled_ = makeMultisampled(sampleCount);
}

GpuTarget::Layers GpuTarget::makeSingle() const {
    Layers layers{.color = makeTexture(glFormat_, width_, height_),
                  .depth = makeTexture(GL_DEPTH_COMPONENT32F, width_, height_),
                  .framebuffer = makeFramebuffer()};
    glFramebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, layers.color.get(), 0);
    glFramebufferTexture(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, layers.depth.get(), 0);
    checkComplete();
    return layers;
}

GpuTarget::Layers GpuTarget::makeMultisampled(int sampleCount) const {
    Layers layers{.color = makeRenderbuffer(glFormat_, width_, height_, sampleCount),
                  .depth = makeRenderbuffer(GL_DEPTH_COMPONENT32F, width_, height_, sampleCount),
                  .framebuffer = makeFramebuffer()};
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                              layers.color.get());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                              layers.depth.get());
    checkComplete();
    return layers;
}

void GpuTarget::beginDrawing(const PixelColumns& columns, bool isCovered) const {
    const PixelColumns drawn = boundColumns(columns, width_);
    const GlName& framebuffer =
        (multisampled_.framebuffer.get() != 0 ? multisampled_ : single_).framebuffer;
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
    glViewport(0, 0, width_, height_);
    glScissor(drawn.first, 0, drawn.end - drawn.first, height_);
    glEnable(GL_SCISSOR_TEST);
    glDepthMask(GL_TRUE);
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    glClear(isCovered ? GL_DEPTH_BUFFER_BIT : GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void GpuTarget::finishDrawing(const PixelColumns& columns) const {
    glDisable(GL_SCISSOR_TEST);
    resolve(columns, GL_COLOR_BUFFER_BIT);
}

void GpuTarget::resolveDepth(const PixelColumns& columns) const {
    resolve(columns, GL_DEPTH_BUFFER_BIT);
}

void GpuTarget::resolve(const PixelColumns& columns, unsigned buffers) const {
    if (multisampled_.framebuffer.get() == 0) return;
    const PixelColumns drawn = boundColumns(columns, width_);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, multisampled_.framebuffer.get());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, single_.framebuffer.get());
    glBlitFramebuffer(drawn.first, 0, drawn.end, height_, drawn.first, 0, drawn.end, height_,
                      buffers, GL_NEAREST);
}

void GpuTarget::writeRadiance(const Image& radiance, const PixelColumns& columns) {
    PRT_ASSERT(!radiance.pixels.empty(), "there is a picture");
    const PixelColumns written = boundColumns(columns, width_);
    Image part(written.end - written.first, height_);
    const auto nearest = [](int pixel, int pixelCount, int texelCount) {
        return static_cast<int>((2 * std::int64_t{pixel} + 1) * texelCount /
                                (2 * std::int64_t{pixelCount}));
    };
    for (int y = 0; y < part.height; ++y) {
        for (int x = 0; x < part.width; ++x)
            part.at(x, y) = radiance.at(nearest(written.first + x, width_, radiance.width),
                                        nearest(y, height_, radiance.height));
    }
    flipRows(part);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, single_.color.get());
    glTexSubImage2D(GL_TEXTURE_2D, 0, written.first, 0, part.width, part.height, GL_RGB, GL_FLOAT,
                    part.pixels.data());
}

Image GpuTarget::readRadiance() const {
    Image image(width_, height_);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, single_.framebuffer.get());
    glReadPixels(0, 0, width_, height_, GL_RGB, GL_FLOAT, image.pixels.data());
    flipRows(image);
    return image;
}

Rgba8Image GpuTarget::readCodeValues() const {
    Rgba8Image image(width_, height_);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, single_.framebuffer.get());
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, image.pixels.data());
    flipRows(image);
    return image;
}

}  // namespace prt
