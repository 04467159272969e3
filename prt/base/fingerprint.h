#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace prt {

/// 64 bits that stand for a sequence of values: two sequences that differ get the same with
/// probability 2⁻⁶⁴. Not a defence against forgery.
///
/// The same on every machine that stores numbers little endian.
class Fingerprint {
  public:
    void add(std::span<const std::byte> bytes);

    /// A number, an enumerator or a flag.
    template <class Number>
    requires std::is_arithmetic_v<Number> || std::is_enum_v<Number>
    void add(Number number) { add(std::as_bytes(std::span(&number, 1))); }

    /// How many, and each: without holes between the values.
    template <class Value>
    void add(const std::vector<Value>& values) {
        add(static_cast<std::uint64_t>(values.size()));
        add(std::as_bytes(std::span(values)));
    }

    std::uint64_t value() const { return state_; }
    std::string hex() const;  ///< 16 digits

  private:
    std::uint64_t state_ = 0;
};

}  // namespace prt
