#pragma once

#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "prt/base/error.h"

namespace prt {

static_assert(std::endian::native == std::endian::little, "files of ours are little endian");

/// Lines values up as bytes, little endian and without padding between them.
class ByteWriter {
  public:
    /// @param expectedBytes  room for them is made at once
    explicit ByteWriter(std::size_t expectedBytes = 0) { bytes_.reserve(expectedBytes); }

    template <class Value>
    void write(std::span<const Value> values) {
        const auto* begin = reinterpret_cast<const std::byte*>(values.data());
        bytes_.insert(bytes_.end(), begin, begin + values.size_bytes());
    }
    template <class Value>
    void write(const std::vector<Value>& values) {
        write(std::span<const Value>(values));
    }
    template <class Number>
    void writeNumber(Number number) {
        write(std::span<const Number>(&number, 1));
    }

    const std::vector<std::byte>& bytes() const { return bytes_; }
    std::vector<std::byte> takeBytes() { return std::move(bytes_); }

  private:
    std::vector<std::byte> bytes_;
};

/// Takes values off the front of bytes that nobody vouches for. Its readers
/// throw Error{malformed} where bytes run out, before they allocate.
class ByteReader {
  public:
    explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    std::size_t remainingBytes() const { return bytes_.size(); }

    template <class Value>
    std::vector<Value> readVector(std::size_t count) {
        if (count > bytes_.size() / sizeof(Value)) throwTooShort();
        std::vector<Value> values(count);
        copyTo(std::as_writable_bytes(std::span(values)));
        return values;
    }
    template <class Number>
    Number readNumber() {
        if (bytes_.size() < sizeof(Number)) throwTooShort();
        Number number = {};
        copyTo(std::as_writable_bytes(std::span(&number, 1)));
        return number;
    }

    /// @throws Error  malformed if anything is left
    void requireEnd() const {
        if (!bytes_.empty())
            throw Error(ErrorCode::malformed,
                        "has " + std::to_string(bytes_.size()) + " bytes too many");
    }

  private:
    [[noreturn]] static void throwTooShort() {
        throw Error(ErrorCode::malformed, "is shorter than it says");
    }
    void copyTo(std::span<std::byte> destination) {
        if (destination.empty()) return;  // whose address may be null
        std::memcpy(destination.data(), bytes_.data(), destination.size());
        bytes_ = bytes_.subspan(destination.size());
    }

    std::span<const std::byte> bytes_;
};

}  // namespace prt
