#include "apps/common/surface_tables.h"

#include "prt/brdf/band_limit.h"

namespace prt::cli {

const GltfViewTable& SurfaceTables::views(int bandCount) {
    const auto known = views_.find(bandCount);
    if (known != views_.end()) return known->second;
    return views_.emplace(bandCount, GltfViewTable({.bandCount = bandCount})).first->second;
}

double SurfaceTables::leastRoughness(int bandCount) {
    const auto known = leastRoughnesses_.find(bandCount);
    if (known != leastRoughnesses_.end()) return known->second;
    return leastRoughnesses_.emplace(bandCount, leastRoughnessHeld(bandCount)).first->second;
}

}  // namespace prt::cli
