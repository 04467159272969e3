#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <span>
#include <string>

#include "prt/base/error.h"
#include "prt/gltf/gltf_scene.h"
#include "tests/gltf/gltf_builder.h"
#include "tests/gltf/scene_promises.h"

namespace prt::test {

/// Whether a scene is read; one that is must keep every promise, one that is not must say why.
template <class Read>
bool isSafelyRead(Read read) {
    try {
        expectSceneKeepsItsPromises(read());
        return true;
    } catch (const Error& error) {
        EXPECT_STRNE(error.what(), "");
        return false;
    }
}

inline bool isRead(const std::filesystem::path& path) {
    return isSafelyRead([&] { return readGltf(path); });
}

/// Reads from memory, so that thousands of variants need no disk; no file may be named.
inline bool isRead(std::span<const std::byte> file) {
    return isSafelyRead([&] {
        return GltfDocument({file.begin(), file.end()}, "/nonexistent").flatten().scene;
    });
}

inline bool isRead(const std::string& text) {
    return isRead(std::as_bytes(std::span(text)));
}
inline bool isRead(const GltfBuilder& builder) {
    return isRead(std::span<const std::byte>(builder.glb()));
}

}  // namespace prt::test
