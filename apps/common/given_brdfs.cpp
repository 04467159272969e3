#include "apps/common/given_brdfs.h"

#include <algorithm>

namespace prt::cli {

std::vector<std::shared_ptr<const BrdfViewTable>> makeViewTables(
    std::span<const std::optional<Brdf>> brdfs, int incidentBandCount) {
    std::vector<std::shared_ptr<const BrdfViewTable>> tables;
    for (const std::optional<Brdf>& brdf : brdfs) {
        const auto equal = std::find(brdfs.begin(), brdfs.end(), brdf);
        const auto index = static_cast<std::size_t>(equal - brdfs.begin());
        if (index < tables.size())
            tables.push_back(tables[index]);
        else if (brdf)
            tables.push_back(std::make_shared<const BrdfViewTable>(
                *brdf, BrdfViewTableOptions{.bandCount = incidentBandCount}));
        else
            tables.push_back(nullptr);
    }
    return tables;
}

}  // namespace prt::cli
