#include "apps/viewer/lat_long_size.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace prt::viewer {
namespace {

/// Along one side of an image: part `share` of the new texel lies in the old one.
struct Overlap {
    int from = 0;
    int to = 0;
    float share = 0.0f;
};

/// What texels of one division share with those of another.
///
/// @param edge  edge(i, count): where texel i of `count` begins; rises
template <class Edge>
std::vector<Overlap> findOverlaps(int fromCount, int toCount, Edge edge) {
    std::vector<Overlap> overlaps;
    for (int to = 0, from = 0; to < toCount; ++to) {
        const double begin = edge(to, toCount), end = edge(to + 1, toCount);
        while (true) {
            const double low = std::max(begin, edge(from, fromCount));
            const double high = std::min(end, edge(from + 1, fromCount));
            overlaps.push_back({from, to, static_cast<float>((high - low) / (end - begin))});
            // Compares whole numbers: both may end at one place.
            const std::int64_t fromEnd = std::int64_t{from + 1} * toCount;
            const std::int64_t toEnd = std::int64_t{to + 1} * fromCount;
            if (fromEnd <= toEnd) ++from;
            if (fromEnd >= toEnd) break;
        }
    }
    return overlaps;
}

}  // namespace

Image resizeLatLong(const Image& source, int height) {
    const auto columns = findOverlaps(
        source.width, 2 * height, [](int i, int count) { return static_cast<double>(i) / count; });
    const auto rows = findOverlaps(source.height, height, [](int i, int count) {
        return -std::cos(std::numbers::pi * i / count);
    });
    Image narrow(2 * height, source.height);
    for (int y = 0; y < source.height; ++y)
        for (const auto& [from, to, share] : columns)
            narrow.at(to, y) += source.at(from, y) * share;
    Image resized(2 * height, height);
    for (const auto& [from, to, share] : rows)
        for (int x = 0; x < resized.width; ++x)
            resized.at(x, to) += narrow.at(x, from) * share;
    return resized;
}

}  // namespace prt::viewer
