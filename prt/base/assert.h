#pragma once

namespace prt {

/// Ends the program with the broken precondition and its place on stderr: a bug, not bad data.
[[noreturn]] void failAssertion(const char* condition, const char* why, const char* file, int line);

}  // namespace prt

/// States a precondition; on in every build. Nothing a file contains
/// may reach one: that is an Error.
#define PRT_ASSERT(condition, why) \
    ((condition) ? static_cast<void>(0) : ::prt::failAssertion(#condition, why, __FILE__, __LINE__))
