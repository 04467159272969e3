#include "apps/prt/light_report.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "apps/common/picture.h"
#include "prt/base/file.h"
#include "prt/image/false_color.h"
#include "prt/image/tone_curve.h"
#include "prt/io/environment_io.h"
#include "prt/io/image_io.h"
#include "prt/light/deringing.h"
#include "prt/light/environment.h"
#include "prt/light/resampling.h"
#include "prt/light/wavelet_lighting.h"

namespace prt::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kPictureWidth = 512;
constexpr int kSphereSize = 256;
constexpr int kSphereBandCounts[] = {1, 2, 3};

/// The largest channel of the lighting's mean radiance, by which radiance is told.
double findScale(const Lighting& lighting) {
    const Vec3d mean = lighting.coefficients[0] * (0.5 * std::numbers::inv_sqrtpi);
    const double largest = std::max({mean.x, mean.y, mean.z});
    return largest > 0.0 ? largest : 1.0;
}

double lowestChannel(const Vec3d& radiance) {
    return std::min({radiance.x, radiance.y, radiance.z});
}

/// The lowest radiance of the first 1, 2, … bands over the mean radiance, each band times its
/// factor.
std::vector<double> findLowest(const Lighting& lighting, std::span<const double> factors) {
    constexpr int kHeight = 128;
    const auto bandCount = static_cast<std::size_t>(lighting.bandCount);
    std::vector<double> lowest(bandCount, std::numeric_limits<double>::max());
    std::vector<double> values(lighting.coefficients.size());
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < 2 * kHeight; ++x) {
            evaluateSh(sphereTexel(SphereMap::latLong, 2 * kHeight, kHeight, x, y).direction,
                       lighting.bandCount, values);
            Vec3d radiance(0.0);
            std::size_t i = 0;
            for (std::size_t l = 0; l < bandCount; ++l) {
                Vec3d band(0.0);
                for (; i < (l + 1) * (l + 1); ++i)
                    band += lighting.coefficients[i] * values[i];
                radiance += band * factors[l];
                lowest[l] = std::min(lowest[l], lowestChannel(radiance));
            }
        }
    for (double& radiance : lowest)
        radiance /= findScale(lighting);
    return lowest;
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
    const auto lowest = findLowest(report.lighting, std::vector<double>(kReportBandCount, 1.0));
    std::vector<BandFinding> findings;
    double held = 0.0;
    for (int bandCount = 1; bandCount <= kReportBandCount && whole > 0.0; ++bandCount) {
        const double energy = sumBandSquares(report.lighting, bandCount - 1);
        held += energy;
        findings.push_back({bandCount, energy / whole, std::sqrt(std::max(0.0, 1.0 - held / whole)),
                            lowest[static_cast<std::size_t>(bandCount - 1)]});
    }
    return findings;
}

std::vector<RingingFinding> examineRinging(const Lighting& lighting) {
    std::vector<RingingFinding> findings;
    for (int bandCount = 2; bandCount <= kMaxBandCount; ++bandCount) {
        const Lighting bands = truncate(lighting, bandCount);
        const auto lowestUnder = [&](std::span<const double> factors) {
            return findLowest(bands, factors).back();
        };
        const auto automatic = deringingFactors(bands);
        findings.push_back({bandCount, lowestUnder(windowFactors(ShWindow::none, bandCount)),
                            lowestUnder(windowFactors(ShWindow::hann, bandCount)),
                            lowestUnder(windowFactors(ShWindow::lanczos, bandCount)),
                            lowestUnder(automatic), automatic.back()});
    }
    return findings;
}

WaveletLighting projectWaveletsOf(const Image& latLong) {
    constexpr int kFaceSize = 64;
    return projectWavelets(resample({SphereMap::latLong, latLong}, SphereMap::verticalStrip,
                                    kFaceSize, 6 * kFaceSize));
}

/// The light in its largest Haar wavelets, as lat-long; black where it would be negative.
Image drawLargestWavelets(const WaveletLighting& wavelets, std::size_t count) {
    Environment cube = reconstructCube(expand(selectLargest(wavelets, count)));
    for (Vec3f& texel : cube.radiance.pixels)
        texel = Vec3f(std::max(texel.x, 0.0f), std::max(texel.y, 0.0f), std::max(texel.z, 0.0f));
    return resample(cube, SphereMap::latLong, kPictureWidth, kPictureWidth / 2).radiance;
}

/// A unit sphere before the camera, which looks along −z.
///
/// @param latLong    what is seen of the sphere, by the direction that `lookUp` makes of a normal
Image drawSphere(const Image& latLong, const std::function<Vec3d(const Vec3d& normal)>& lookUp) {
    constexpr int kSplit = 3;
    constexpr double kRadius = 0.96;  // of the picture's half side
    const Environment environment{SphereMap::latLong, latLong};
    Image image(kSphereSize, kSphereSize);
    for (int y = 0; y < kSphereSize; ++y)
        for (int x = 0; x < kSphereSize; ++x) {
            Vec3f sum(0.0f);
            for (int k = 0; k < kSplit * kSplit; ++k) {
                const double u = 2.0 * (x + (k % kSplit + 0.5) / kSplit) / kSphereSize - 1.0;
                const double v = 1.0 - 2.0 * (y + (k / kSplit + 0.5) / kSplit) / kSphereSize;
                const double height2 = 1.0 - (u * u + v * v) / (kRadius * kRadius);
                if (height2 <= 0.0) continue;
                const Vec3d normal(u / kRadius, v / kRadius, std::sqrt(height2));
                sum += lookUpRadiance(environment, Vec3f(lookUp(normal)));
            }
            image.at(x, y) = sum / (kSplit * kSplit);
        }
    return image;
}

/// A white diffuse sphere lit by the coefficients, unshadowed.
Image drawLitSphere(const Lighting& lighting) {
    const Lighting reflected = scale(convolveWithCosine(lighting), std::numbers::inv_pi);
    return drawSphere(reconstructLatLong(reflected, kPictureWidth),
                      [](const Vec3d& normal) { return normal; });
}

Image drawMirrorSphere(const Image& latLong) {
    return drawSphere(latLong, [](const Vec3d& normal) {
        const Vec3d toCamera(0.0, 0.0, 1.0);
        return normal * (2.0 * normal.dot(toCamera)) - toCamera;
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

LightFindings examineLight(const LightReport& report, const WaveletLighting& wavelets) {
    LightFindings findings;
    findings.meanRadiance = report.lighting.coefficients[0] * (0.5 * std::numbers::inv_sqrtpi);
    for (const Vec3f& pixel : report.picture.pixels)
        findings.largestLuminance = std::max(findings.largestLuminance, luminance(Vec3d(pixel)));
    findings.exposureStops = chooseExposure(report.lighting);
    findings.bands = examineBands(report);
    findings.ringing = examineRinging(report.lighting);
    findings.waveletErrors = selectionErrors(wavelets.coefficients, kPicturedWaveletCounts);
    constexpr int kIrradianceBandCount = 5;
    findings.irradiance = measureIrradianceErrors(report.lighting, kIrradianceBandCount);
    findings.worstIrradiance = worstIrradianceErrors(kIrradianceBandCount);
    return findings;
}

}  // namespace

std::string bandsPicture(int bandCount) {
    return fmt::format("bands-{:02}", bandCount);
}

std::string waveletsPicture(std::size_t count) {
    return fmt::format("wavelets-{:05}", count);
}

std::string bandsSphere(int bandCount) {
    return fmt::format("sphere-bands-{}", bandCount);
}

void writeLightReport(const fs::path& folder, const LightReport& report) {
    const WaveletLighting wavelets = projectWaveletsOf(report.picture);
    const LightFindings findings = examineLight(report, wavelets);
    const DisplayOptions display{.exposureStops = findings.exposureStops};
    const auto write = [&](const std::string& name, const Image& radiance) {
        writePng(folder / (name + ".png"), encodeForDisplay(radiance, display));
    };
    write(kOriginalPicture, report.picture);
    for (const int bandCount : kPicturedBandCounts)
        write(bandsPicture(bandCount),
              reconstructLatLong(truncate(report.lighting, bandCount), kPictureWidth));
    for (const std::size_t count : kPicturedWaveletCounts)
        write(waveletsPicture(count), drawLargestWavelets(wavelets, count));
    write(kPrintedPicture, reconstructLatLong(report.printed, kPictureWidth));
    const Lighting plain = truncate(report.lighting, report.printed.bandCount);
    writePng(folder / (std::string(kPlainSigns) + ".png"), drawSigns(plain));
    writePng(folder / (std::string(kPrintedSigns) + ".png"), drawSigns(report.printed));
    write(kMirrorSphere, drawMirrorSphere(report.picture));
    write(kExactSphere, drawLitSphere(truncate(report.lighting, kMaxBandCount)));
    for (const int bandCount : kSphereBandCounts)
        write(bandsSphere(bandCount), drawLitSphere(truncate(report.lighting, bandCount)));
    write(kPrintedSphere, drawLitSphere(report.printed));
    writeFileAtomically(folder / "lighting.json", lightingToJson(report.printed));
    writeFileAtomically(folder / "index.html", formatLightPage(report, findings));
}

}  // namespace prt::cli
