#include "prt/gpu/gpu_textures.h"

#include <string>

#include <epoxy/gl.h>

#include "prt/gpu/gl_objects.h"

namespace prt {
namespace {

constexpr std::array<GLint, 3> kWraps = {GL_REPEAT, GL_MIRRORED_REPEAT, GL_CLAMP_TO_EDGE};
constexpr std::array<GLint, 2> kFilters = {GL_NEAREST, GL_LINEAR};

std::size_t samplerIndex(std::size_t wrapU, std::size_t wrapV, std::size_t filter) {
    return (wrapU * kWraps.size() + wrapV) * kFilters.size() + filter;
}

/// What stands for white is the quickest to look up.
constexpr TextureUse kWhiteUse{.wrapU = TextureWrap::clampToEdge,
                               .wrapV = TextureWrap::clampToEdge,
                               .filter = TextureFilter::nearest};

/// Texels are decoded before they are blended, as the sRGB formats promise.
GlName uploadImage(const Rgba8Image& image, TexelCurve curve, const std::string& what) {
    requireTextureSize(image.width, image.height, "texture " + what,
                       "make it smaller, or draw on the CPU");
    GlName texture = makeTexture(GL_TEXTURE_2D);
    glTexStorage2D(GL_TEXTURE_2D, 1, curve == TexelCurve::srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8,
                   image.width, image.height);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE,
                    image.pixels.data());
    checkGpuMemory("texture " + what);
    return texture;
}

}  // namespace

GpuTextures::GpuTextures(const Scene& scene)
    : images_(2 * scene.images.size()),
      white_(uploadImage(Rgba8Image(1, 1), TexelCurve::linear, "white")) {
    for (std::size_t u = 0; u < kWraps.size(); ++u) {
        for (std::size_t v = 0; v < kWraps.size(); ++v) {
            for (std::size_t filter = 0; filter < kFilters.size(); ++filter)
                samplers_[samplerIndex(u, v, filter)] =
                    makeSampler(kWraps[u], kWraps[v], kFilters[filter]);
        }
    }
    const auto upload = [&](const std::optional<TextureUse>& use, TexelCurve curve) {
        if (!use || images_[placeOf(use->image, curve)].get() != 0) return;
        const TextureImage& image = scene.images[use->image];
        if (!image.pixels.pixels.empty())
            images_[placeOf(use->image, curve)] = uploadImage(image.pixels, curve, image.name);
    };
    for (const Material& material : scene.materials) {
        upload(material.baseColorTexture, TexelCurve::srgb);
        upload(material.emissiveTexture, TexelCurve::srgb);
        upload(material.metallicRoughnessTexture, TexelCurve::linear);
    }
}

std::size_t GpuTextures::placeOf(std::size_t image, TexelCurve curve) const {
    return image + (curve == TexelCurve::srgb ? 0 : images_.size() / 2);
}

void GpuTextures::bind(unsigned unit, const std::optional<TextureUse>& texture,
                       TexelCurve curve) const {
    const unsigned image = texture ? images_[placeOf(texture->image, curve)].get() : 0;
    const TextureUse use = image != 0 ? *texture : kWhiteUse;
    const std::size_t sampler =
        samplerIndex(static_cast<std::size_t>(use.wrapU), static_cast<std::size_t>(use.wrapV),
                     static_cast<std::size_t>(use.filter));
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(GL_TEXTURE_2D, image != 0 ? image : white_.get());
    glBindSampler(unit, samplers_[sampler].get());
}

}  // namespace prt
