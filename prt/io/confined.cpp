#include "prt/io/confined.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>
#include <type_traits>

#include "prt/base/error.h"

namespace prt {
namespace {

enum class Outcome { none, done, error };

/// How the work ended, in shared memory. None where it crashed.
struct Message {
    Outcome outcome = Outcome::none;
    ErrorCode code = ErrorCode::malformed;
    std::array<char, 1024> what{};
    std::array<char, 256> hint{};
};
static_assert(std::is_trivially_copyable_v<Message>);

template <std::size_t N>
void copyText(const std::string& text, std::array<char, N>& destination) {
    const std::size_t length = std::min(text.size(), N - 1);
    std::copy_n(text.begin(), length, destination.begin());
    destination[length] = '\0';
}

/// The address space that this process has; 0 where the system does not say.
std::uint64_t measureAddressSpace() {
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void limitResource(decltype(RLIMIT_CPU) resource, std::uint64_t value) {
    const rlimit limit{value, value};
    ::setrlimit(resource, &limit);
}

/// Makes a crash silent and cheap, and an endless loop finite.
void confineThisProcess(const ConfinedLimits& limits) {
#ifdef __linux__
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
    for (const int crash : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
        std::signal(crash, SIG_DFL);
    std::signal(SIGINT, SIG_IGN);  // the other process decides what an interrupt means
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
    limitResource(RLIMIT_CORE, 0);
    limitResource(RLIMIT_CPU, static_cast<std::uint64_t>(std::ceil(limits.seconds)));
    if (const std::uint64_t used = measureAddressSpace())
        limitResource(RLIMIT_AS, used + limits.memoryBytes);
}

Message runAndReport(const std::function<void()>& work) {
    Message message;
    message.outcome = Outcome::error;
    try {
        work();
        message.outcome = Outcome::done;
    } catch (const Error& error) {
        message.code = error.code();
        copyText(error.what(), message.what);
        copyText(error.hint(), message.hint);
    } catch (const std::bad_alloc&) {
        message.code = ErrorCode::outOfMemory;
        copyText("does not fit in memory", message.what);
    } catch (const std::exception& failure) {
        copyText(failure.what(), message.what);
    }
    return message;
}

/// Waits until the other end of the pipe is closed, as the end of a process does.
///
/// @return  whether it was within the time
bool waitForEnd(int pipeEnd, double seconds) {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    while (true) {
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
        if (left < 0) return false;
        pollfd waited{pipeEnd, POLLIN, 0};
        constexpr std::int64_t kLongestPoll = 1 << 30;
        const int ready = ::poll(&waited, 1, static_cast<int>(std::min(left + 1, kLongestPoll)));
        if (ready > 0) return true;
        if (ready < 0 && errno != EINTR) return true;
    }
}

void reap(pid_t process) {
    while (::waitpid(process, nullptr, 0) < 0 && errno == EINTR) {
    }
}

[[noreturn]] void throwNoProcess(const std::string& name) {
    throw Error(ErrorCode::outOfMemory,
                std::string("cannot be read in a process of its own: ") + std::strerror(errno),
                name);
}

}  // namespace

SharedMemory::SharedMemory(std::size_t byteCount) {
    void* memory = ::mmap(nullptr, std::max<std::size_t>(byteCount, 1), PROT_READ | PROT_WRITE,
                          MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) throw Error(ErrorCode::outOfMemory, "does not fit in memory");
    bytes_ = {static_cast<std::byte*>(memory), byteCount};
}

SharedMemory::~SharedMemory() {
    ::munmap(bytes_.data(), std::max<std::size_t>(bytes_.size(), 1));
}

void runConfined(const std::function<void()>& work, const ConfinedLimits& limits,
                 const std::string& name) {
    const SharedMemory shared(sizeof(Message));
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throwNoProcess(name);
    const pid_t process = ::fork();
    if (process == 0) {
        confineThisProcess(limits);
        const Message message = runAndReport(work);
        std::memcpy(shared.bytes().data(), &message, sizeof(message));
        ::_exit(0);
    }
    ::close(ends[1]);
    if (process < 0) {
        ::close(ends[0]);
        throwNoProcess(name);
    }
    const bool isInTime = waitForEnd(ends[0], 2.0 * limits.seconds);
    ::close(ends[0]);
    if (!isInTime) ::kill(process, SIGKILL);
    reap(process);

    Message message;
    std::memcpy(&message, shared.bytes().data(), sizeof(message));
    if (message.outcome == Outcome::done) return;
    if (message.outcome == Outcome::error)
        throw Error(message.code, message.what.data(), name, message.hint.data());
    throw Error(ErrorCode::malformed,
                isInTime ? "is damaged: the library that decodes it did not come back"
                         : "is damaged: decoding it takes longer than the limit",
                name);
}

}  // namespace prt
