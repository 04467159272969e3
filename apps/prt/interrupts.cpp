#include "apps/prt/interrupts.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <string_view>

#include "prt/base/error.h"

namespace prt::cli {
namespace {

// What a signal handler may touch, and worker threads may read: lock-free atomics.
std::atomic<bool> interruptCame{false};
std::atomic<int> deferralCount{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

extern "C" void handleInterrupt(int) {
    interruptCame = true;
    if (deferralCount > 0) return;
    constexpr std::string_view kMessage = "prt: interrupted\n";
    [[maybe_unused]] const ssize_t written =
        ::write(STDERR_FILENO, kMessage.data(), kMessage.size());
    ::_exit(kInterruptedExitCode);
}

}  // namespace

void installInterruptHandler() {
    struct sigaction action = {};
    action.sa_handler = handleInterrupt;
    action.sa_flags = SA_RESTART;
    ::sigaction(SIGINT, &action, nullptr);
    ::sigaction(SIGTERM, &action, nullptr);
}

bool interruptRequested() {
    return interruptCame;
}

void stopIfInterrupted() {
    if (interruptRequested()) throw Error(ErrorCode::cancelled, "interrupted");
}

DeferInterrupts::DeferInterrupts() {
    ++deferralCount;
}

DeferInterrupts::~DeferInterrupts() {
    --deferralCount;
}

}  // namespace prt::cli
