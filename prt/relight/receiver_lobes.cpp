#include "prt/relight/receiver_lobes.h"

#include <algorithm>
#include <numbers>

#include "prt/base/assert.h"
#include "prt/basis/sh.h"
#include "prt/basis/zonal.h"
#include "prt/brdf/view_angle.h"
#include "prt/relight/incident_order.h"
#include "prt/relight/matrix_kernel.h"

namespace prt {
namespace {

/// Zeros. @throws Error  outOfMemory
AlignedBytes allocateFloats(std::size_t count) {
    AlignedBytes bytes = allocateAlignedBytes(std::max<std::size_t>(count, 1) * sizeof(float));
    std::fill_n(reinterpret_cast<float*>(bytes.get()), count, 0.0f);
    return bytes;
}

float* floatsOf(const AlignedBytes& bytes) {
    return reinterpret_cast<float*>(bytes.get());
}

/// Writes coefficients of m ≥ 0 in the order of incident radiance.
///
/// @param elementAt  of uprightIndex
template <class ElementAt>
void orderRow(int bandCount, const ElementAt& elementAt, float* row) {
    for (int l = 0; l < bandCount; ++l)
        for (int m = 0; m <= l; ++m)
            row[incidentIndex(bandCount, l, m)] = elementAt(uprightIndex(l, m));
}

}  // namespace

LobeSplit chooseSplit(const CompressedTransfer& transfer, const CompressedLayer& layer,
                      double leastRoughness) {
    const CompressedLayer* visibility = transfer.findLayer(Transport::glossyShadowed);
    if (visibility && visibility->incidentBandCount != layer.incidentBandCount)
        visibility = nullptr;
    return {visibility, leastRoughness, visibility != &layer};
}

bool isSplit(const LobeSplit& split, const ReceiverSurface& receiver) {
    return split.visibility &&
           static_cast<double>(receiver.surface.roughness) < split.leastRoughness;
}

ReceiverLobes::ReceiverLobes(std::span<const ReceiverSurface> receivers, const GltfViewTable& views,
                             std::span<const std::shared_ptr<const BrdfViewTable>> materialTables,
                             const LobeSplit& split)
    : lobes_(receivers.size()), others_(materialTables.size()) {
    view_.bandCount = views.bandCount();
    view_.rowSize = incidentRowSize(view_.bandCount);
    view_.uprightSize = uprightRowSize(view_.bandCount);
    orders_ = allocateFloats(view_.uprightSize);
    auto* const orders = reinterpret_cast<std::int32_t*>(orders_.get());
    for (int l = 0; l < view_.bandCount; ++l)
        for (int m = 0; m <= l; ++m)
            orders[incidentIndex(view_.bandCount, l, m)] = m;
    view_.orders = orders;

    placeReceivers(receivers);
    copyGltfRows(views);
    copyOtherRows(materialTables);
    for (std::size_t r = 0; r < receivers.size(); ++r) {
        const auto& [metallic, roughness] = receivers[r].surface;
        const std::size_t material = receivers[r].material;
        ReceiverLobe& lobe = lobes_[r];
        if (!materialTables.empty() && materialTables[material]) {
            lobe.kind = LobeKind::other;
            lobe.viewCount = static_cast<std::uint32_t>(materialTables[material]->viewCount());
            lobe.rows = floatsOf(others_[material]);
            continue;
        }
        const TablePlace level =
            placeBetween(std::clamp(roughness, 0.0f, 1.0f), views.levelCount());
        lobe.viewCount = static_cast<std::uint32_t>(views.viewCount());
        lobe.rows = floatsOf(specular_) + level.first * views.viewCount() * 2 * view_.uprightSize;
        lobe.levelShare = level.share;
        lobe.metallic = metallic;
    }
    splitLobes(receivers, split);
}

void ReceiverLobes::placeReceivers(std::span<const ReceiverSurface> receivers) {
    constexpr std::size_t kBlock = kReflectBlockSize;
    const std::size_t blockCount = (receivers.size() + kBlock - 1) / kBlock;
    places_ = allocateFloats(blockCount * 6 * kBlock);
    float* const places = floatsOf(places_);
    for (std::size_t r = 0; r < receivers.size(); ++r)
        for (int axis = 0; axis < 3; ++axis) {
            float* const at = places + r / kBlock * 6 * kBlock + r % kBlock +
                              static_cast<std::size_t>(axis) * kBlock;
            at[0] = receivers[r].position[axis];
            at[3 * kBlock] = receivers[r].normal[axis];
        }
    view_.places = places;
}

void ReceiverLobes::copyGltfRows(const GltfViewTable& views) {
    const std::size_t rowSize = view_.uprightSize;
    specular_ = allocateFloats(views.levelCount() * views.viewCount() * 2 * rowSize);
    diffuse_ = allocateFloats(views.viewCount() * rowSize);
    float* specular = floatsOf(specular_);
    for (std::size_t level = 0; level < views.levelCount(); ++level)
        for (std::size_t view = 0; view < views.viewCount(); ++view, specular += 2 * rowSize) {
            const std::span<const GltfViewTable::Element> row = views.row(level, view);
            const auto darkAt = [&](std::size_t i) { return row[i].dark; };
            const auto rangeAt = [&](std::size_t i) { return row[i].bright - row[i].dark; };
            const auto diffuseAt = [&](std::size_t i) { return row[i].diffuse; };
            orderRow(view_.bandCount, darkAt, specular);
            orderRow(view_.bandCount, rangeAt, specular + rowSize);
            orderRow(view_.bandCount, diffuseAt, floatsOf(diffuse_) + view * rowSize);
        }
    view_.diffuse = floatsOf(diffuse_);
}

void ReceiverLobes::copyOtherRows(
    std::span<const std::shared_ptr<const BrdfViewTable>> materialTables) {
    for (std::size_t material = 0; material < materialTables.size(); ++material) {
        if (!materialTables[material]) continue;
        const BrdfViewTable& table = *materialTables[material];
        PRT_ASSERT(table.bandCount() == view_.bandCount, "views for the same bands");
        others_[material] = allocateFloats(table.viewCount() * 3 * view_.uprightSize);
        float* row = floatsOf(others_[material]);
        for (std::size_t view = 0; view < table.viewCount(); ++view)
            for (std::size_t channel = 0; channel < 3; ++channel, row += view_.uprightSize) {
                const std::size_t first = channel * uprightCount(view_.bandCount);
                const auto elementAt = [&](std::size_t i) { return table.row(view)[first + i]; };
                orderRow(view_.bandCount, elementAt, row);
            }
    }
}

void ReceiverLobes::splitLobes(std::span<const ReceiverSurface> receivers, const LobeSplit& split) {
    std::vector<std::size_t> chosen;
    for (std::size_t r = 0; r < receivers.size(); ++r)
        if (lobes_[r].kind == LobeKind::gltf && prt::isSplit(split, receivers[r]))
            chosen.push_back(r);
    view_.hasBounced = split.hasBounced && !chosen.empty();
    view_.incidentSize = (view_.hasBounced ? 6 : 3) * view_.rowSize;

    open_ = allocateFloats(view_.uprightSize);
    const std::vector<double> hemisphere = capZonal(view_.bandCount, 0.5 * std::numbers::pi);
    for (int l = 0; l < view_.bandCount; ++l)
        floatsOf(open_)[incidentIndex(view_.bandCount, l, 0)] =
            static_cast<float>(hemisphere[static_cast<std::size_t>(l)]);
    view_.open = floatsOf(open_);

    // White light has one coefficient, √(4π).
    constexpr float kWhite = 3.5449077018110321f;  // sqrt(4 pi)
    arriving_ = allocateFloats(chosen.size() * view_.rowSize);
    const auto rowCount = static_cast<std::size_t>(shCoefficientCount(view_.bandCount));
    if (chosen.empty()) return;
    const LayerDecoder visibility(*split.visibility);
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        ReceiverLobe& lobe = lobes_[chosen[k]];
        const std::vector<float> matrix = visibility.expand(chosen[k], 1);
        const std::size_t columnCount =
            matrix.size() / rowCount / static_cast<std::size_t>(split.visibility->channelCount);
        float* const arriving = floatsOf(arriving_) + k * view_.rowSize;
        for (int l = 0; l < view_.bandCount; ++l)
            for (int m = -l; m <= l; ++m)
                arriving[incidentIndex(view_.bandCount, l, m)] =
                    kWhite * matrix[static_cast<std::size_t>(shIndex(l, m)) * columnCount];
        lobe.kind = LobeKind::split;
        lobe.arriving = arriving;
    }
}

void ReceiverLobes::reflect(const Vec3f& eye, std::size_t begin, const float* incident,
                            std::span<const std::byte> ahead,
                            std::span<ExitRadiance> radiance) const {
    PRT_ASSERT(begin % kReflectBlockSize == 0 && begin + radiance.size() <= lobes_.size(),
               "receivers that are there, from a block's first on");
    ReflectView view = view_;
    view.places += begin * 6;
    view.lobes = lobes_.data() + begin;
    reflectIncident(view, eye, incident, ahead, radiance);
}

}  // namespace prt
