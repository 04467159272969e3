#include "prt/io/confined.h"

#include <csignal>
#include <cstring>
#include <vector>

#include "test_files.h"

namespace prt {
namespace {

using test::catchError;

Error runFailing(const std::function<void()>& work, const ConfinedLimits& limits = {}) {
    return catchError([&] { runConfined(work, limits, "image.exr"); });
}

TEST(Confined, WhatIsWrittenToSharedMemoryIsSeen) {
    const SharedMemory shared(1 << 20);
    int here = 1;
    runConfined(
        [&] {
            shared.bytes()[12345] = std::byte{7};
            here = 2;
        },
        {}, "image.exr");
    EXPECT_EQ(shared.bytes()[12345], std::byte{7});
    EXPECT_EQ(shared.bytes()[0], std::byte{0});
    EXPECT_EQ(here, 1) << "all other memory is another";
}

TEST(Confined, ErrorsComeBackWhole) {
    const Error error = runFailing(
        [] { throw Error(ErrorCode::unsupported, "is deep", "elsewhere", "flatten it"); });
    EXPECT_EQ(error.code(), ErrorCode::unsupported);
    EXPECT_EQ(error.message(), "image.exr: is deep (flatten it)");
    EXPECT_EQ(runFailing([] { throw std::runtime_error("odd"); }).message(), "image.exr: odd");
    EXPECT_EQ(runFailing([] { throw std::bad_alloc(); }).code(), ErrorCode::outOfMemory);
}

TEST(Confined, ACrashIsAnError) {  // F8
    for (const int crash : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGKILL}) {
        const Error error = runFailing([crash] { std::raise(crash); });
        EXPECT_EQ(error.code(), ErrorCode::malformed);
        EXPECT_EQ(error.where(), "image.exr");
    }
    EXPECT_EQ(runFailing([] { std::abort(); }).code(), ErrorCode::malformed);
    EXPECT_EQ(runFailing([] { ::_exit(0); }).code(), ErrorCode::malformed);
}

TEST(Confined, AnEndlessLoopEnds) {
    volatile bool isRunning = true;
    const Error error = runFailing(
        [&] {
            while (isRunning) {
            }
        },
        {.seconds = 0.1});
    EXPECT_EQ(error.code(), ErrorCode::malformed);
    const Error asleep = runFailing([] { ::pause(); }, {.seconds = 0.1});
    EXPECT_NE(std::string(asleep.what()).find("longer than the limit"), std::string::npos);
}

TEST(Confined, MemoryIsLimited) {
    const Error error = runFailing(
        [] {
            std::vector<char> large(std::size_t(1) << 30);
            std::memset(large.data(), 1, large.size());
        },
        {.memoryBytes = std::uint64_t(64) << 20});
    EXPECT_TRUE(error.code() == ErrorCode::outOfMemory || error.code() == ErrorCode::malformed)
        << "a sanitizer ends the process";
}

}  // namespace
}  // namespace prt
