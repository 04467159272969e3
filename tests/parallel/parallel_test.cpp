#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

#include "prt/base/error.h"
#include "prt/parallel/parallel_for.h"
#include "prt/parallel/progress.h"

namespace prt {
namespace {

TEST(ParallelFor, VisitsEveryItemOnceInFixedChunks) {
    for (const int threadCount : {0, 1, 2, 8}) {
        std::vector<std::atomic<int>> visits(1001);
        std::atomic<int> chunkCount = 0;
        parallelFor(visits.size(), {threadCount, 10}, [&](std::size_t begin, std::size_t end) {
            EXPECT_EQ(begin % 10, 0u);
            EXPECT_LE(end - begin, 10u);
            ++chunkCount;
            for (std::size_t i = begin; i < end; ++i)
                ++visits[i];
        });
        EXPECT_EQ(chunkCount, 101);
        for (const auto& count : visits)
            EXPECT_EQ(count, 1);
    }
}

TEST(ParallelFor, DoesNothingForNoItems) {
    parallelFor(0, {}, [](std::size_t, std::size_t) { FAIL(); });
}

TEST(ParallelFor, HandsOnTheFirstException) {
    EXPECT_THROW(parallelFor(100, {2, 1},
                             [](std::size_t begin, std::size_t) {
                                 if (begin == 42) throw std::runtime_error("broken");
                             }),
                 std::runtime_error);
}

TEST(Progress, ReportsTheBeginningAndTheEnd) {
    std::vector<std::uint64_t> reported;
    const ProgressCallback callback = [&](const Progress& progress) {
        EXPECT_EQ(progress.stage, "trace");
        EXPECT_EQ(progress.unit, "rays");
        EXPECT_EQ(progress.total, 1000u);
        reported.push_back(progress.done);
        return true;
    };
    ProgressReporter reporter(callback, "trace", "rays", 1000);
    parallelFor(1000, {4, 1}, [&](std::size_t, std::size_t) { reporter.advance(1); });
    ASSERT_GE(reported.size(), 2u);
    EXPECT_EQ(reported.front(), 0u);
    EXPECT_EQ(reported.back(), 1000u);
}

TEST(Progress, AFalseCallbackCancelsTheWork) {
    const ProgressCallback callback = [](const Progress& progress) { return progress.done == 0; };
    ProgressReporter reporter(callback, "trace", "rays", 3);
    reporter.advance(1);  // too soon after the last report to be asked
    try {
        reporter.advance(2);
        FAIL() << "was not cancelled";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cancelled);
    }
    EXPECT_THROW(reporter.advance(0), Error);
}

TEST(Progress, WorksWithoutACallback) {
    const ProgressCallback none;
    ProgressReporter reporter(none, "trace", "rays", 3);
    EXPECT_NO_THROW(reporter.advance(3));
}

}  // namespace
}  // namespace prt
