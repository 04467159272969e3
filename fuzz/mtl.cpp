// Material libraries of OBJ files.

#include "fuzz/fuzz_target.h"
#include "prt/io/mtl_parser.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return prt::fuzz::readSafely([&] {
        for (const prt::MtlMaterial& material :
             prt::parseMtl(prt::fuzz::asText(data, size), "library")) {
            PRT_ASSERT(prt::fuzz::isFinite(material.emission), "emission is finite");
            PRT_ASSERT(!material.diffuse || prt::fuzz::isFinite(*material.diffuse),
                       "reflectance is finite");
        }
    });
}
