#pragma once

#include <map>
#include <memory>

#include "prt/brdf/gltf_view_table.h"

namespace prt::cli {

/// What it takes to show surfaces as they are and depends on nothing but bands: made when first
/// asked for, for all assets that share it.
class SurfaceTables {
  public:
    const GltfViewTable& views(int bandCount);
    /// leastRoughnessHeld()
    double leastRoughness(int bandCount);

  private:
    std::map<int, GltfViewTable> views_;
    std::map<int, double> leastRoughnesses_;
};

}  // namespace prt::cli
