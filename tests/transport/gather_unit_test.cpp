#include "prt/transport/gather_unit.h"

#include <gtest/gtest.h>

#include <cstring>

#include "prt/base/error.h"

namespace prt {
namespace {

const std::vector<std::uint32_t> kReceivers = {4, 5, 9};
const GatherUnitShape kShape = {kReceivers, 2, true, 12};

/// Rows of two, none and one entries.
GatherUnit makeUnit() {
    GatherUnit unit;
    unit.transfer = {0.5f, -1.0f, 0.25f, 0.0f, 3.0f, 4.0f};
    unit.slab.receivers = kReceivers;
    unit.slab.rowEnds = {2, 2, 3};
    unit.slab.entries = {{0, {1, 2, 3}}, {11, {4, 5, 6}}, {7, {7, 8, 9}}};
    unit.counts = {48, 20, 1, 0.5, 0.25};
    return unit;
}

// Where the numbers of that unit begin as bytes.
constexpr std::size_t kReceiversBegin = 24;
constexpr std::size_t kRowEndsBegin = kReceiversBegin + 3 * 4 + 6 * 4;
constexpr std::size_t kEntriesBegin = kRowEndsBegin + 3 * 4;

std::vector<std::byte> withWord(std::size_t offset, std::uint32_t word) {
    std::vector<std::byte> bytes = encodeGatherUnit(makeUnit(), kShape);
    std::memcpy(bytes.data() + offset, &word, sizeof(word));
    return bytes;
}

TEST(GatherUnit, ReadsWhatWasWritten) {
    const GatherUnit unit = makeUnit();
    const GatherUnit read = readGatherUnit(encodeGatherUnit(unit, kShape), kShape);
    EXPECT_EQ(read.transfer, unit.transfer);
    EXPECT_EQ(read.slab.receivers, unit.slab.receivers);
    EXPECT_EQ(read.slab.rowEnds, unit.slab.rowEnds);
    ASSERT_EQ(read.slab.entries.size(), 3u);
    EXPECT_EQ(read.slab.entries[1].receiver, 11u);
    EXPECT_EQ(read.slab.entries[1].weight, Vec3f(4, 5, 6));
    EXPECT_EQ(read.counts.rayCount, 48u);
    EXPECT_EQ(read.counts.hitCount, 20u);
    EXPECT_EQ(read.counts.invalidRayCount, 1u);
}

TEST(GatherUnit, IsTheSameHoweverLongItTook) {
    GatherUnit slow = makeUnit();
    slow.counts.traceSeconds = 100.0;
    EXPECT_EQ(encodeGatherUnit(slow, kShape), encodeGatherUnit(makeUnit(), kShape));
}

TEST(GatherUnit, WithoutHitsHasTransferAlone) {
    GatherUnitShape shape = kShape;
    shape.keepHits = false;
    GatherUnit unit = makeUnit();
    unit.slab = {};
    const GatherUnit read = readGatherUnit(encodeGatherUnit(unit, shape), shape);
    EXPECT_EQ(read.transfer, unit.transfer);
    EXPECT_TRUE(read.slab.receivers.empty());
    EXPECT_THROW(readGatherUnit(encodeGatherUnit(unit, shape), kShape), Error);
}

TEST(GatherUnit, IsRefusedAtEveryOtherLength) {
    std::vector<std::byte> bytes = encodeGatherUnit(makeUnit(), kShape);
    ASSERT_EQ(bytes.size(), kEntriesBegin + 3 * 16);
    for (std::size_t size = 0; size < bytes.size(); ++size)
        EXPECT_THROW(readGatherUnit(std::span(bytes).first(size), kShape), Error) << size;
    bytes.push_back(std::byte{0});
    EXPECT_THROW(readGatherUnit(bytes, kShape), Error);
}

TEST(GatherUnit, IndicesAndCountsMustBeInRange) {
    EXPECT_THROW(readGatherUnit(withWord(kReceiversBegin, 3), kShape), Error) << "another receiver";
    EXPECT_THROW(readGatherUnit(withWord(kRowEndsBegin, 3), kShape), Error) << "rows go backwards";
    for (const std::uint32_t end : {0u, 2u, 4u, 0x10000003u, 0xffffffffu})
        EXPECT_THROW(readGatherUnit(withWord(kRowEndsBegin + 8, end), kShape), Error) << end;
    for (const std::uint32_t receiver : {12u, 0xffffffffu})
        EXPECT_THROW(readGatherUnit(withWord(kEntriesBegin + 16, receiver), kShape), Error);
    EXPECT_EQ(readGatherUnit(withWord(kEntriesBegin + 16, 10), kShape).slab.entries[1].receiver,
              10u);
}

}  // namespace
}  // namespace prt
