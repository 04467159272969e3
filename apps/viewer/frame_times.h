#pragma once

#include <cstddef>
#include <vector>

namespace prt::viewer {

/// How long the last frames took.
class FrameTimes {
  public:
    /// @param capacity  how many are kept
    explicit FrameTimes(std::size_t capacity = 240) : capacity_(capacity) {}

    void add(double milliseconds);

    /// The oldest first.
    const std::vector<float>& milliseconds() const { return milliseconds_; }

    /// The least time that so large a part of the frames did not exceed; 0 without frames.
    ///
    /// @param part  0 … 1: 0.5 is the median
    double percentile(double part) const;

  private:
    std::size_t capacity_;
    std::vector<float> milliseconds_;
};

}  // namespace prt::viewer
