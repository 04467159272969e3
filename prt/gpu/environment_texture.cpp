#include "prt/gpu/environment_texture.h"

#include <epoxy/gl.h>

#include "prt/base/assert.h"
#include "prt/gpu/gl_objects.h"

namespace prt {

GlName uploadLatLong(const Environment& environment) {
    PRT_ASSERT(environment.map == SphereMap::latLong, "a lat-long map");
    const Image& image = environment.radiance;
    requireTextureSize(image.width, image.height, "the environment",
                       "make it smaller with prt light");
    GlName texture = makeTexture(GL_TEXTURE_2D);
    // Of four channels, since texels of a power of two of bytes are faster to find.
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, image.width, image.height);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, image.width, image.height, GL_RGB, GL_FLOAT,
                    image.pixels.data());
    checkGpuMemory("the environment");
    return texture;
}

}  // namespace prt
