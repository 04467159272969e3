#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <optional>

#include "prt/asset/asset.h"
#include "prt/base/error.h"
#include "tests/asset/asset_builder.h"

namespace prt::test {

/// The smallest honest scene: few bytes, each of which can be changed in every way.
inline Scene makeTriangle() {
    Scene scene;
    scene.materials.resize(1);
    scene.meshes.resize(1);
    scene.meshes[0].positions = {{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}};
    scene.meshes[0].normals.assign(3, {0.0f, 0.0f, 1.0f});
    scene.meshes[0].indices = {0, 1, 2};
    return scene;
}

/// Why the file is refused; nothing if it is read, into `asset` where given.
inline std::optional<Error> refusalOf(std::span<const std::byte> bytes, Asset* asset = nullptr) {
    try {
        Asset read = decodeAsset({bytes.begin(), bytes.end()}, "damaged.prt.glb");
        if (asset) *asset = std::move(read);
        return std::nullopt;
    } catch (const Error& error) {
        EXPECT_EQ(error.where(), "damaged.prt.glb");
        return error;
    }
}

inline bool isSameTable(const StoredTable& a, const StoredTable& b) {
    return a.encoding == b.encoding && a.scale == b.scale && a.bias == b.bias &&
           a.numbers == b.numbers;
}

inline bool hasSameBases(const CompressedLayer& a, const CompressedLayer& b) {
    if (!a.bases || !b.bases) return !a.bases && !b.bases;
    return a.bases->componentCounts == b.bases->componentCounts &&
           isSameTable(a.bases->vectors, b.bases->vectors);
}

inline bool isSameTransfer(const CompressedTransfer& a, const CompressedTransfer& b) {
    if (a.bandCount != b.bandCount || a.receiverCount != b.receiverCount ||
        a.layers.size() != b.layers.size())
        return false;
    for (std::size_t i = 0; i < a.layers.size(); ++i)
        if (a.layers[i].transport != b.layers[i].transport ||
            a.layers[i].channelCount != b.layers[i].channelCount ||
            a.layers[i].incidentBandCount != b.layers[i].incidentBandCount ||
            a.layers[i].largestError != b.layers[i].largestError ||
            !isSameTable(a.layers[i].table, b.layers[i].table) ||
            !hasSameBases(a.layers[i], b.layers[i]))
            return false;
    return true;
}

inline bool isSameGeometry(const Scene& a, const Scene& b) {
    if (a.meshes.size() != b.meshes.size()) return false;
    for (std::size_t i = 0; i < a.meshes.size(); ++i)
        if (a.meshes[i].positions != b.meshes[i].positions ||
            a.meshes[i].normals != b.meshes[i].normals)
            return false;
    return true;
}

/// A change to a sound file, after which the checksums are made to fit again.
struct Mutant {
    const char* name;
    std::function<void(GlbFile&)> change;
    const char* complaint;  ///< a part of it
};

inline nlohmann::json& primitiveOf(GlbFile& file, std::size_t mesh) {
    return file.json["meshes"][mesh]["primitives"][0];
}

inline nlohmann::json& layerOf(GlbFile& file, std::size_t layer) {
    return headerOf(file)["layers"][layer];
}

inline void expectEachIsRefused(const std::vector<Mutant>& mutants,
                                std::span<const std::byte> bytes) {
    for (const Mutant& mutant : mutants) {
        SCOPED_TRACE(mutant.name);
        GlbFile file = splitGlb(bytes);
        mutant.change(file);
        repairWhatCanBe(file);
        const std::optional<Error> refusal = refusalOf(joinGlb(file));
        ASSERT_TRUE(refusal);
        EXPECT_NE(std::string(refusal->what()).find(mutant.complaint), std::string::npos)
            << refusal->what();
    }
}

}  // namespace prt::test
