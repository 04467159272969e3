// Binary glTF, with its header and chunks.

#include "fuzz/gltf_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return prt::fuzz::readGltfBytes(prt::fuzz::copyBytes(data, size));
}
