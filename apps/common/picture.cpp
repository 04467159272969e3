#include "apps/common/picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/common/parse.h"
#include "prt/io/image_io.h"
#include "prt/light/environment.h"
#include "prt/light/irradiance.h"

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

float chooseExposure(const Lighting& lighting) {
    constexpr double kBrightest = 0.8;
    double brightest = 0.0;
    const Lighting lowest = truncate(lighting, std::min(3, lighting.bandCount));
    const Image irradiance = reconstructLatLong(convolveWithCosine(lowest), 64);
    for (const Vec3f& value : irradiance.pixels)
        brightest = std::max(brightest, luminance(Vec3d(value)) * std::numbers::inv_pi);
    return brightest > 0.0 ? static_cast<float>(std::log2(kBrightest / brightest)) : 0.0f;
}

}  // namespace prt::cli
