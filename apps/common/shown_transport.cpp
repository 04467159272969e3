#include "apps/common/shown_transport.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace prt::cli {
namespace {

struct Form {
    std::string_view name;
    std::optional<Transport> layer;
};

/// In the order of the enumeration.
constexpr std::array<Form, 6> kForms = {{{"unshadowed", Transport::unshadowed},
                                         {"shadowed", Transport::shadowed},
                                         {"interreflected", Transport::interreflected},
                                         {"glossy-unshadowed", {}},
                                         {"glossy-shadowed", Transport::glossyShadowed},
                                         {"glossy", Transport::glossy}}};

const Form& formOf(ShownTransport shown) {
    return kForms[static_cast<std::size_t>(shown)];
}

bool hasMatrices(const CompressedTransfer& transfer) {
    return std::any_of(transfer.layers.begin(), transfer.layers.end(),
                       [](const CompressedLayer& layer) { return isGlossy(layer.transport); });
}

}  // namespace

std::string_view shownTransportName(ShownTransport shown) {
    return formOf(shown).name;
}

std::optional<ShownTransport> parseShownTransport(std::string_view name) {
    const auto found = std::find_if(kForms.begin(), kForms.end(),
                                    [&](const Form& form) { return form.name == name; });
    if (found == kForms.end()) return std::nullopt;
    return static_cast<ShownTransport>(found - kForms.begin());
}

bool isGlossy(ShownTransport shown) {
    return shown >= ShownTransport::glossyUnshadowed;
}

bool hasBounces(ShownTransport shown) {
    return shown == ShownTransport::interreflected || shown == ShownTransport::glossy;
}

const CompressedLayer* findShownLayer(const CompressedTransfer& transfer, ShownTransport shown) {
    const auto& layer = formOf(shown).layer;
    return layer ? transfer.findLayer(*layer) : nullptr;
}

bool isAvailable(const CompressedTransfer& transfer, ShownTransport shown) {
    if (shown == ShownTransport::unshadowed) return true;
    if (shown == ShownTransport::glossyUnshadowed) return hasMatrices(transfer);
    return findShownLayer(transfer, shown) != nullptr;
}

ShownTransport fullestShown(const CompressedTransfer& transfer) {
    auto shown = ShownTransport::glossy;
    while (shown > ShownTransport::unshadowed && !findShownLayer(transfer, shown))
        shown = static_cast<ShownTransport>(static_cast<int>(shown) - 1);
    return shown;
}

}  // namespace prt::cli
