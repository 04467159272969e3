// Spherical harmonics of one direction a vector lane, as straight-line code for a band count known
// at compile time [Sloan13]. Included once a target from a file that hwy/foreach_target.h compiles
// again and again, so that other kernels can evaluate SH in registers without a call.

#if defined(PRT_BASIS_SH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PRT_BASIS_SH_INL_H_
#undef PRT_BASIS_SH_INL_H_
#else
#define PRT_BASIS_SH_INL_H_
#endif

#include <hwy/highway.h>

#include <numbers>

#include "prt/basis/sh.h"

HWY_BEFORE_NAMESPACE();
namespace prt::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// √x at compile time, by Newton's iteration from above.
constexpr double constantSqrt(double x) {
    double root = x > 1.0 ? x : 1.0;
    for (double next = 0.5 * (root + x / root); next < root; next = 0.5 * (root + x / root)) {
        root = next;
    }
    return root;
}

/// y_mm / Re (x+iy)^m, phase included (C2).
constexpr double sectoralFactor(int m) {
    double square = 0.25 * std::numbers::inv_pi * (m > 0 ? 2.0 : 1.0);
    for (int k = 1; k <= m; ++k)
        square *= (2.0 * k + 1.0) / (2.0 * k);
    return m % 2 == 0 ? constantSqrt(square) : -constantSqrt(square);
}

/// a_l of the normalised Legendre recurrence p_l = a_l (z p_{l−1} − p_{l−2} / a_{l−1}) of order m.
constexpr double legendreFactor(int l, int m) {
    return constantSqrt((4.0 * l * l - 1.0) /
                        (static_cast<double>(l) * l - static_cast<double>(m) * m));
}

/// The functions of order ±m from degree l up; `last` and `beforeLast` are p_{l−1} and p_{l−2}.
template <int kBandCount, int m, int l, class D, class V, class Store>
HWY_INLINE void evaluateShDegrees(D d, V z, V cosine, V sine, V last, V beforeLast, Store store) {
    if constexpr (l < kBandCount) {
        using Real = hn::TFromD<D>;
        constexpr double kStart = sectoralFactor(m);
        V legendre;
        if constexpr (l == m) {
            legendre = hn::Set(d, static_cast<Real>(kStart));
        } else if constexpr (l == m + 1) {
            legendre = hn::Mul(hn::Set(d, static_cast<Real>(legendreFactor(l, m) * kStart)), z);
        } else if constexpr (l == m + 2) {
            // p_m is a constant, which makes p_{m+2} one multiply-add in z².
            constexpr double kLeading = legendreFactor(l, m) * legendreFactor(l - 1, m) * kStart;
            constexpr double kTrailing = -legendreFactor(l, m) / legendreFactor(l - 1, m) * kStart;
            legendre = hn::MulAdd(hn::Set(d, static_cast<Real>(kLeading)), hn::Mul(z, z),
                                  hn::Set(d, static_cast<Real>(kTrailing)));
        } else {
            constexpr double kLast = legendreFactor(l, m);
            constexpr double kBeforeLast = -kLast / legendreFactor(l - 1, m);
            legendre = hn::MulAdd(hn::Set(d, static_cast<Real>(kLast)), hn::Mul(z, last),
                                  hn::Mul(hn::Set(d, static_cast<Real>(kBeforeLast)), beforeLast));
        }

        if constexpr (m == 0) {
            store(shIndex(l, 0), legendre);
        } else {
            store(shIndex(l, m), hn::Mul(legendre, cosine));
            store(shIndex(l, -m), hn::Mul(legendre, sine));
        }
        evaluateShDegrees<kBandCount, m, l + 1>(d, z, cosine, sine, legendre, last, store);
    }
}

/// The functions of order ±m and of all higher orders, where cosine + i sine = (x + iy)^m.
template <int kBandCount, int m, class D, class V, class Store>
HWY_INLINE void evaluateShOrders(D d, V x, V y, V z, V cosine, V sine, Store store) {
    if constexpr (m < kBandCount) {
        evaluateShDegrees<kBandCount, m, m>(d, z, cosine, sine, z, z, store);
        const V nextCosine = hn::MulSub(x, cosine, hn::Mul(y, sine));
        const V nextSine = hn::MulAdd(x, sine, hn::Mul(y, cosine));
        evaluateShOrders<kBandCount, m + 1>(d, x, y, z, nextCosine, nextSine, store);
    }
}

/// Evaluates all basis functions, one direction a lane.
///
/// @param d        float or double lanes
/// @param x, y, z  unit directions
/// @param store    called once a function as store(index, value), with a constant index; a lambda
///                 of the caller, marked HWY_ATTR
template <int kBandCount, class D, class V, class Store>
HWY_INLINE void evaluateShLanes(D d, V x, V y, V z, Store store) {
    evaluateShDegrees<kBandCount, 0, 0>(d, z, z, z, z, z, store);
    evaluateShOrders<kBandCount, 1>(d, x, y, z, x, y, store);
}

}  // namespace prt::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // PRT_BASIS_SH_INL_H_
