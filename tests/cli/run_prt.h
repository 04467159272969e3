#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/kept_assets.h"
#include "tests/support/temporary_folder.h"

namespace prt::test {

struct CommandResult {
    int exitCode = -1;  ///< −1 if a signal ended it
    int signal = 0;
    std::string output;
    std::string errors;
};

/// A running prt, in a folder of its own choice, its streams captured in files.
class PrtProcess {
  public:
    PrtProcess(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
               std::optional<rlim_t> fileBytesLimit = {},
               std::optional<rlim_t> memoryBytesLimit = {})
        : outputPath_(folder.captured("output")), errorsPath_(folder.captured("errors")) {
        const auto option = std::ranges::find_if(
            arguments, [](const std::string& word) { return word == "-o" || word == "--output"; });
        if (option != arguments.end() && option + 1 != arguments.end() &&
            option[1].ends_with(".glb"))
            assetPath_ = folder.path() / option[1];
        std::vector<std::string> words = {PRT_BINARY};
        words.insert(words.end(), arguments.begin(), arguments.end());
        std::vector<char*> pointers;
        for (std::string& word : words)
            pointers.push_back(word.data());
        pointers.push_back(nullptr);

        process_ = ::fork();
        if (process_ != 0) return;
        redirect(outputPath_, STDOUT_FILENO);
        redirect(errorsPath_, STDERR_FILENO);
        if (fileBytesLimit) setLimit(RLIMIT_FSIZE, *fileBytesLimit);
        if (memoryBytesLimit) setLimit(RLIMIT_AS, *memoryBytesLimit);
        if (::chdir(folder.path().c_str()) == 0) ::execv(pointers[0], pointers.data());
        ::_exit(127);
    }

    void sendSignal(int signal) const { ::kill(process_, signal); }

    std::string errorsSoFar() const { return readText(errorsPath_); }

    CommandResult wait() const {
        int status = 0;
        ::waitpid(process_, &status, 0);
        if (status == 0 && std::filesystem::exists(assetPath_)) keepAsset(assetPath_);
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1,
                WIFSIGNALED(status) ? WTERMSIG(status) : 0, readText(outputPath_),
                readText(errorsPath_)};
    }

  private:
    static void setLimit(__rlimit_resource resource, rlim_t value) {
        const rlimit limit = {value, value};
        ::setrlimit(resource, &limit);
    }
    static void redirect(const std::filesystem::path& path, int descriptor) {
        ::dup2(::open(path.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600), descriptor);
    }

    std::filesystem::path outputPath_;
    std::filesystem::path errorsPath_;
    std::filesystem::path assetPath_;  ///< the .glb that it is to write, if any
    pid_t process_ = -1;
};

inline CommandResult runPrt(const TemporaryFolder& folder,
                            const std::vector<std::string>& arguments) {
    return PrtProcess(folder, arguments).wait();
}

/// Holds prt to refuse its arguments in one sentence that has all the words, and to write no file.
inline void expectRefused(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                          int exitCode, const std::vector<std::string>& words) {
    const std::ptrdiff_t fileCount = folder.fileCount();
    const CommandResult result = runPrt(folder, arguments);
    EXPECT_EQ(result.exitCode, exitCode) << result.errors;
    const std::size_t start = result.errors.find("prt: error: ");
    ASSERT_NE(start, std::string::npos) << result.errors;
    const std::string sentence = result.errors.substr(start);
    EXPECT_EQ(std::ranges::count(sentence, '\n'), 1) << sentence;
    for (const std::string& word : words)
        EXPECT_NE(sentence.find(word), std::string::npos) << sentence;
    EXPECT_EQ(folder.fileCount(), fileCount) << "a file was left behind";
}

}  // namespace prt::test
