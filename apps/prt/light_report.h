#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "prt/image/image.h"
#include "prt/light/irradiance.h"
#include "prt/light/lighting.h"

namespace prt::cli {

/// The bands that a report projects a light onto, and those that it draws it in [Dachsbacher17].
inline constexpr int kReportBandCount = 32;
inline constexpr int kPicturedBandCounts[] = {1, 2, 4, 8, 16, 32};
/// The Haar wavelets beside them: as many numbers as 10 bands have, and more [Ng03].
inline constexpr std::size_t kPicturedWaveletCounts[] = {100, 1024, 4096};

/// What `prt light --report` is about.
struct LightReport {
    std::string name{};
    std::string command{};  ///< that makes the report again
    std::string window{};   ///< by which the coefficients were lowered, "none" for none
    Image picture{};        ///< the light itself, lat-long
    Lighting lighting{};    ///< in kReportBandCount bands, nothing lowered
    Lighting printed{};     ///< the coefficients that were asked for, in our convention
};

/// What a number of bands leaves of a light.
struct BandFinding {
    int bandCount = 0;
    double energy = 0.0;          ///< of the last of these bands, as a part of the light's
    double error = 0.0;           ///< relative root mean square of what is missing
    double lowestRadiance = 0.0;  ///< of all channels and directions, over the mean radiance
};

/// The lowest radiance by window, over the mean radiance.
struct RingingFinding {
    int bandCount = 0;
    double plain = 0.0, hann = 0.0, lanczos = 0.0, automatic = 0.0;
    double lastFactor = 1.0;  ///< of the automatic window's last band
};

struct LightFindings {
    Vec3d meanRadiance{0.0, 0.0, 0.0};
    double largestLuminance = 0.0;
    float exposureStops = 0.0f;  ///< under which a white sphere in this light is well exposed
    std::vector<BandFinding> bands{};
    std::vector<RingingFinding> ringing{};
    std::vector<double> waveletErrors{};  ///< one each of kPicturedWaveletCounts
    std::vector<IrradianceError> irradiance{};
    std::vector<IrradianceError> worstIrradiance{};  ///< the same of one directional light
};

/// Writes index.html, lighting.json and the pictures into a folder. @throws Error writeFailed
void writeLightReport(const std::filesystem::path& folder, const LightReport& report);

/// The page alone.
std::string formatLightPage(const LightReport& report, const LightFindings& findings);

// Names of the pictures, which the page shows, without a suffix.
inline constexpr const char* kOriginalPicture = "original";
inline constexpr const char* kMirrorSphere = "sphere-mirror";
inline constexpr const char* kExactSphere = "sphere-exact";
inline constexpr const char* kPrintedSphere = "sphere-printed";
inline constexpr const char* kPrintedPicture = "printed";
inline constexpr const char* kPrintedSigns = "printed-signs";
inline constexpr const char* kPlainSigns = "plain-signs";
std::string bandsPicture(int bandCount);
std::string waveletsPicture(std::size_t count);
std::string bandsSphere(int bandCount);

}  // namespace prt::cli
