#pragma once

#include <string>

#include "prt/base/error.h"

namespace prt {

/// Throws Error malformed: what is wrong with an asset, as a sentence that its file's name begins.
[[noreturn]] inline void rejectAsset(const std::string& complaint) {
    throw Error(ErrorCode::malformed, complaint);
}

}  // namespace prt
