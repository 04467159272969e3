#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace prt {

/// Memory that a confined process and this one both see. Zero at first, and taken from the machine
/// only where it is written.
class SharedMemory {
  public:
    /// @throws Error  outOfMemory
    explicit SharedMemory(std::size_t byteCount);
    ~SharedMemory();
    SharedMemory(const SharedMemory&) = delete;
    SharedMemory& operator=(const SharedMemory&) = delete;

    std::span<std::byte> bytes() const { return bytes_; }

  private:
    std::span<std::byte> bytes_;
};

struct ConfinedLimits {
    std::uint64_t memoryBytes = std::uint64_t(2) << 30;  ///< beyond what this process has
    double seconds = 25.0;
};

/// Runs `work` in a process of its own, for libraries that a damaged file can crash: all that
/// remains of it is what it wrote to SharedMemory.
///
/// The work may use one thread and no lock that another thread of this process might hold.
///
/// @param name    the file at fault, for errors
/// @throws Error  what `work` throws; malformed if it crashes or takes longer than the limit;
///                outOfMemory if it needs more memory, or no process can be started
void runConfined(const std::function<void()>& work, const ConfinedLimits& limits,
                 const std::string& name);

}  // namespace prt
