#include "prt/gpu/environment_texture.h"

#include <string>

#include <epoxy/gl.h>

#include "prt/base/assert.h"
#include "prt/base/error.h"
#include "prt/gpu/gl_objects.h"

namespace prt {

GlName uploadLatLong(const Environment& environment) {
    PRT_ASSERT(environment.map == SphereMap::latLong, "a lat-long map");
    const Image& image = environment.radiance;
    GLint mostTexels = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &mostTexels);
    if (image.width > mostTexels || image.height > mostTexels)
        throw Error(ErrorCode::limitExceeded,
                    "the environment is " + std::to_string(image.width) + " × " +
                        std::to_string(image.height) +
                        " texels, and the graphics driver takes no more than " +
                        std::to_string(mostTexels) + " along a side",
                    {}, "make it smaller with prt light");
    unsigned name = 0;
    glGenTextures(1, &name);
    GlName texture(name, [](unsigned given) { glDeleteTextures(1, &given); });
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, name);
    // Of four channels, since texels of a power of two of bytes are faster to find.
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, image.width, image.height);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, image.width, image.height, GL_RGB, GL_FLOAT,
                    image.pixels.data());
    checkGpuMemory("the environment");
    return texture;
}

}  // namespace prt
