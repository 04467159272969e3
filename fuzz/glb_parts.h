#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "fuzz/fuzz_target.h"
#include "tests/gltf/glb_file.h"

namespace prt::fuzz {

/// A binary glTF as its JSON, a zero byte, and its binary chunk, so that a mutation of one leaves
/// the lengths of the file right. Nothing where the JSON cannot be parsed.
inline std::optional<test::GlbFile> splitParts(const std::uint8_t* data, std::size_t size) {
    const auto* end = std::find(data, data + size, std::uint8_t(0));
    nlohmann::json json = nlohmann::json::parse(data, end, nullptr, false);
    if (json.is_discarded()) return std::nullopt;
    const std::size_t jsonBytes = static_cast<std::size_t>(end - data);
    const std::size_t skipped = std::min(jsonBytes + 1, size);
    test::GlbFile file{std::move(json), copyBytes(data + skipped, size - skipped)};
    file.binary.resize((file.binary.size() + 3) / 4 * 4);
    return file;
}

}  // namespace prt::fuzz
