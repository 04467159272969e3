#include "prt/base/error.h"

#include <gtest/gtest.h>

#include "prt/base/assert.h"

namespace prt {
namespace {

TEST(Error, MessageSaysWhereWhatAndWhatToDo) {
    const Error error(ErrorCode::malformed, "has no vertices", "cube.obj", "check the export");

    EXPECT_EQ(error.message(), "cube.obj: has no vertices (check the export)");
    EXPECT_EQ(error.code(), ErrorCode::malformed);
    EXPECT_EQ(error.where(), "cube.obj");
    EXPECT_EQ(error.hint(), "check the export");
}

TEST(Error, MessageLeavesOutWhatIsEmpty) {
    EXPECT_EQ(Error(ErrorCode::cancelled, "was cancelled").message(), "was cancelled");
    EXPECT_EQ(Error(ErrorCode::notFound, "does not exist", "a.ply").message(),
              "a.ply: does not exist");
    EXPECT_EQ(Error(ErrorCode::outOfMemory, "needs 9 GB", "", "use --memory").message(),
              "needs 9 GB (use --memory)");
}

TEST(Error, WhatIsTheSentenceAlone) {
    const Error error(ErrorCode::malformed, "has no vertices", "cube.obj", "check the export");

    EXPECT_STREQ(error.what(), "has no vertices");
}

TEST(AssertDeathTest, BrokenPreconditionEndsTheProgramWithItsReasonAndPlace) {
    EXPECT_DEATH(PRT_ASSERT(1 + 1 == 3, "sums are right"),
                 "error_test.cpp:[0-9]+: assertion failed: 1 \\+ 1 == 3 \\(sums are right\\)");
}

TEST(Assert, KeptPreconditionDoesNothing) {
    PRT_ASSERT(1 + 1 == 2, "sums are right");
}

}  // namespace
}  // namespace prt
