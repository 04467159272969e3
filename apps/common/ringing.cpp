#include "apps/common/ringing.h"

namespace prt::cli {

Lighting lowerRinging(const Lighting& lighting, const std::string& window,
                      const std::function<std::vector<double>()>& findLeast) {
    if (window == "none") return lighting;
    if (window == "auto") return applyWindow(lighting, findLeast());
    const ShWindow known = window == "hann" ? ShWindow::hann : ShWindow::lanczos;
    return applyWindow(lighting, windowFactors(known, lighting.bandCount));
}

}  // namespace prt::cli
