#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "prt/gltf/json_cursor.h"

namespace prt::gltf {

/// Fetches what an asset's URIs name: data URIs, and files of the
/// asset's own folder, never any other.
class ResourceLoader {
  public:
    /// @param folder      where the glTF lies
    /// @param byteBudget  how much may be loaded in all
    ResourceLoader(std::filesystem::path folder, std::uintmax_t byteBudget)
        : folder_(std::move(folder)), byteBudget_(byteBudget) {}

    /// @throws Error  malformed or unsupported for a URI that is not plainly inside the folder;
    /// notFound; limitExceeded
    std::vector<std::byte> load(const JsonCursor& uri);

  private:
    std::filesystem::path resolve(const JsonCursor& uri) const;

    std::filesystem::path folder_;
    std::uintmax_t byteBudget_;
};

}  // namespace prt::gltf
