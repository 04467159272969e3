#pragma once

#include <stdexcept>
#include <string>

namespace prt {

/// Why something outside the program could not be used. The command
/// line turns it into an exit code.
enum class ErrorCode {
    notFound,       ///< the file does not exist
    unreadable,     ///< the file exists but the system would not give its bytes
    malformed,      ///< the bytes are not what their format demands
    unsupported,    ///< well formed, but a feature or version we do not handle
    limitExceeded,  ///< larger than the stated limit
    invalidOption,  ///< an argument of the caller is out of range
    writeFailed,    ///< the result could not be stored
    outOfMemory,    ///< the work does not fit in the memory allowed
    cancelled,      ///< the caller's progress callback asked to stop
};

/// Outside data is wrong: what, where, and what was expected or can be done.
/// Never thrown for a bug of ours.
///
/// what() is one sentence without the file name and without a final full stop.
class Error : public std::runtime_error {
  public:
    /// @param where  the file or option at fault; may be empty when the catcher knows it better
    /// @param hint   what the user can do; may be empty
    Error(ErrorCode code, const std::string& what, std::string where = {}, std::string hint = {});

    ErrorCode code() const { return code_; }
    const std::string& where() const { return where_; }
    const std::string& hint() const { return hint_; }

    /// `<where>: <what> (<hint>)`, leaving out what is empty.
    std::string message() const;

  private:
    ErrorCode code_;
    std::string where_;
    std::string hint_;
};

}  // namespace prt
