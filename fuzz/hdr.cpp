// Radiance pictures.

#include "fuzz/fuzz_target.h"
#include "prt/io/radiance_hdr.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return prt::fuzz::readSafely([&] {
        prt::decodeRadianceHdr(prt::fuzz::copyBytes(data, size), "image", prt::fuzz::kImageLimits);
    });
}
