#include "apps/viewer/desk.h"

#include <algorithm>
#include <array>

namespace prt::viewer {

Choices findChoices(const Stage& stage, std::size_t objectCount) {
    using cli::ShownTransport;
    constexpr std::array kAll = {ShownTransport::unshadowed,     ShownTransport::shadowed,
                                 ShownTransport::interreflected, ShownTransport::glossyUnshadowed,
                                 ShownTransport::glossyShadowed, ShownTransport::glossy};
    std::vector<std::shared_ptr<const Asset>> assets;
    const std::size_t known = std::min(objectCount, stage.objects().statuses().size());
    for (std::size_t i = 0; i < known; ++i)
        if (auto asset = stage.objects().asset(i)) assets.push_back(std::move(asset));
    if (assets.empty()) return {};

    Choices choices{.bandCount = 1};
    for (const auto& asset : assets)
        choices.bandCount = std::max(choices.bandCount, asset->transfer.bandCount);
    std::ranges::copy_if(kAll, std::back_inserter(choices.transports), [&](ShownTransport shown) {
        return std::ranges::any_of(
            assets, [&](const auto& asset) { return cli::isAvailable(asset->transfer, shown); });
    });
    return choices;
}

}  // namespace prt::viewer
