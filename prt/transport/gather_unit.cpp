#include "prt/transport/gather_unit.h"

#include <algorithm>

#include "prt/base/byte_stream.h"
#include "prt/base/error.h"

namespace prt {
namespace {

static_assert(sizeof(BounceEntry) == 16, "entries are stored without padding");

HitSlab readSlab(ByteReader& reader, const GatherUnitShape& shape) {
    HitSlab slab;
    slab.receivers.assign(shape.receivers.begin(), shape.receivers.end());
    slab.rowEnds = reader.readVector<std::uint32_t>(shape.receivers.size());
    if (!std::is_sorted(slab.rowEnds.begin(), slab.rowEnds.end()))
        throw Error(ErrorCode::malformed, "has rows that end before they begin");
    slab.entries = reader.readVector<BounceEntry>(slab.rowEnds.empty() ? 0 : slab.rowEnds.back());
    for (const BounceEntry& entry : slab.entries)
        if (entry.receiver >= shape.receiverLimit)
            throw Error(ErrorCode::malformed, "has a hit near a receiver that does not exist");
    return slab;
}

}  // namespace

std::vector<std::byte> encodeGatherUnit(const GatherUnit& unit, const GatherUnitShape& shape) {
    ByteWriter writer(sizeof(GatherCounts) +
                      (shape.receivers.size() + unit.slab.rowEnds.size()) * sizeof(std::uint32_t) +
                      unit.transfer.size() * sizeof(float) +
                      unit.slab.entries.size() * sizeof(BounceEntry));
    writer.writeNumber(unit.counts.rayCount);
    writer.writeNumber(unit.counts.hitCount);
    writer.writeNumber(unit.counts.invalidRayCount);
    writer.write(shape.receivers);
    writer.write(unit.transfer);
    if (shape.keepHits) {
        writer.write(unit.slab.rowEnds);
        writer.write(unit.slab.entries);
    }
    return writer.takeBytes();
}

GatherUnit readGatherUnit(std::span<const std::byte> payload, const GatherUnitShape& shape) {
    ByteReader reader(payload);
    GatherUnit unit;
    unit.counts.rayCount = reader.readNumber<std::uint64_t>();
    unit.counts.hitCount = reader.readNumber<std::uint64_t>();
    unit.counts.invalidRayCount = reader.readNumber<std::uint64_t>();
    if (!std::ranges::equal(reader.readVector<std::uint32_t>(shape.receivers.size()),
                            shape.receivers))
        throw Error(ErrorCode::malformed, "is of other receivers");
    unit.transfer = reader.readVector<float>(shape.receivers.size() * shape.coefficientCount);
    if (shape.keepHits) unit.slab = readSlab(reader, shape);
    reader.requireEnd();
    return unit;
}

}  // namespace prt
