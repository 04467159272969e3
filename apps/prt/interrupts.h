#pragma once

namespace prt::cli {

/// Work was stopped on request and left nothing half-written (EX_TEMPFAIL of sysexits.h).
inline constexpr int kInterruptedExitCode = 75;

/// Makes Ctrl-C and SIGTERM end the program at once with kInterruptedExitCode, except where
/// DeferInterrupts lives.
void installInterruptHandler();

/// Whether an interrupt came while it was deferred.
bool interruptRequested();

/// Throws Error{cancelled} if one did.
void stopIfInterrupted();

/// While it lives an interrupt is only remembered: for work that must clean
/// up after itself or be finished.
class DeferInterrupts {
  public:
    DeferInterrupts();
    ~DeferInterrupts();
    DeferInterrupts(const DeferInterrupts&) = delete;
    DeferInterrupts& operator=(const DeferInterrupts&) = delete;
};

}  // namespace prt::cli
