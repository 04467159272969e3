// The asset with lengths and checksums made right after every mutation: the checks behind the
// checksums alone must hold.

#include "fuzz/glb_parts.h"
#include "prt/asset/asset.h"
#include "prt/asset/check_asset.h"
#include "tests/asset/asset_builder.h"

namespace {

/// The file with fitting checksums; as it is where its parts are not where they are looked for.
std::vector<std::byte> joinRepaired(prt::test::GlbFile file) {
    try {
        prt::test::repairChecksums(file);
    } catch (const nlohmann::json::exception&) {
    } catch (const std::out_of_range&) {
    }
    return prt::test::joinGlb(file);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        auto file = prt::fuzz::splitParts(data, size);
        if (!file) return 0;
        return prt::fuzz::readSafely([&] {
            const prt::Asset asset = prt::decodeAsset(joinRepaired(std::move(*file)), "asset");
            prt::fuzz::demandPromises(asset.scene);
            prt::findAssetProblems(asset);
        });
    } catch (const nlohmann::json::exception&) {
        return 0;  // text that is not UTF-8 cannot be put together again
    }
}
