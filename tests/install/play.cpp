// Relights the asset named on the command line by a white sky, as an engine would.
#include <algorithm>
#include <cstdio>
#include <vector>

#include "prt/asset/asset.h"
#include "prt/base/error.h"
#include "prt/light/analytic_lights.h"
#include "prt/relight/relighter.h"

int main(int argumentCount, char** arguments) {
    if (argumentCount != 2) return 2;
    try {
        const prt::Asset asset = prt::readAsset(arguments[1]);
        const prt::Relighter relighter(asset.transfer, prt::Transport::shadowed);
        const prt::Lighting whiteSky =
            prt::uniformLighting(prt::Vec3d(1.0, 1.0, 1.0), relighter.bandCount());
        std::vector<prt::Vec3f> radiance(relighter.receiverCount());
        relighter.relight(whiteSky, radiance);

        // A point of white sky's radiance sees nothing but sky; a shadow is
        // darker, and no point is brighter.
        const auto byGreen = [](const prt::Vec3f& a, const prt::Vec3f& b) { return a.y < b.y; };
        const auto [darkest, brightest] =
            std::minmax_element(radiance.begin(), radiance.end(), byGreen);
        std::printf("%zu receivers, from %.3f to %.3f\n", radiance.size(), darkest->y,
                    brightest->y);
        return darkest->y >= -0.001f && brightest->y > 0.5f && brightest->y < 1.01f ? 0 : 1;
    } catch (const prt::Error& error) {
        std::fprintf(stderr, "%s\n", error.message().c_str());
        return 1;
    }
}
