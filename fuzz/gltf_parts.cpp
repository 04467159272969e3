// Binary glTF whose header and chunk lengths are always right: what lies behind them.

#include "fuzz/glb_parts.h"
#include "fuzz/gltf_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const auto file = prt::fuzz::splitParts(data, size);
        return file ? prt::fuzz::readGltfBytes(prt::test::joinGlb(*file)) : 0;
    } catch (const nlohmann::json::exception&) {
        return 0;  // text that is not UTF-8 cannot be put together again
    }
}
