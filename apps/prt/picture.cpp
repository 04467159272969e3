#include "apps/prt/picture.h"

#include "apps/prt/arguments.h"
#include "prt/io/image_io.h"

namespace prt::cli {

bool isExr(const std::string& path) {
    return lowerSuffix(path) == ".exr";
}

void writePicture(const std::string& path, const Image& radiance, const DisplayOptions& display) {
    if (isExr(path))
        writeExr(path, radiance);
    else
        writePng(path, encodeForDisplay(radiance, display));
}

}  // namespace prt::cli
