// What a checkpoint keeps: the frame of a unit file, its payload behind a fitting checksum, and the
// manifest with its settings.

#include "fuzz/checkpoint_target.h"
#include "fuzz/fuzz_target.h"
#include "prt/transport/bake_settings.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace prt;
    const std::vector<std::byte> bytes = fuzz::copyBytes(data, size);
    fuzz::readSafely([&] { readUnit(bytes, fuzz::kWorkFingerprint, fuzz::unitKey()); });
    fuzz::readSafely([&] {
        const GatherUnitShape shape = fuzz::unitShape();
        const GatherUnit unit = readGatherUnit(bytes, shape);
        PRT_ASSERT(unit.transfer.size() == shape.receivers.size() * shape.coefficientCount,
                   "the transfer is that of the receivers");
        PRT_ASSERT(unit.slab.rowEnds.size() == shape.receivers.size(), "each receiver has a row");
        for (const BounceEntry& entry : unit.slab.entries)
            PRT_ASSERT(entry.receiver < shape.receiverLimit, "entries are receivers");
    });
    return fuzz::readSafely([&] {
        BakeOptions options;
        applyBakeSettings(readManifest(bytes), options);
    });
}
