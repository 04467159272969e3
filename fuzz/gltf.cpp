// glTF as text, its buffers data URIs; binary glTF is told by its first bytes and has a target of
// its own. No file can be named.

#include "fuzz/gltf_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return prt::fuzz::readGltfBytes(prt::fuzz::copyBytes(data, size));
}
