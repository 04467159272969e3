#pragma once

#include <cstddef>
#include <vector>

namespace prt::viewer {

/// The least time that so large a part of some did not exceed; 0 where there are none.
///
/// @param part  0 … 1: 0.5 is the median
double findPercentile(std::vector<double> milliseconds, double part);

/// How long the last frames took.
class FrameTimes {
  public:
    /// @param capacity  how many are kept
    explicit FrameTimes(std::size_t capacity = 240) : capacity_(capacity) {}

    void add(double milliseconds);

    /// The oldest first.
    const std::vector<float>& milliseconds() const { return milliseconds_; }

    /// findPercentile of them.
    double percentile(double part) const;

  private:
    std::size_t capacity_;
    std::vector<float> milliseconds_;
};

}  // namespace prt::viewer
