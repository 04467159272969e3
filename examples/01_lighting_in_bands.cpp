// How much of an environment survives in n bands: a disc light as 1, 2, 3, 5 and 10 bands hold it,
// one above the other.
//
//   01_lighting_in_bands OUT.png

#include <cstdio>

#include "prt/base/error.h"
#include "prt/image/tone_curve.h"
#include "prt/io/image_io.h"
#include "prt/light/analytic_lights.h"
#include "prt/light/environment.h"

int main(int argc, char** argv) {
    if (argc != 2) return std::fprintf(stderr, "usage: %s OUT.png\n", argv[0]), 2;
    try {
        // A warm disc of 40° half angle, low in the sky.
        const prt::Vec3d direction = prt::Vec3d(1.0, 0.6, 0.3).normalized();
        const prt::Lighting lighting =
            prt::discLighting(direction, 0.7, prt::Vec3d(2.0, 1.5, 1.0), 10);

        constexpr int kWidth = 512;
        constexpr int kHeight = kWidth / 2;
        prt::Image picture(kWidth, 0);
        for (const int bandCount : {1, 2, 3, 5, 10}) {
            const prt::Image strip =
                prt::reconstructLatLong(prt::truncate(lighting, bandCount), kWidth);
            picture.pixels.insert(picture.pixels.end(), strip.pixels.begin(), strip.pixels.end());
            picture.height += kHeight;
        }
        prt::writePng(argv[1], prt::encodeForDisplay(picture));
        return 0;
    } catch (const prt::Error& error) {
        std::fprintf(stderr, "%s\n", error.message().c_str());
        return 1;
    }
}
