#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/common/shown_transport.h"
#include "prt/asset/asset.h"
#include "prt/render/comparison.h"

namespace prt::cli {

/// A picture, and how it compares with a reference.
struct JudgedPicture {
    Image picture;
    PictureComparison comparison;
};

/// A path-traced reference, and how the relit asset compares with it.
struct JudgedReference {
    Image radiance;
    PictureComparison comparison;
    NoisyError atVertices;
    std::size_t vertexCount = 0;              ///< of those compared
    std::vector<MaterialError> byMaterial{};  ///< of surfaces as they are
};

/// All about one light.
struct ReportLight {
    std::string name{};
    int bandCount = 0;  ///< of the lighting that relights
    Image relit{};
    std::optional<Image>
        relitInBands{};           ///< where mirror-like surfaces show the light in its bands
    JudgedReference sameBands{};  ///< under the light in these bands
    JudgedReference itself{};     ///< under the light as it is
    std::vector<std::pair<int, JudgedPicture>> byBandCount{};  ///< against the light as it is
    std::vector<std::pair<ShownTransport, JudgedPicture>>
        byTransport{};  ///< against the same bands
};

/// A material as its factors describe it.
struct ReportMaterial {
    std::string name{};
    MetallicRoughness surface{};
    bool isTextured = false;  ///< the factors are of a texture
    bool isReplaced = false;  ///< by a BRDF given
};

/// What `prt compare` has found out.
struct Report {
    std::string asset{};
    std::string command{};  ///< that makes the report again
    Provenance provenance{};
    std::size_t vertexCount = 0;
    std::size_t triangleCount = 0;
    std::size_t assetBytes = 0;
    std::size_t bytesPerVertex = 0;  ///< of the layer shown
    ShownTransport transport = ShownTransport::interreflected;
    std::vector<ReportMaterial> materials{};  ///< of the scene; of surfaces as they are
    int referenceSamples = 0;                 ///< paths a pixel
    int bounceCount = 0;                      ///< of the references; kUnlimitedBounces for all
    DisplayOptions display{};
    std::vector<ReportLight> lights{};
    std::vector<std::pair<std::string, double>> seconds{};
};

/// Writes the page index.html, the numbers comparison.json and all pictures into a folder.
/// @throws Error writeFailed
void writeReport(const std::filesystem::path& folder, const Report& report);

/// The page alone, as HTML that needs no network.
std::string formatReportPage(const Report& report);

/// The numbers alone, as JSON.
std::string formatReportNumbers(const Report& report);

// Names of the pictures of a report, which its page shows.
std::string pictureName(std::size_t lightIndex, const std::string& kind);  ///< without a suffix
inline constexpr const char* kRelit = "relit";
inline constexpr const char* kRelitInBands = "relit-in-bands";
inline constexpr const char* kSameBands = "path-traced-in-bands";
inline constexpr const char* kItself = "path-traced";
std::string bandPictureKind(int bandCount);

/// The luminance that the strongest colours of difference pictures stand for.
float differenceScale(const ReportLight& light);

}  // namespace prt::cli
