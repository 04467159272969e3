#include "prt/base/error.h"

#include <utility>

namespace prt {

Error::Error(ErrorCode code, const std::string& what, std::string where, std::string hint)
    : std::runtime_error(what), code_(code), where_(std::move(where)), hint_(std::move(hint)) {}

std::string Error::message() const {
    std::string text = where_.empty() ? what() : where_ + ": " + what();
    if (!hint_.empty()) text += " (" + hint_ + ")";
    return text;
}

}  // namespace prt
