#pragma once

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <cstdint>

namespace prt {

/// Runs a check with the kernels of each instruction set that this machine has, the widest first.
template <class Check>
void onEveryInstructionSet(const Check& check) {
    const auto choose = [](std::int64_t targets) {
        hwy::SetSupportedTargetsForTest(targets);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    };
    const std::int64_t supported = hwy::SupportedTargets() & HWY_TARGETS;
    int targetCount = 0;
    for (const std::int64_t target : {HWY_AVX3, HWY_AVX2, HWY_SSE4, HWY_NEON}) {
        if ((supported & target) == 0) continue;
        SCOPED_TRACE(hwy::TargetName(target));
        choose(target);
        check();
        ++targetCount;
    }
    choose(0);  // all that there are
    EXPECT_GE(targetCount, 1);
}

}  // namespace prt
