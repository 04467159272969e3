#include "prt/math/isa.h"

#include <gtest/gtest.h>

namespace prt {
namespace {

TEST(Isa, NamesLeadBackToTheSets) {
    for (const Isa isa : {Isa::sse4, Isa::avx2, Isa::avx512})
        EXPECT_EQ(parseIsa(isaName(isa)), isa);
    EXPECT_EQ(isaName(Isa::sse4), "sse4");
    EXPECT_EQ(isaName(Isa::avx2), "avx2");
    EXPECT_EQ(isaName(Isa::avx512), "avx512");
    for (const char* other : {"", "AVX2", "avx", "neon"})
        EXPECT_EQ(parseIsa(other), std::nullopt);
}

#if defined(__x86_64__) && defined(__GNUC__)
TEST(Isa, TheWidestSetFoundIsTheCompilersToo) {
    __builtin_cpu_init();
    const Isa expected = __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl")
                             ? Isa::avx512
                         : __builtin_cpu_supports("avx2") ? Isa::avx2
                                                          : Isa::sse4;
    EXPECT_EQ(detectIsa(), expected);
}
#endif

}  // namespace
}  // namespace prt
