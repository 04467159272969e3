#pragma once

#include <span>
#include <string>
#include <vector>

namespace prt::cli {

struct PlotPoint {
    double x = 0.0;  ///< above 0
    double y = 0.0;  ///< above 0
    std::string label{};
};

/// Points that a line joins, in their order.
struct PlotSeries {
    std::string name;
    std::vector<PlotPoint> points;
    bool isMarked = false;  ///< drawn to be seen before the others
};

/// A plot on logarithmic axes as SVG, for a page of formatPage. A point tells its label to the
/// mouse.
///
/// @param series  at least one point among them
std::string drawLogPlot(std::span<const PlotSeries> series, const std::string& xTitle,
                        const std::string& yTitle);

}  // namespace prt::cli
