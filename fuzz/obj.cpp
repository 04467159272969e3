// Wavefront OBJ; no library or texture can be named.

#include "prt/io/obj_reader.h"

#include "fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return prt::fuzz::readSafely([&] {
        prt::fuzz::demandPromises(
            prt::parseObjScene(prt::fuzz::asText(data, size), "/nonexistent/scene.obj"));
    });
}
