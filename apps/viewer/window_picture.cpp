#include "apps/viewer/window_picture.h"

#include <algorithm>

#include <epoxy/gl.h>
#include <fmt/format.h>

namespace prt::viewer {

Rgba8Image readWindow(int width, int height) {
    Rgba8Image image(width, height);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, image.pixels.data());
    for (int y = 0; y < height / 2; ++y) {  // OpenGL's lowest row comes first
        Rgba8* upper = &image.at(0, y);
        std::swap_ranges(upper, upper + width, &image.at(0, height - 1 - y));
    }
    for (Rgba8& pixel : image.pixels)
        pixel.alpha = 255;
    return image;
}

std::filesystem::path nextScreenshot(const std::filesystem::path& folder) {
    for (int number = 1;; ++number) {
        const std::string stem = fmt::format("prt_{:03}", number);
        if (!std::filesystem::exists(folder / (stem + ".png")) &&
            !std::filesystem::exists(folder / (stem + ".exr")))
            return folder / stem;
    }
}

}  // namespace prt::viewer
