// Matrices know nothing of the receiver's material: one bake shows a teapot of Lambert's law, of
// Phong's, of microfacets and of a measured table, to an eye that moves while the light stays.
//
//   06_any_material OUT.png

#include <cstdio>
#include <memory>
#include <vector>

#include "prt/base/error.h"
#include "prt/brdf/tabulate_brdf.h"
#include "prt/compress/compress_transfer.h"
#include "prt/image/tone_curve.h"
#include "prt/io/image_io.h"
#include "prt/light/analytic_lights.h"
#include "prt/relight/glossy_relighter.h"
#include "prt/render/render_view.h"
#include "prt/scene/framing.h"
#include "prt/scene/procedural.h"
#include "prt/trace/ray_scene.h"
#include "prt/transport/bake.h"

namespace {

constexpr int kBandCount = 5;
constexpr int kViewWidth = 240;
constexpr int kViewHeight = 160;

/// All that a picture needs of a bake.
struct BakedScene {
    prt::Scene scene = prt::makeProceduralScene("teapot");
    prt::RayScene rays{scene};
    prt::CompressedTransfer transfer = prt::compressTransfer(
        prt::bakeTransfer(scene, {.transport = prt::Transport::glossyShadowed, .sampleCount = 512}),
        {.encoding = prt::TransferEncoding::unorm16});
    prt::GltfViewTable glossyMaterials{{.bandCount = kBandCount}};
};

/// A relighter of the scene with its teapot, the first material, made of something else.
prt::GlossyRelighter makeRelighter(const BakedScene& baked, const prt::Brdf& brdf) {
    prt::GlossyRelightOptions options;
    options.materialTables.resize(baked.scene.materials.size());
    options.materialTables[0] =
        std::make_shared<prt::BrdfViewTable>(brdf, prt::BrdfViewTableOptions{kBandCount});
    return {baked.transfer, prt::Transport::glossyShadowed,
            prt::describeReceivers(baked.scene, baked.transfer), baked.glossyMaterials, options};
}

prt::Image drawView(const BakedScene& baked, const std::vector<prt::ExitRadiance>& receivers,
                    const prt::Camera& camera) {
    std::vector<prt::ExitRadiance> vertices;
    for (const std::uint32_t receiver : baked.transfer.receiverOfVertex)
        vertices.push_back(receivers[receiver]);
    return prt::renderView(baked.scene, baked.rays, vertices, camera,
                           {.width = kViewWidth, .height = kViewHeight, .samplesPerAxis = 2});
}

void paste(const prt::Image& view, int column, int row, prt::Image& picture) {
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x)
            picture.at(column * kViewWidth + x, row * kViewHeight + y) = view.at(x, y);
}

prt::Image drawMaterials(const BakedScene& baked) {
    const prt::Vec3d gold(0.9, 0.65, 0.3);
    const prt::Brdf microfacets{{prt::GgxLobe{gold, 0.25}}};
    const std::vector<prt::Brdf> brdfs = {
        {{prt::LambertLobe{gold}}},
        {{prt::PhongLobe{gold, 8.0}}},
        microfacets,
        {{prt::MeasuredLobe{std::make_shared<prt::MeasuredBrdf>(prt::tabulateBrdf(microfacets))}}}};
    const prt::Lighting light =
        prt::add(prt::sunLighting(prt::Vec3d(-0.5, 0.7, 0.5).normalized(), 0.5, kBandCount),
                 prt::uniformLighting(prt::Vec3d(0.1, 0.12, 0.15), kBandCount));

    prt::Image picture(kViewWidth * static_cast<int>(brdfs.size()), 2 * kViewHeight);
    for (std::size_t column = 0; column < brdfs.size(); ++column) {
        const prt::GlossyRelighter relighter = makeRelighter(baked, brdfs[column]);
        std::vector<float> incident(relighter.receiverCount() * relighter.incidentSize());
        relighter.receive(light, 0, incident);  // once for all views
        std::vector<prt::ExitRadiance> exit(relighter.receiverCount());
        for (const int row : {0, 1}) {
            const prt::Vec3f eye(row == 0 ? -1.5f : 1.5f, 1.6f, 3.6f);
            relighter.reflect(eye, 0, incident, exit);
            const prt::Camera camera = prt::lookAt(eye, prt::Vec3f(0.0f, 0.5f, 0.0f), 0.42f);
            paste(drawView(baked, exit, camera), static_cast<int>(column), row, picture);
        }
    }
    return picture;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return std::fprintf(stderr, "usage: %s OUT.png\n", argv[0]), 2;
    try {
        const BakedScene baked;
        prt::writePng(argv[1],
                      prt::encodeForDisplay(drawMaterials(baked), {.exposureStops = 1.5f}));
        return 0;
    } catch (const prt::Error& error) {
        std::fprintf(stderr, "%s\n", error.message().c_str());
        return 1;
    }
}
