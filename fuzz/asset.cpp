// The asset, as it is.

#include "prt/asset/asset.h"

#include "fuzz/fuzz_target.h"
#include "prt/asset/check_asset.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return prt::fuzz::readSafely([&] {
        const prt::Asset asset = prt::decodeAsset(prt::fuzz::copyBytes(data, size), "asset");
        prt::fuzz::demandPromises(asset.scene);
        prt::findAssetProblems(asset);
    });
}
