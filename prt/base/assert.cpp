#include "prt/base/assert.h"

#include <cstdio>
#include <cstdlib>

namespace prt {

void failAssertion(const char* condition, const char* why, const char* file, int line) {
    std::fprintf(stderr, "%s:%d: assertion failed: %s (%s)\n", file, line, condition, why);
    std::abort();
}

}  // namespace prt
