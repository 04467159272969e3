// Bibliography
//   [Karis13]  Real shading in Unreal Engine 4
#include "prt/gpu/gpu_mirrors.h"

#include <array>

#include <epoxy/gl.h>

#include "prt/base/assert.h"
#include "prt/gpu/environment_texture.h"
#include "prt/gpu/gl_objects.h"
#include "prt/gpu/shader_interface.h"

namespace prt {
namespace {

/// All but that of roughness 0, as layers.
GlName uploadMirrors(const std::vector<Environment>& mirrors) {
    const Image& first = mirrors[1].radiance;
    GlName texture = makeTexture(GL_TEXTURE_2D_ARRAY);
    glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, GL_RGB32F, first.width, first.height,
                   static_cast<GLsizei>(mirrors.size() - 1));
    for (std::size_t level = 1; level < mirrors.size(); ++level) {
        const auto& [map, image] = mirrors[level];
        PRT_ASSERT(map == SphereMap::verticalStrip && image.width == first.width,
                   "mirrors as prefiltering makes them");
        glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, static_cast<GLint>(level - 1), image.width,
                        image.height, 1, GL_RGB, GL_FLOAT, image.pixels.data());
    }
    checkGpuMemory("mirrors");
    return texture;
}

GlName uploadAlbedos(const SpecularAlbedoTable& albedos) {
    const auto width = static_cast<GLsizei>(albedos.viewCount());
    const auto height = static_cast<GLsizei>(albedos.entries().size()) / width;
    GlName texture = makeTexture(GL_TEXTURE_2D);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_RG32F, width, height);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RG, GL_FLOAT,
                    albedos.entries().data());
    checkGpuMemory("mirrors");
    return texture;
}

}  // namespace

GpuMirrors::GpuMirrors(const MirrorEnvironment& environment)
    : roughnesses_(environment.roughnesses.begin(), environment.roughnesses.end()),
      worldFromEnvironment_(environment.worldFromEnvironment),
      environment_(uploadLatLong(environment.mirrors.front())),
      mirrors_(uploadMirrors(environment.mirrors)),
      specularAlbedos_(uploadAlbedos(environment.albedos)),
      environmentSampler_(makeSampler(GL_REPEAT, GL_CLAMP_TO_EDGE, GL_LINEAR)),
      sampler_(makeSampler(GL_REPEAT, GL_CLAMP_TO_EDGE, GL_NEAREST)) {
    PRT_ASSERT(roughnesses_.size() <= uniforms::kMostRoughnesses, "no more than the shader takes");
}

void GpuMirrors::use(const Mat3d& worldFromObject) const {
    const Mat3d turned = worldFromEnvironment_.transposed() * worldFromObject;
    std::array<float, 9> columns{};
    for (int i = 0; i < 9; ++i)
        columns[static_cast<std::size_t>(i)] = static_cast<float>(turned[i % 3][i / 3]);
    glUniformMatrix3fv(uniforms::kEnvironmentFromObject, 1, GL_FALSE, columns.data());
    glUniform1i(uniforms::kLevelCount, static_cast<GLint>(roughnesses_.size()));
    glUniform1fv(uniforms::kRoughnesses, static_cast<GLsizei>(roughnesses_.size()),
                 roughnesses_.data());
    const auto bind = [](unsigned unit, GLenum target, const GlName& texture,
                         const GlName& sampler) {
        glActiveTexture(GL_TEXTURE0 + unit);
        glBindTexture(target, texture.get());
        glBindSampler(unit, sampler.get());
    };
    bind(textures::kEnvironment, GL_TEXTURE_2D, environment_, environmentSampler_);
    bind(textures::kMirrors, GL_TEXTURE_2D_ARRAY, mirrors_, sampler_);
    bind(textures::kSpecularAlbedos, GL_TEXTURE_2D, specularAlbedos_, sampler_);
}

}  // namespace prt
