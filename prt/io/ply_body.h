#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "prt/io/ply_header.h"

namespace prt {

/// The numbers that follow a PLY header, one after the other, in whichever format.
class PlyBody {
  public:
    /// @param name  how to call it in an error
    PlyBody(std::string_view bytes, PlyFormat format, const std::string& name)
        : rest_(bytes), format_(format), name_(name) {}

    /// Exact for all eight types. An integer type gives an integer in its range.
    ///
    /// @throws Error  malformed
    double readNumber(PlyType type);

    /// The length of a list, small enough for its items to be there.
    std::size_t readListCount(const PlyProperty& list);

    /// Passes over the value or the list of a property.
    void skip(const PlyProperty& property);

    /// Refuses an element whose instances cannot all be in the bytes
    /// left, before anything is allocated.
    void checkCount(const PlyElement& element) const;

  private:
    std::size_t minBytes(const PlyProperty& property) const;
    double readWord(PlyType type);
    template <class Number>
    double readBinary();

    std::string_view rest_;
    PlyFormat format_;
    const std::string& name_;
};

}  // namespace prt
