// Measured BRDFs. What follows the header is repeated until the file has its one good size, so that
// small inputs reach the values.

#include "prt/io/merl.h"
#include "fuzz/fuzz_target.h"
#include "prt/brdf/brdf.h"

namespace {

constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kFileBytes = kHeaderBytes + 24 * prt::MeasuredBrdf::kCellCount;

void demandSense(const prt::MeasuredBrdf& brdf) {
    const prt::Vec3d view(0.6, 0.0, 0.8);
    for (const double u : {0.1, 0.6, 0.999}) {
        const prt::Vec3d incident = brdf.sample(view, u, 0.25);
        const double density = brdf.density(incident, view);
        PRT_ASSERT(std::isfinite(density) && density >= 0.0, "what is drawn has a density");
        if (incident.z <= 0.0) continue;
        const prt::Vec3d value = brdf.evaluate(incident, view);
        PRT_ASSERT(std::isfinite(value.x) && value.x >= 0.0, "a BRDF is finite and not negative");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::vector<std::byte> file = prt::fuzz::copyBytes(data, size);
    prt::fuzz::readSafely([&] { prt::parseMerlBrdf(file, "material"); });
    const std::size_t valueBytes = size > kHeaderBytes ? size - kHeaderBytes : 0;
    // The header refuses most inputs, and spares them the table.
    constexpr std::uint8_t kGoodHeader[] = {90, 0, 0, 0, 90, 0, 0, 0, 180, 0, 0, 0};
    if (valueBytes < 8 || !std::equal(std::begin(kGoodHeader), std::end(kGoodHeader), data))
        return 0;
    file.reserve(kFileBytes);
    while (file.size() < kFileBytes)
        file.push_back(file[file.size() - valueBytes]);
    return prt::fuzz::readSafely([&] { demandSense(*prt::parseMerlBrdf(file, "material").brdf); });
}
