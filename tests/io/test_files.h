#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <unistd.h>

#include "prt/base/error.h"

namespace prt::test {

/// A folder of its own for one test, gone when the test ends.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        static std::atomic<int> count = 0;
        path_ = std::filesystem::temp_directory_path() /
                ("prt_io_test_" + std::to_string(::getpid()) + "_" + std::to_string(count++));
        std::filesystem::create_directories(path_);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() { std::filesystem::remove_all(path_); }

    const std::filesystem::path& path() const { return path_; }

    /// Writes a file into the folder and returns where it is.
    std::filesystem::path write(const std::string& name, std::string_view bytes) const {
        std::filesystem::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name, std::ios::binary) << bytes;
        return path_ / name;
    }

  private:
    std::filesystem::path path_;
};

inline std::span<const std::byte> asBytes(std::string_view text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

/// Appends the bytes of a number as this (little-endian) machine keeps them.
template <class Number>
void append(std::string& bytes, Number number) {
    char raw[sizeof number];
    std::memcpy(raw, &number, sizeof number);
    bytes.append(raw, sizeof number);
}

template <class Number>
void appendBigEndian(std::string& bytes, Number number) {
    char raw[sizeof number];
    std::memcpy(raw, &number, sizeof number);
    bytes.append(std::reverse_iterator(raw + sizeof number), std::reverse_iterator(raw));
}

/// The error that a call ends with; the test fails if it ends with none.
template <class Call>
Error catchError(Call call) {
    try {
        call();
    } catch (const Error& error) {
        return error;
    }
    ADD_FAILURE() << "no error was thrown";
    return Error(ErrorCode::cancelled, "none");
}

/// Reads every prefix of a file and every change of one of its bytes (to all other
/// values of a short file, to eight others of a longer one). Each must be read or end
/// in an Error, never anything else.
///
/// @return  how many prefixes shorter than the file were read without an error
inline std::size_t readDamaged(const std::string& file,
                               const std::function<void(const std::string&)>& read) {
    const auto isRead = [&](const std::string& bytes) {
        try {
            read(bytes);
            return true;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()), "");
            EXPECT_NE(std::string(error.what()).back(), '.');
            return false;
        }
    };
    std::size_t readPrefixCount = 0;
    for (std::size_t size = 0; size < file.size(); ++size)
        readPrefixCount += isRead(file.substr(0, size));

    constexpr std::size_t kShortFileBytes = 120;
    const int step = file.size() <= kShortFileBytes ? 1 : 31;
    for (std::size_t i = 0; i < file.size(); ++i)
        for (int change = 1; change < 256; change += step) {
            std::string changed = file;
            changed[i] = static_cast<char>(static_cast<unsigned char>(changed[i]) ^ change);
            isRead(changed);
        }
    EXPECT_TRUE(isRead(file)) << "the whole file is good";
    return readPrefixCount;
}

}  // namespace prt::test
