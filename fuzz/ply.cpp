// PLY in its three formats.

#include "fuzz/fuzz_target.h"
#include "prt/io/ply_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return prt::fuzz::readSafely(
        [&] { prt::fuzz::demandPromises(prt::parsePly(prt::fuzz::asText(data, size), "scene")); });
}
