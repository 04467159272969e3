#include "prt/transport/hit_matrix.h"

#include <gtest/gtest.h>

#include "prt/base/error.h"

namespace prt {
namespace {

HitSlab makeSlab(std::uint32_t receiver) {
    HitSlab slab;
    slab.receivers = {receiver, receiver + 1};
    slab.entries = {
        {receiver, {1.0f, 2.0f, 3.0f}}, {5, {4.0f, 5.0f, 6.0f}}, {6, {7.0f, 8.0f, 9.0f}}};
    slab.rowEnds = {1, 3};
    return slab;
}

void expectSlabs(const HitMatrix& matrix, std::uint32_t slabCount) {
    ASSERT_EQ(matrix.slabCount(), slabCount);
    for (std::uint32_t i = 0; i < slabCount; ++i)
        matrix.visitSlab(i, [&](const HitSlab& slab) {
            const HitSlab expected = makeSlab(10 * i);
            EXPECT_EQ(slab.receivers, expected.receivers);
            ASSERT_EQ(slab.row(0).size(), 1u);
            ASSERT_EQ(slab.row(1).size(), 2u);
            EXPECT_EQ(slab.row(0)[0].receiver, 10 * i);
            EXPECT_EQ(slab.row(1)[1].receiver, 6u);
            EXPECT_EQ(slab.row(1)[1].weight, Vec3f(7.0f, 8.0f, 9.0f));
        });
}

TEST(HitMatrix, KeepsRowsInMemory) {
    HitMatrix matrix(1 << 20, {});
    for (std::uint32_t i = 0; i < 5; ++i)
        matrix.addSlab(makeSlab(10 * i));
    expectSlabs(matrix, 5);
    EXPECT_EQ(matrix.rowCount(), 10u);
    EXPECT_EQ(matrix.entryBytes(), 15 * sizeof(BounceEntry));
}

TEST(HitMatrix, KeepsRowsOnDiskBeyondItsMemory) {
    HitMatrix matrix(7 * sizeof(BounceEntry), {});
    for (std::uint32_t i = 0; i < 5; ++i)
        matrix.addSlab(makeSlab(10 * i));
    expectSlabs(matrix, 5);
}

TEST(HitMatrix, SaysWhereItCannotWrite) {
    HitMatrix matrix(0, "/nowhere/at all");
    try {
        matrix.addSlab(makeSlab(0));
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::writeFailed);
        EXPECT_EQ(error.where(), "/nowhere/at all");
    }
}

}  // namespace
}  // namespace prt
