#pragma once

#include <fcntl.h>
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

}  // namespace prt::test
