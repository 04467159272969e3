// OpenEXR, by the library of that name behind checks of our own, in a process of its own: what the
// library does with a file is not seen here, only that it comes back as an image or an Error.

#include "prt/io/exr.h"

#include "fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return prt::fuzz::readSafely([&] {
        prt::decodeExr(prt::fuzz::copyBytes(data, size), "image", prt::fuzz::kImageLimits);
    });
}
