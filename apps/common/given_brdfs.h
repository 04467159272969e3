#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "prt/brdf/brdf.h"
#include "prt/brdf/brdf_view_table.h"

namespace prt::cli {

/// What materials are made of instead of what their file says: one a material, or none at all.
using GivenBrdfs = std::vector<std::optional<Brdf>>;

/// Tables of what each material reflects, of equal BRDFs the same one; null where there is none.
std::vector<std::shared_ptr<const BrdfViewTable>> makeViewTables(
    std::span<const std::optional<Brdf>> brdfs, int incidentBandCount);

}  // namespace prt::cli
