#include "prt/gpu/gpu_glossy_relighter.h"

#include <cmath>
#include <numbers>
#include <optional>

#include "prt/base/assert.h"
#include "prt/gpu/gpu_lobes.h"
#include "prt/gpu/gpu_matrices.h"
#include "prt/gpu/gpu_vertex_radiance.h"
#include "prt/relight/require_layer.h"

namespace prt {
namespace {

const CompressedLayer& requireMatrices(const CompressedTransfer& transfer, Transport transport) {
    PRT_ASSERT(isGlossy(transport), "the layer is of matrices");
    const CompressedLayer& layer = requireLayer(transfer, transport);
    PRT_ASSERT(isComplete(transfer, layer), "transfer for each receiver");
    return layer;
}

/// Radiance 1 from everywhere.
Lighting makeWhiteLight() {
    Lighting lighting(1);
    lighting.coefficients[0] = Vec3d(std::sqrt(4.0 * std::numbers::pi));
    return lighting;
}

}  // namespace

struct GpuGlossyRelighter::Content {
    int bandCount = 0;
    GpuLobes lobes;
    GpuMatrices matrices;
    std::optional<GpuMatrices> visibility;  ///< where bounced light must be told from direct light
    GlName incident;
    GlName arriving;
    GlName direct;
    GpuVertexRadiance radiance;

    Content(const CompressedTransfer& transfer, const CompressedLayer& layer,
            std::span<const ReceiverSurface> receivers, const GltfViewTable& views,
            const GlossyRelightOptions& options, const LobeSplit& split,
            const SharedGpuPrograms& programs)
        : bandCount(transfer.bandCount),
          lobes(transfer, receivers, views, options.materialTables, split, programs),
          matrices(transfer, layer, programs),
          incident(matrices.makeIncident()),
          radiance(transfer.receiverOfVertex.size(), programs) {
        PRT_ASSERT(receivers.size() == transfer.receiverCount, "one surface a receiver");
        PRT_ASSERT(views.bandCount() == layer.incidentBandCount,
                   "views for the bands of incident radiance");
        if (lobes.hasBounced()) {
            visibility.emplace(transfer, *split.visibility, programs);
            direct = visibility->makeIncident();
        }
        if (lobes.hasSplit()) {
            arriving = matrices.makeIncident();
            (visibility ? *visibility : matrices).receive(makeWhiteLight(), arriving);
        }
    }

    void relight(const Lighting& lighting) const {
        matrices.receive(lighting, incident);
        if (visibility) visibility->receive(lighting, direct);
    }
};

GpuGlossyRelighter::GpuGlossyRelighter(const CompressedTransfer& transfer, Transport transport,
                                       std::span<const ReceiverSurface> receivers,
                                       const GltfViewTable& views,
                                       const GlossyRelightOptions& options,
                                       SharedGpuPrograms programs) {
    const CompressedLayer& layer = requireMatrices(transfer, transport);
    if (!programs) programs = std::make_shared<GpuPrograms>();
    content_ =
        std::make_unique<Content>(transfer, layer, receivers, views, options,
                                  chooseSplit(transfer, layer, options.leastRoughness), programs);
    relight(Lighting(1));
}

GpuGlossyRelighter::~GpuGlossyRelighter() = default;
GpuGlossyRelighter::GpuGlossyRelighter(GpuGlossyRelighter&&) noexcept = default;
GpuGlossyRelighter& GpuGlossyRelighter::operator=(GpuGlossyRelighter&&) noexcept = default;

std::size_t GpuGlossyRelighter::vertexCount() const {
    return content_->radiance.vertexCount();
}

int GpuGlossyRelighter::bandCount() const {
    return content_->bandCount;
}

void GpuGlossyRelighter::relight(const Lighting& lighting) {
    content_->relight(lighting);
}

void GpuGlossyRelighter::lookFrom(const Vec3f& eye) {
    content_->lobes.reflect(eye, {content_->incident, content_->arriving, content_->direct},
                            content_->radiance.buffer(content_->lobes.hasSplit()));
}

void GpuGlossyRelighter::use(const SurfaceFeatures& features) const {
    content_->radiance.use(features);
}

bool GpuGlossyRelighter::hasMirrors() const {
    return content_->radiance.hasMirrors();
}

std::vector<ExitRadiance> GpuGlossyRelighter::read() const {
    return content_->radiance.read();
}

}  // namespace prt
