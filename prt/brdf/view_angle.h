#pragma once

#include <cmath>
#include <cstddef>

#include "prt/basis/sh.h"
#include "prt/math/vector.h"

namespace prt {

// What a surface reflects to a view, from tables over the angle between the view and the normal.
// Isotropic surfaces that mirror symmetry leaves alone have coefficients of m ≥ 0 only for views at
// azimuth 0; those of any other view are these, turned about the normal.

/// How many coefficients of n bands have m ≥ 0; (l, m) stands at uprightIndex.
constexpr std::size_t uprightCount(int bandCount) {
    return static_cast<std::size_t>(bandCount * (bandCount + 1) / 2);
}
constexpr std::size_t uprightIndex(int l, int m) {
    return static_cast<std::size_t>(l * (l + 1) / 2 + m);
}

/// A place between two entries of a table.
struct TablePlace {
    std::size_t first = 0;
    float share = 0.0f;  ///< of the second
};

/// @param x      in [0, 1], from the first of the entries to the last
/// @param count  at least 2
TablePlace placeBetween(float x, std::size_t count);

/// Where a view stands among the views of a table, which are even in the angle near the normal,
/// where coefficients go with its sine, and ever finer towards the horizon.
///
/// @param cosine  of the view and the normal; below the horizon counts as at it
TablePlace placeView(float cosine, std::size_t viewCount);

/// The view of an entry, at azimuth 0: entry 0 is the normal, the last one nearly the horizon, at
/// which lobes are not defined.
Vec3d tableView(std::size_t index, std::size_t viewCount);

/// Turns coefficients to the azimuth φ of a view: calls visit(l, m, cos mφ, sin mφ) for each m ≥ 0.
/// (l, m) takes the cosine's share of the coefficient there, and (l, −m) the sine's.
template <class Visit>
void visitTurned(const Vec3f& view, int bandCount, const Visit& visit) {
    const float radius = std::hypot(view.x, view.y);
    const float stepCosine = radius > 0.0f ? view.x / radius : 1.0f;
    const float stepSine = radius > 0.0f ? view.y / radius : 0.0f;
    float cosine = 1.0f;
    float sine = 0.0f;
    for (int m = 0; m < bandCount; ++m) {
        for (int l = m; l < bandCount; ++l)
            visit(l, m, cosine, sine);
        const float nextCosine = cosine * stepCosine - sine * stepSine;
        sine = cosine * stepSine + sine * stepCosine;
        cosine = nextCosine;
    }
}

}  // namespace prt
