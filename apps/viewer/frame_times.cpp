#include "apps/viewer/frame_times.h"

#include <algorithm>
#include <cmath>

namespace prt::viewer {

void FrameTimes::add(double milliseconds) {
    if (milliseconds_.size() == capacity_) milliseconds_.erase(milliseconds_.begin());
    milliseconds_.push_back(static_cast<float>(milliseconds));
}

double FrameTimes::percentile(double part) const {
    if (milliseconds_.empty()) return 0.0;
    std::vector<float> sorted = milliseconds_;
    std::ranges::sort(sorted);
    const double rank = std::ceil(part * static_cast<double>(sorted.size()));
    return static_cast<double>(sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1]);
}

}  // namespace prt::viewer
