#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace prt::test {

inline std::string readText(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline void writeText(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

/// A new folder that is gone at the end of the test, and its neighbour for what the command prints.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string root = (std::filesystem::temp_directory_path() / "prt-cli-XXXXXX").string();
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
               std::optional<rlim_t> fileBytesLimit = {})
        : outputPath_(folder.captured("output")), errorsPath_(folder.captured("errors")) {
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
        if (fileBytesLimit) {
            const rlimit limit = {*fileBytesLimit, *fileBytesLimit};
            ::setrlimit(RLIMIT_FSIZE, &limit);
        }
        if (::chdir(folder.path().c_str()) == 0) ::execv(pointers[0], pointers.data());
        ::_exit(127);
    }

    void sendSignal(int signal) const { ::kill(process_, signal); }

    std::string errorsSoFar() const { return readText(errorsPath_); }

    CommandResult wait() const {
        int status = 0;
        ::waitpid(process_, &status, 0);
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1,
                WIFSIGNALED(status) ? WTERMSIG(status) : 0, readText(outputPath_),
                readText(errorsPath_)};
    }

  private:
    static void redirect(const std::filesystem::path& path, int descriptor) {
        ::dup2(::open(path.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600), descriptor);
    }

    std::filesystem::path outputPath_;
    std::filesystem::path errorsPath_;
    pid_t process_ = -1;
};

inline CommandResult runPrt(const TemporaryFolder& folder,
                            const std::vector<std::string>& arguments) {
    return PrtProcess(folder, arguments).wait();
}

}  // namespace prt::test
