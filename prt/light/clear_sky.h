#pragma once

#include <array>

#include "prt/light/environment.h"

namespace prt {

/// The sky of a clear day, and its sun, by the analytic model of [Preetham99].
///
///   L(θ, γ) = L_z F(θ, γ) / F(0, θ_s),  F = (1 + A e^{B/cos θ})(1 + C e^{Dγ} + E cos²γ)
///
/// for luminance and for both chromaticities, θ from the zenith and γ from the sun. Colours beyond
/// Rec. 709 become the nearest inside, and below the horizon all is black. The units are
/// photometric: a radiance of 1 has the luminance of 1000 cd/m², an irradiance of 1 the illuminance
/// of 1000 lx, where luminance is that of the linear colour. So a sky is of the order of 10, its
/// sun of 100, and a picture wants an exposure of some −5 stops.
class ClearSky {
  public:
    static constexpr double kMinTurbidity = 2.0;
    static constexpr double kMaxTurbidity = 10.0;

    /// @param sunDirection  unit, not below the horizon: y ≥ 0
    /// @param turbidity     haze, from 2 for the clearest air to 10; the model was fitted up to 6
    ClearSky(const Vec3d& sunDirection, double turbidity);

    const Vec3d& sunDirection() const { return sunDirection_; }

    /// Radiance of the sky without the sun's disc. @param direction  unit
    Vec3d radiance(const Vec3d& direction) const;

    /// Irradiance by the sun alone on a surface facing it: sunlight as a black body of 5778 K with
    /// 128 klx outside the atmosphere, less what air and haze scatter out of the beam [Preetham99,
    /// appendix A2]. Differs from the paper: ozone, mixed gases and water vapour, which take some
    /// percent, are left out.
    Vec3d sunIrradiance() const;

    /// The sun's angular radius as seen from the earth.
    static constexpr double kSunHalfAngleRadians = 0.00465;

  private:
    std::array<std::array<double, 5>, 3> perez_;  ///< A … E of luminance, x and y
    std::array<double, 3> zenithOverReference_;   ///< value at the zenith over F(0, θ_s)
    Vec3d sunDirection_;
    double turbidity_;
};

/// Projects the sky without the sun's disc onto SH, by quadrature over the upper hemisphere.
Lighting skyLighting(const ClearSky& sky, int bandCount);

/// Sky and sun together.
Lighting daylightLighting(const ClearSky& sky, int bandCount);

/// Draws the sky as a lat-long image, with the sun's whole irradiance in the texels that its disc
/// touches, or without a sun.
///
/// @param width  even
Environment drawSky(const ClearSky& sky, int width, bool withSun);

}  // namespace prt
