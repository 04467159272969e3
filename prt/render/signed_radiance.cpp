#include "prt/render/signed_radiance.h"

#include <algorithm>
#include <cmath>

#include "prt/image/false_color.h"
#include "prt/image/tone_curve.h"

namespace prt {

std::vector<ExitRadiance> showSignedRadiance(std::span<const ExitRadiance> vertexRadiance) {
    std::vector<float> values;
    float largest = 0.0f;
    for (const ExitRadiance& radiance : vertexRadiance) {
        values.push_back(luminance(radiance.perBaseColor + radiance.constant));
        largest = std::max(largest, std::abs(values.back()));
    }
    std::vector<ExitRadiance> shown(values.size());
    if (!(largest > 0.0f)) return shown;
    for (std::size_t i = 0; i < shown.size(); ++i)
        shown[i].constant =
            findFalseRadiance(values[i] / largest, -1.0f, 1.0f, signedColorsOnBlack());
    return shown;
}

}  // namespace prt
