#pragma once

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "tests/support/temporary_folder.h"

namespace prt::test {

/// Keeps what was written, once, where ctest says: the test kept_assets_are_valid holds all of it
/// to the Khronos validator.
inline void keepAsset(std::string_view bytes) {
    const char* folder = std::getenv("PRT_KEPT_ASSETS");
    if (folder == nullptr) return;
    std::filesystem::create_directories(folder);
    const std::string name = std::to_string(std::hash<std::string_view>{}(bytes)) + ".glb";
    if (const auto path = std::filesystem::path(folder) / name; !std::filesystem::exists(path))
        writeText(path, std::string(bytes));
}

inline void keepAsset(std::span<const std::byte> bytes) {
    keepAsset(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

inline void keepAsset(const std::filesystem::path& path) {
    keepAsset(std::string_view(readText(path)));
}

}  // namespace prt::test
