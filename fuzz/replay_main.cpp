// Runs a fuzz target on every file that is named, and every file of every folder that is: how
// seeds and regressions are replayed by a compiler without a fuzzer.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "prt/base/error.h"
#include "prt/base/file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t(1) << 30;

double replay(const fs::path& file) {
    const std::vector<std::byte> bytes = prt::readFile(file, kMaxFileBytes);
    std::fprintf(stderr, "%s\n", file.c_str());  // if it crashes, the last name is the culprit
    const auto start = std::chrono::steady_clock::now();
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

int main(int argumentCount, char** arguments) {
    std::size_t fileCount = 0;
    double slowestSeconds = 0.0;
    const auto count = [&](double seconds) {
        slowestSeconds = std::max(slowestSeconds, seconds);
        ++fileCount;
    };
    try {
        for (int i = 1; i < argumentCount; ++i) {
            if (!fs::is_directory(arguments[i])) {
                count(replay(arguments[i]));
                continue;
            }
            for (const fs::directory_entry& entry : fs::directory_iterator(arguments[i]))
                if (entry.is_regular_file()) count(replay(entry.path()));
        }
    } catch (const prt::Error& error) {
        std::fprintf(stderr, "%s\n", error.message().c_str());
        return 1;
    }
    std::printf("%zu inputs survived, the slowest in %.3f s\n", fileCount, slowestSeconds);
    return fileCount > 0 ? 0 : 1;
}
