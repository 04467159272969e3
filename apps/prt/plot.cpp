#include "apps/prt/plot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "apps/prt/html.h"
#include "prt/base/assert.h"

namespace prt::cli {
namespace {

constexpr int kWidth = 1000, kHeight = 520;
constexpr int kLeft = 90, kRight = 210, kTop = 20, kBottom = 60;

// Okabe and Ito's colours, distinct to eyes that do not tell red from green.
constexpr const char* kColors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                   "#e69f00", "#56b4e9", "#8c8c8c"};

constexpr const char* kInk = "#1c2330";

/// A logarithmic axis between two of its marks, which are 1, 2 and 5 times powers of ten.
struct Axis {
    double low = 1.0;
    double high = 10.0;
    double begin = 0.0;  ///< where `low` is drawn
    double end = 1.0;    ///< where `high` is

    double place(double value) const {
        return begin + (end - begin) * std::log(value / low) / std::log(high / low);
    }
};

/// The largest mark that is at most a value, or the least that is at least.
double findMark(double value, bool isBelow) {
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    double mark = isBelow ? power : 10.0 * power;
    for (const double digit : {1.0, 2.0, 5.0}) {
        const double candidate = digit * power;
        if (isBelow && candidate <= value) mark = candidate;
        if (!isBelow && candidate >= value) mark = std::min(mark, candidate);
    }
    return mark;
}

std::vector<double> listMarks(const Axis& axis) {
    std::vector<double> marks;
    for (double power = std::pow(10.0, std::floor(std::log10(axis.low)));
         power <= axis.high * 1.001; power *= 10.0)
        for (const double digit : {1.0, 2.0, 5.0})
            if (digit * power >= axis.low * 0.999 && digit * power <= axis.high * 1.001)
                marks.push_back(digit * power);
    return marks;
}

Axis spanAxis(std::span<const PlotSeries> series, double PlotPoint::*coordinate, double begin,
              double end) {
    double low = std::numeric_limits<double>::max(), high = 0.0;
    for (const PlotSeries& line : series)
        for (const PlotPoint& point : line.points) {
            PRT_ASSERT(point.*coordinate > 0.0, "a logarithm of what is above 0");
            low = std::min(low, point.*coordinate);
            high = std::max(high, point.*coordinate);
        }
    PRT_ASSERT(high > 0.0, "a point to draw");
    Axis axis{findMark(low, true), findMark(high, false), begin, end};
    if (axis.high <= axis.low) axis.high = 10.0 * axis.low;
    return axis;
}

std::string drawGrid(const Axis& x, const Axis& y) {
    std::string svg;
    for (const double mark : listMarks(x))
        svg += fmt::format(
            "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\" stroke=\"#dfe3ea\"/>"
            "<text x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4:g}</text>\n",
            x.place(mark), y.end, y.begin, y.begin + 20, mark);
    for (const double mark : listMarks(y))
        svg += fmt::format(
            "<line x1=\"{1}\" x2=\"{2}\" y1=\"{0:.1f}\" y2=\"{0:.1f}\" stroke=\"#dfe3ea\"/>"
            "<text x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5:g}</text>\n",
            y.place(mark), x.begin, x.end, x.begin - 8, y.place(mark) + 4, mark);
    return svg;
}

std::string drawSeries(const PlotSeries& line, const Axis& x, const Axis& y, const char* color) {
    std::string path, dots;
    for (const PlotPoint& point : line.points) {
        path += fmt::format("{}{:.1f},{:.1f}", path.empty() ? "" : " ", x.place(point.x),
                            y.place(point.y));
        dots += fmt::format(
            "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"><title>{}</title></circle>\n",
            x.place(point.x), y.place(point.y), line.isMarked ? 9 : 5, color,
            escapeHtml(point.label));
    }
    return fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n",
                       path, color) +
           dots;
}

}  // namespace

std::string drawLogPlot(std::span<const PlotSeries> series, const std::string& xTitle,
                        const std::string& yTitle) {
    const Axis x = spanAxis(series, &PlotPoint::x, kLeft, kWidth - kRight);
    const Axis y = spanAxis(series, &PlotPoint::y, kHeight - kBottom, kTop);
    std::string svg = fmt::format(
        "<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\" "
        "style=\"width:100%;background:var(--card);border:1px solid "
        "var(--line);border-radius:10px\" font-size=\"13\" fill=\"#5c6675\">\n",
        kWidth, kHeight, escapeHtml(yTitle + " against " + xTitle));
    svg += drawGrid(x, y);
    for (std::size_t i = 0; i < series.size(); ++i) {
        const char* color = series[i].isMarked ? kInk : kColors[i % std::size(kColors)];
        svg += drawSeries(series[i], x, y, color);
        const double height = kTop + 14 + 24.0 * static_cast<double>(i);
        svg += fmt::format(
            "<circle cx=\"{}\" cy=\"{}\" r=\"5\" fill=\"{}\"/><text x=\"{}\" y=\"{}\">{}</text>\n",
            kWidth - kRight + 24, height - 4, color, kWidth - kRight + 36, height,
            escapeHtml(series[i].name));
    }
    svg += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n",
                       (x.begin + x.end) / 2, kHeight - 14, escapeHtml(xTitle));
    svg += fmt::format(
        "<text transform=\"translate(22 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
        (y.begin + y.end) / 2, escapeHtml(yTitle));
    return svg + "</svg>\n";
}

}  // namespace prt::cli
