// The whole pipeline without a file: bake the teapot once, and relight
// it by a sun that goes round it.
//
//   02_bake_and_relight OUT.png

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "prt/base/error.h"
#include "prt/compress/compress_transfer.h"
#include "prt/image/tone_curve.h"
#include "prt/io/image_io.h"
#include "prt/light/analytic_lights.h"
#include "prt/relight/relighter.h"
#include "prt/render/render_view.h"
#include "prt/scene/procedural.h"
#include "prt/trace/ray_scene.h"
#include "prt/transport/bake.h"

int main(int argc, char** argv) {
    if (argc != 2) return std::fprintf(stderr, "usage: %s OUT.png\n", argv[0]), 2;
    try {
        // Bake once.
        const prt::Scene scene = prt::makeProceduralScene("teapot");
        const prt::TransferField transfer =
            prt::bakeTransfer(scene, {.sampleCount = 128, .bounceCount = 2});
        const prt::Relighter relighter(prt::compressTransfer(transfer),
                                       prt::Transport::interreflected);

        // Relight for each direction of the sun, and put the pictures one above the other.
        const prt::RayScene rays(scene);
        std::vector<prt::Vec3f> receiverRadiance(relighter.receiverCount());
        std::vector<prt::Vec3f> vertexRadiance(scene.vertexCount());
        prt::Image picture(320, 0);
        for (const double azimuth : {0.25, 0.75, 1.25}) {
            const double angle = azimuth * std::numbers::pi;
            const prt::Vec3d sun = prt::Vec3d(std::cos(angle), 1.0, std::sin(angle)).normalized();
            relighter.relight(prt::sunLighting(sun, 0.2, 5), receiverRadiance);
            for (std::size_t vertex = 0; vertex < vertexRadiance.size(); ++vertex)
                vertexRadiance[vertex] = receiverRadiance[transfer.receiverOfVertex[vertex]];

            const prt::Image view =
                prt::renderView(scene, rays, vertexRadiance, scene.cameras.front(),
                                {.width = 320, .height = 200, .samplesPerAxis = 2});
            picture.pixels.insert(picture.pixels.end(), view.pixels.begin(), view.pixels.end());
            picture.height += view.height;
        }
        prt::writePng(argv[1], prt::encodeForDisplay(picture, {.exposureStops = 1.0f}));
        return 0;
    } catch (const prt::Error& error) {
        std::fprintf(stderr, "%s\n", error.message().c_str());
        return 1;
    }
}
