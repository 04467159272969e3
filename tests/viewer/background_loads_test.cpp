#include "apps/viewer/background_loads.h"

#include <atomic>
#include <chrono>
#include <stdexcept>

#include <gtest/gtest.h>

namespace prt::viewer {
namespace {

using Loads = BackgroundLoads<std::string>;
using Names = std::vector<std::string>;

TEST(BackgroundLoads, ReadsEachNameOnceInTheOrderAskedFor) {
    Names read;
    Loads loads([&](const std::string& name) -> Loads::Loaded {
        read.push_back(name);
        return {name + "!", "mended " + name};
    });
    loads.finish(Names{"c", "a", "c", "b"});
    EXPECT_EQ(read, (Names{"c", "a", "b"}));
    EXPECT_EQ(*loads.at("a").value, "a!");
    EXPECT_EQ(loads.at("b").status.message, "mended b");
    const auto kept = loads.at("a").value;
    loads.finish(Names{"a", "d"});
    EXPECT_EQ(read, (Names{"c", "a", "b", "d"}));
    EXPECT_EQ(loads.at("a").value, kept);
    loads.finish(Names{"c"});
    EXPECT_EQ(read.back(), "c");
    EXPECT_EQ(read.size(), 5u);
    EXPECT_EQ(kept.use_count(), 1);
}

TEST(BackgroundLoads, WhateverIsThrownIsTheStatusOfItsName) {
    Loads loads([](const std::string& name) -> Loads::Loaded {
        if (name == "error") throw Error(ErrorCode::malformed, "is wrong", name, "mend it");
        if (name == "memory") throw std::bad_alloc();
        if (name == "other") throw std::runtime_error("failed somehow");
        return {name};
    });
    loads.finish(Names{"error", "memory", "other", "good"});
    EXPECT_EQ(loads.at("error").status.message, "error: is wrong (mend it)");
    EXPECT_EQ(loads.at("memory").status.message, "memory: does not fit in memory");
    EXPECT_EQ(loads.at("other").status.message, "other: failed somehow");
    for (const char* wrong : {"error", "memory", "other"}) {
        EXPECT_EQ(loads.at(wrong).status.stage, LoadingStatus::Stage::failed);
        EXPECT_FALSE(loads.at(wrong).value);
    }
    EXPECT_EQ(loads.at("good").status.stage, LoadingStatus::Stage::ready);
}

TEST(BackgroundLoads, ClosesWithoutReadingWhatIsLeft) {
    constexpr int kManyNames = 1000;  // a second of reading; closing is begun after a millisecond
    Names names;
    for (int i = 0; i < kManyNames; ++i)
        names.push_back(std::to_string(i));
    std::atomic<int> readCount = 0;
    {
        Loads loads([&](const std::string& name) -> Loads::Loaded {
            ++readCount;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            return {name};
        });
        loads.update(names);
        while (readCount == 0)
            std::this_thread::yield();
    }
    EXPECT_LT(readCount, kManyNames);
}

TEST(BackgroundLoads, WhatIsForgottenBeforeItsTurnIsNotRead) {
    std::atomic<bool> isOpen = false;
    std::atomic<int> readCount = 0;
    Loads loads([&](const std::string& name) -> Loads::Loaded {
        ++readCount;
        while (!isOpen)
            std::this_thread::yield();
        return {name};
    });
    loads.update(Names{"a"});
    while (readCount == 0)
        std::this_thread::yield();
    loads.update(Names{"a", "b", "c"});
    loads.update(Names{"c"});
    loads.update(Names{"c", "a"});  // is still being read, and need not be read again
    isOpen = true;
    loads.finish(Names{"c", "a"});
    EXPECT_EQ(readCount, 2);
    EXPECT_EQ(*loads.at("a").value, "a");
}

}  // namespace
}  // namespace prt::viewer
