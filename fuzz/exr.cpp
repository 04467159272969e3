// OpenEXR, by the library of that name behind checks of our own.

#include "prt/io/exr.h"

#include "fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return prt::fuzz::readSafely([&] {
        prt::decodeExr(prt::fuzz::copyBytes(data, size), "image", prt::fuzz::kImageLimits);
    });
}
