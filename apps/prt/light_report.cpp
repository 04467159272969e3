#include "apps/prt/light_report.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <fmt/format.h>

#include "prt/base/file.h"
#include "prt/image/false_color.h"
#include "prt/image/tone_curve.h"
#include "prt/io/environment_io.h"
#include "prt/io/image_io.h"
#include "prt/light/analytic_lights.h"
#include "prt/light/environment.h"

namespace prt::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kPictureWidth = 512;
constexpr int kSphereSize = 256;
constexpr int kSphereBandCounts[] = {1, 2, 3};

/// The lowest channel of an image.
double findLowest(const Image& image) {
    float lowest = std::numeric_limits<float>::max();
    for (const Vec3f& pixel : image.pixels)
        lowest = std::min({lowest, pixel.x, pixel.y, pixel.z});
    return static_cast<double>(lowest);
}

/// The largest channel of the lighting's mean radiance, by which radiance is told.
double findScale(const Lighting& lighting) {
    const Vec3d mean = lighting.coefficients[0] * (0.5 * std::numbers::inv_sqrtpi);
    const double largest = std::max({mean.x, mean.y, mean.z});
    return largest > 0.0 ? largest : 1.0;
}

/// The lowest radiance of what coefficients stand for, over the mean radiance.
double findRelativeLowest(const Lighting& lighting) {
    constexpr int kWidth = 256;
    return findLowest(reconstructLatLong(lighting, kWidth)) / findScale(lighting);
}

/// ∫ |L|² dω over all channels: of an image, and of a band.
double integrateSquare(const Image& latLong) {
    double sum = 0.0;
    for (int y = 0; y < latLong.height; ++y) {
        double row = 0.0;
        for (int x = 0; x < latLong.width; ++x)
            row += Vec3d(latLong.at(x, y)).length2();
        sum +=
            row * sphereTexel(SphereMap::latLong, latLong.width, latLong.height, 0, y).solidAngle;
    }
    return sum;
}

double sumBandSquares(const Lighting& lighting, int l) {
    double sum = 0.0;
    for (int m = -l; m <= l; ++m)
        sum += lighting.coefficients[static_cast<std::size_t>(shIndex(l, m))].length2();
    return sum;
}

std::vector<BandFinding> examineBands(const LightReport& report) {
    // A picture is at least as coarse as the light, so what bands hold may exceed its square.
    double inBands = 0.0;
    for (int l = 0; l < kReportBandCount; ++l)
        inBands += sumBandSquares(report.lighting, l);
    const double whole = std::max(integrateSquare(report.picture), inBands);
    std::vector<BandFinding> findings;
    double held = 0.0;
    for (int bandCount = 1; bandCount <= kReportBandCount && whole > 0.0; ++bandCount) {
        const double energy = sumBandSquares(report.lighting, bandCount - 1);
        held += energy;
        findings.push_back({bandCount, energy / whole, std::sqrt(std::max(0.0, 1.0 - held / whole)),
                            findRelativeLowest(truncate(report.lighting, bandCount))});
    }
    return findings;
}

std::vector<RingingFinding> examineRinging(const Lighting& lighting) {
    std::vector<RingingFinding> findings;
    for (int bandCount = 2; bandCount <= kMaxBandCount; ++bandCount) {
        const Lighting plain = truncate(lighting, bandCount);
        const auto lowestUnder = [&](std::span<const double> factors) {
            return findRelativeLowest(applyWindow(plain, factors));
        };
        const auto automatic = deringingFactors(plain);
        findings.push_back({bandCount, findRelativeLowest(plain),
                            lowestUnder(windowFactors(ShWindow::hann, bandCount)),
                            lowestUnder(windowFactors(ShWindow::lanczos, bandCount)),
                            lowestUnder(automatic), automatic.back()});
    }
    return findings;
}

/// The exposure under which the brightest side of a white diffuse sphere comes to 0.8.
float chooseExposure(const Lighting& lighting) {
    constexpr double kBrightest = 0.8;
    double brightest = 0.0;
    const Image irradiance = reconstructLatLong(convolveWithCosine(truncate(lighting, 3)), 64);
    for (const Vec3f& value : irradiance.pixels)
        brightest = std::max(brightest, luminance(Vec3d(value)) * std::numbers::inv_pi);
    return brightest > 0.0 ? static_cast<float>(std::log2(kBrightest / brightest)) : 0.0f;
}

/// A unit sphere before the camera, which looks along −z; `shade` gives the radiance at a normal.
Image drawSphere(const std::function<Vec3d(const Vec3d& normal)>& shade) {
    constexpr int kSplit = 3;
    constexpr double kRadius = 0.96;  // of the picture's half side
    Image image(kSphereSize, kSphereSize);
    for (int y = 0; y < kSphereSize; ++y)
        for (int x = 0; x < kSphereSize; ++x) {
            Vec3d sum(0.0);
            for (int k = 0; k < kSplit * kSplit; ++k) {
                const double u = 2.0 * (x + (k % kSplit + 0.5) / kSplit) / kSphereSize - 1.0;
                const double v = 1.0 - 2.0 * (y + (k / kSplit + 0.5) / kSplit) / kSphereSize;
                const double height2 = 1.0 - (u * u + v * v) / (kRadius * kRadius);
                if (height2 > 0.0)
                    sum += shade(Vec3d(u / kRadius, v / kRadius, std::sqrt(height2)));
            }
            image.at(x, y) = Vec3f(sum / (kSplit * kSplit));
        }
    return image;
}

/// A white diffuse sphere lit by the coefficients, unshadowed.
Image drawLitSphere(const Lighting& lighting) {
    const Lighting irradiance = convolveWithCosine(lighting);
    return drawSphere([&](const Vec3d& normal) {
        return reconstruct(irradiance, normal) * std::numbers::inv_pi;
    });
}

Image drawMirrorSphere(const Image& latLong) {
    const Environment environment{SphereMap::latLong, latLong};
    return drawSphere([&](const Vec3d& normal) {
        const Vec3d toCamera(0.0, 0.0, 1.0);
        const Vec3d reflected = normal * (2.0 * normal.dot(toCamera)) - toCamera;
        return Vec3d(lookUpRadiance(environment, Vec3f(reflected)));
    });
}

/// Where a reconstruction is negative, and by how much, as luminance in colours.
Rgba8Image drawSigns(const Lighting& lighting) {
    const Image radiance = reconstructLatLong(lighting, kPictureWidth);
    ImageOf<float> values(radiance.width, radiance.height);
    std::transform(radiance.pixels.begin(), radiance.pixels.end(), values.pixels.begin(),
                   [](const Vec3f& pixel) { return luminance(pixel); });
    const auto scale = static_cast<float>(findScale(lighting));
    return drawFalseColors(values, -scale, scale, signedColors());
}

}  // namespace

std::string bandsPicture(int bandCount) {
    return fmt::format("bands-{:02}", bandCount);
}

std::string bandsSphere(int bandCount) {
    return fmt::format("sphere-bands-{}", bandCount);
}

LightFindings examineLight(const LightReport& report) {
    LightFindings findings;
    findings.meanRadiance = report.lighting.coefficients[0] * (0.5 * std::numbers::inv_sqrtpi);
    for (const Vec3f& pixel : report.picture.pixels)
        findings.largestLuminance = std::max(findings.largestLuminance, luminance(Vec3d(pixel)));
    findings.exposureStops = chooseExposure(report.lighting);
    findings.bands = examineBands(report);
    findings.ringing = examineRinging(report.lighting);
    constexpr int kIrradianceBandCount = 5;
    findings.irradiance = measureIrradianceErrors(report.lighting, kIrradianceBandCount);
    findings.worstIrradiance = measureIrradianceErrors(
        directionalLighting(Vec3d(0, 0, 1), Vec3d(1.0), kReportBandCount), kIrradianceBandCount);
    return findings;
}

void writeLightReport(const fs::path& folder, const LightReport& report) {
    const LightFindings findings = examineLight(report);
    const DisplayOptions display{.exposureStops = findings.exposureStops};
    const auto write = [&](const std::string& name, const Image& radiance) {
        writePng(folder / (name + ".png"), encodeForDisplay(radiance, display));
    };
    write(kOriginalPicture, report.picture);
    for (const int bandCount : kPicturedBandCounts)
        write(bandsPicture(bandCount),
              reconstructLatLong(truncate(report.lighting, bandCount), kPictureWidth));
    write(kPrintedPicture, reconstructLatLong(report.printed, kPictureWidth));
    const Lighting plain = truncate(report.lighting, report.printed.bandCount);
    writePng(folder / (std::string(kPlainSigns) + ".png"), drawSigns(plain));
    writePng(folder / (std::string(kPrintedSigns) + ".png"), drawSigns(report.printed));
    write(kMirrorSphere, drawMirrorSphere(report.picture));
    write(kExactSphere, drawLitSphere(report.lighting));
    for (const int bandCount : kSphereBandCounts)
        write(bandsSphere(bandCount), drawLitSphere(truncate(report.lighting, bandCount)));
    write(kPrintedSphere, drawLitSphere(report.printed));
    writeFileAtomically(folder / "lighting.json", lightingToJson(report.printed));
    writeFileAtomically(folder / "index.html", formatLightPage(report, findings));
}

}  // namespace prt::cli
