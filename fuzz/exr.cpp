// OpenEXR, by the library of that name behind checks of our own, and in this process, where a
// crash is seen: readers confine it (prt/io/confined.h).

#include "prt/io/exr.h"

#include "fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return prt::fuzz::readSafely([&] {
        prt::decodeExrUnconfined(prt::fuzz::copyBytes(data, size), "image",
                                 prt::fuzz::kImageLimits);
    });
}
