#pragma once

#include <span>
#include <vector>

#include "prt/basis/sh.h"
#include "prt/basis/sh_convention.h"
#include "prt/basis/sh_window.h"
#include "prt/math/transform.h"

namespace prt {

/// The most bands of lighting that files hold and the command line makes; transfer has at most
/// kMaxBandCount.
inline constexpr int kMaxLightingBandCount = 64;

/// Distant lighting in the SH basis: L_i = ∫ L(ω) y_i(ω) dω for each of
/// red, green, blue (C2, C3, C5).
struct Lighting {
    int bandCount = 0;
    std::vector<Vec3d> coefficients;  ///< n², W·sr⁻¹·m⁻²

    Lighting() = default;
    /// Darkness.
    explicit Lighting(int bands)
        : bandCount(bands),
          coefficients(static_cast<std::size_t>(shCoefficientCount(bands)), Vec3d(0.0)) {}
};

/// White light that is basis function i alone. What it relights shows coefficient i of transfer.
Lighting makeBasisLighting(int bandCount, int index);

/// The lighting turned by a rotation: f(R⁻¹ω).
Lighting rotate(const Lighting& lighting, const Mat3d& rotation);

/// Sum of two lights. Band counts must agree.
Lighting add(const Lighting& a, const Lighting& b);

Lighting scale(const Lighting& lighting, double factor);
Lighting scale(const Lighting& lighting, const Vec3d& factor);

/// Each band times its factor.
Lighting applyWindow(const Lighting& lighting, std::span<const double> factors);

/// The first n bands. @param bandCount  at most lighting.bandCount
Lighting truncate(const Lighting& lighting, int bandCount);

/// The coefficients in another convention, and back in ours (convertShTo, convertShFrom).
Lighting convertTo(ShConvention convention, const Lighting& lighting);
Lighting convertFrom(ShConvention convention, const Lighting& lighting);

/// (1 − t) a + t b, for t in [0, 1]. Band counts must agree.
Lighting interpolate(const Lighting& a, const Lighting& b, double t);

/// The radiance that the coefficients stand for, in one direction.
Vec3d reconstruct(const Lighting& lighting, const Vec3d& direction);

}  // namespace prt
