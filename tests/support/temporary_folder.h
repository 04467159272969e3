#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace prt::test {

inline std::string readText(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline void writeText(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

/// A new folder that is gone at the end of the test, and its neighbour for what is to lie outside.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string root = (std::filesystem::temp_directory_path() / "prt-test-XXXXXX").string();
        root_ = ::mkdtemp(root.data());
        std::filesystem::create_directories(path());
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() { std::filesystem::remove_all(root_); }

    std::filesystem::path path() const { return root_ / "work"; }
    std::filesystem::path captured(const std::string& name) const { return root_ / name; }

    /// How many files it holds, forgotten temporary ones included.
    std::ptrdiff_t fileCount() const {
        return std::distance(std::filesystem::directory_iterator(path()), {});
    }

  private:
    std::filesystem::path root_;
};

}  // namespace prt::test
