// Bibliography
//   [Kautz02]  Fast, arbitrary BRDF shading for low-frequency lighting using spherical harmonics
//   [Sloan02]  Precomputed radiance transfer: matrices take light to incident radiance
#include "prt/relight/glossy_relighter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "prt/base/assert.h"
#include "prt/base/error.h"
#include "prt/basis/sh.h"
#include "prt/basis/zonal.h"
#include "prt/math/frame.h"

namespace prt {
namespace {

const CompressedLayer& requireLayer(const CompressedTransfer& transfer, Transport transport) {
    if (const CompressedLayer* layer = transfer.findLayer(transport)) return *layer;
    std::string available;
    for (const CompressedLayer& layer : transfer.layers)
        available +=
            (available.empty() ? "it has " : ", ") + std::string(transportName(layer.transport));
    throw Error(ErrorCode::invalidOption,
                "the asset holds no " + std::string(transportName(transport)) + " transfer", {},
                available);
}

/// The matrices of a layer, decoded.
struct Matrices {
    std::size_t channelCount = 0;
    std::size_t rowCount = 0;     ///< n_in²
    std::size_t columnCount = 0;  ///< n²
    std::vector<float> values{};  ///< [receiver][channel][i][j]

    Matrices() = default;
    Matrices(const CompressedTransfer& transfer, const CompressedLayer& layer)
        : channelCount(static_cast<std::size_t>(layer.channelCount)),
          rowCount(static_cast<std::size_t>(shCoefficientCount(layer.incidentBandCount))),
          columnCount(static_cast<std::size_t>(shCoefficientCount(transfer.bandCount))),
          values(expandLayer(layer)) {}

    std::span<const float> row(std::size_t receiver, std::size_t color, std::size_t i) const {
        const std::size_t channel = channelCount == 3 ? color : 0;
        return std::span(values).subspan(
            ((receiver * channelCount + channel) * rowCount + i) * columnCount, columnCount);
    }

    double multiply(std::size_t receiver, std::size_t color, std::size_t i,
                    const Lighting& lighting) const {
        const std::span<const float> matrixRow = row(receiver, color, i);
        double sum = 0.0;
        for (std::size_t j = 0; j < lighting.coefficients.size(); ++j)
            sum += static_cast<double>(matrixRow[j]) *
                   lighting.coefficients[j][static_cast<int>(color)];
        return sum;
    }
};

double dot(std::span<const float> a, std::span<const float> b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += static_cast<double>(a[i]) * static_cast<double>(b[i]);
    return sum;
}

}  // namespace

struct GlossyRelighter::State {
    int bandCount = 0;
    int incidentBandCount = 0;
    std::vector<ReceiverSurface> receivers;
    std::shared_ptr<const GltfViewTable> views;
    Matrices matrices;
    Matrices visibility;  ///< empty unless some receiver is split
    double leastRoughness = 0.0;
    bool isVisibilityAlone = false;

    bool isSplit(std::size_t receiver) const {
        return !visibility.values.empty() &&
               static_cast<double>(receivers[receiver].surface.roughness) < leastRoughness;
    }

    /// f_i of an albedo-free lobe: [i].
    std::vector<float> response(float baseColor, const MetallicRoughness& surface,
                                const Vec3f& view) const {
        std::vector<float> channels(3 * matrices.rowCount, 0.0f);
        views->addResponse(Vec3f(baseColor), surface, view, channels);
        channels.resize(matrices.rowCount);
        return channels;
    }

    float mirrorVisibility(std::size_t receiver, std::span<const float> bright) const {
        const std::vector<double> open = capZonal(incidentBandCount, 0.5 * std::numbers::pi);
        double seen = 0.0;
        double unshadowed = 0.0;
        for (std::size_t i = 0; i < bright.size(); ++i)
            seen += static_cast<double>(bright[i]) *
                    static_cast<double>(visibility.row(receiver, 0, i)[0]) *
                    std::sqrt(4.0 * std::numbers::pi);
        for (int l = 0; l < incidentBandCount; ++l)
            unshadowed += static_cast<double>(bright[static_cast<std::size_t>(shIndex(l, 0))]) *
                          open[static_cast<std::size_t>(l)];
        if (!(unshadowed > 0.0)) return 0.0f;
        return static_cast<float>(std::clamp(seen / unshadowed, 0.0, 1.0));
    }
};

GlossyRelighter::GlossyRelighter(const CompressedTransfer& transfer, Transport transport,
                                 std::vector<ReceiverSurface> receivers,
                                 std::shared_ptr<const GltfViewTable> views,
                                 const GlossyRelightOptions& options)
    : state_(std::make_unique<State>()) {
    const CompressedLayer& layer = requireLayer(transfer, transport);
    PRT_ASSERT(isGlossy(transport), "the layer is of matrices");
    PRT_ASSERT(isComplete(transfer, layer), "transfer for each receiver");
    PRT_ASSERT(receivers.size() == transfer.receiverCount, "one surface a receiver");
    PRT_ASSERT(views && views->bandCount() == layer.incidentBandCount,
               "views for the bands of incident radiance");
    state_->bandCount = transfer.bandCount;
    state_->incidentBandCount = layer.incidentBandCount;
    state_->receivers = std::move(receivers);
    state_->views = std::move(views);
    state_->matrices = Matrices(transfer, layer);
    state_->leastRoughness = options.leastRoughness;
    state_->isVisibilityAlone = transport == Transport::glossyShadowed;
    const CompressedLayer* visibility = transfer.findLayer(Transport::glossyShadowed);
    if (visibility && options.leastRoughness > 0.0)
        state_->visibility = Matrices(transfer, *visibility);
}

GlossyRelighter::~GlossyRelighter() = default;
GlossyRelighter::GlossyRelighter(GlossyRelighter&&) noexcept = default;
GlossyRelighter& GlossyRelighter::operator=(GlossyRelighter&&) noexcept = default;

std::size_t GlossyRelighter::receiverCount() const {
    return state_->receivers.size();
}

int GlossyRelighter::bandCount() const {
    return state_->bandCount;
}

int GlossyRelighter::incidentBandCount() const {
    return state_->incidentBandCount;
}

std::size_t GlossyRelighter::transferBytes() const {
    return std::span(state_->matrices.values).size_bytes();
}

std::size_t GlossyRelighter::incidentSize() const {
    return 6 * state_->matrices.rowCount;
}

void GlossyRelighter::receive(const Lighting& lighting, std::size_t begin,
                              std::span<float> incident) const {
    PRT_ASSERT(lighting.bandCount <= bandCount(), "light has no more bands than transfer");
    const std::size_t rowCount = state_->matrices.rowCount;
    for (std::size_t at = 0; at < incident.size(); at += incidentSize()) {
        const std::size_t receiver = begin + at / incidentSize();
        for (std::size_t color = 0; color < 3; ++color)
            for (std::size_t i = 0; i < rowCount; ++i) {
                const double all = state_->matrices.multiply(receiver, color, i, lighting);
                double bounced = all;
                if (state_->isSplit(receiver))
                    bounced = state_->isVisibilityAlone
                                  ? 0.0
                                  : all - state_->visibility.multiply(receiver, color, i, lighting);
                incident[at + color * rowCount + i] = static_cast<float>(all);
                incident[at + (3 + color) * rowCount + i] = static_cast<float>(bounced);
            }
    }
}

void GlossyRelighter::reflect(const Vec3f& eye, std::size_t begin, std::span<const float> incident,
                              std::span<ExitRadiance> radiance) const {
    PRT_ASSERT(incident.size() == radiance.size() * incidentSize(), "incident radiance of all");
    const std::size_t rowCount = state_->matrices.rowCount;
    for (std::size_t r = 0; r < radiance.size(); ++r) {
        const ReceiverSurface& receiver = state_->receivers[begin + r];
        const float roughness = receiver.surface.roughness;
        const float metallic = receiver.surface.metallic;
        const Vec3f view =
            frameFromNormal(receiver.normal).localFromWorld((eye - receiver.position).normalized());
        const auto dark = state_->response(0.0f, {1.0f, roughness}, view);
        const auto bright = state_->response(1.0f, {1.0f, roughness}, view);
        const auto layered = state_->response(1.0f, {0.0f, roughness}, view);
        const auto coat = state_->response(0.0f, {0.0f, roughness}, view);
        ExitRadiance& exit = radiance[r];
        for (std::size_t color = 0; color < 3; ++color) {
            const auto all = incident.subspan(r * incidentSize() + color * rowCount, rowCount);
            const auto bounced =
                incident.subspan(r * incidentSize() + (3 + color) * rowCount, rowCount);
            const double diffuse = dot(layered, all) - dot(coat, all);
            const double darkPart = dot(dark, bounced);
            const double range = dot(bright, bounced) - darkPart;
            const auto m = static_cast<double>(metallic);
            exit.perBaseColor[static_cast<int>(color)] =
                static_cast<float>((1.0 - m) * diffuse + m * range);
            exit.constant[static_cast<int>(color)] =
                static_cast<float>(darkPart + 0.04 * (1.0 - m) * range);
        }
        exit.mirrorVisibility =
            state_->isSplit(begin + r) ? state_->mirrorVisibility(begin + r, bright) : 0.0f;
    }
}

void GlossyRelighter::relight(const Lighting& lighting, const Vec3f& eye, std::size_t begin,
                              std::span<ExitRadiance> radiance) const {
    std::vector<float> incident(radiance.size() * incidentSize());
    receive(lighting, begin, incident);
    reflect(eye, begin, incident, radiance);
}

}  // namespace prt
