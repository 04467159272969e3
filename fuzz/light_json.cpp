// Lighting coefficients as JSON.

#include "fuzz/fuzz_target.h"
#include "prt/io/environment_io.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return prt::fuzz::readSafely([&] {
        const prt::Lighting lighting =
            prt::lightingFromJson(std::string(prt::fuzz::asText(data, size)), "light");
        for (const prt::Vec3d& c : lighting.coefficients)
            PRT_ASSERT(std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z),
                       "coefficients are finite");
    });
}
