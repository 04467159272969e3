#include "apps/viewer/frame_times.h"

#include <algorithm>
#include <cmath>

namespace prt::viewer {

double findPercentile(std::vector<double> milliseconds, double part) {
    if (milliseconds.empty()) return 0.0;
    std::ranges::sort(milliseconds);
    const double rank = std::ceil(part * static_cast<double>(milliseconds.size()));
    return milliseconds[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

void FrameTimes::add(double milliseconds) {
    if (milliseconds_.size() == capacity_) milliseconds_.erase(milliseconds_.begin());
    milliseconds_.push_back(static_cast<float>(milliseconds));
}

double FrameTimes::percentile(double part) const {
    return findPercentile({milliseconds_.begin(), milliseconds_.end()}, part);
}

}  // namespace prt::viewer
