// The asset with lengths and checksums made right after every mutation: the checks behind the
// checksums alone must hold.

#include "fuzz/glb_parts.h"
#include "prt/asset/asset.h"
#include "prt/asset/check_asset.h"
#include "tests/asset/asset_builder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        auto file = prt::fuzz::splitParts(data, size);
        if (!file) return 0;
        return prt::fuzz::readSafely([&] {
            prt::test::repairWhatCanBe(*file);
            const prt::Asset asset = prt::decodeAsset(prt::test::joinGlb(*file), "asset");
            prt::fuzz::demandPromises(asset.scene);
            prt::findAssetProblems(asset);
        });
    } catch (const nlohmann::json::exception&) {
        return 0;  // text that is not UTF-8 cannot be put together again
    }
}
