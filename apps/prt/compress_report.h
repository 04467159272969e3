#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/prt/compress_trials.h"
#include "apps/prt/view_options.h"
#include "prt/asset/asset.h"
#include "prt/image/image.h"

namespace prt::cli {

/// What a report on compression is asked for.
struct CompressReportArguments {
    std::string folder{};  ///< empty: no report
    std::string light{};   ///< LIGHT
    ViewArguments view{.size = {640, 360}};
};

/// Clusters with few vectors each, as [Kautz04] shows them.
struct FewVectorsTrial {
    std::size_t vectorCount = 0;  ///< of a cluster, its mean counted
    std::size_t bytes = 0;        ///< with weights as floats and clusters as bytes, as published
    double psnr = 0.0;            ///< decibels, of the pictures for the screen
    CompressionError error{};
    Image picture{};
};

/// A vertex that compression has served ill.
struct WorstVertex {
    std::size_t vertex = 0;
    Vec3f position{0.0f, 0.0f, 0.0f};
    double error = 0.0;  ///< of its radiance, over the mean of all
};

/// All about one compressed layer.
struct CompressReport {
    std::string asset{};    ///< that was written
    std::string source{};   ///< that it was made from
    std::string command{};  ///< that makes the report again
    std::string lightName{};
    Transport transport = Transport::interreflected;
    std::size_t vertexCount = 0;
    std::size_t dimension = 0;  ///< numbers of a transfer vector, all channels
    int bandCount = 0;
    float exposureStops = 0.0f;
    CompressionTrial chosen{};
    double relitRmse = 0.0;  ///< of the vertices' radiance under this light, over its mean
    double psnr = 0.0;       ///< decibels, of the two pictures for the screen
    Image original{};
    Image compressed{};
    Image vertexErrors{};  ///< of their radiance, over its mean; grey
    std::vector<WorstVertex> worst{};
    std::vector<CompressionTrial> trials{};
    std::vector<FewVectorsTrial> fewVectors{};
};

/// Holds a compressed layer against the original, and every other method against both.
///
/// @param original    textures decoded; with one layer, of floats
/// @param compressed  the same layer as it is written
/// @param options     with which that was made
/// @param light       under which errors are seen and pictures taken
CompressReport examineCompression(const Asset& original, const CompressedTransfer& compressed,
                                  const CompressOptions& options, const Lighting& light,
                                  const ViewArguments& view, StageLog& log);

/// Writes the page index.html, the numbers compression.json and all pictures into a folder.
/// @throws Error writeFailed
void writeCompressReport(const std::filesystem::path& folder, const CompressReport& report);

/// The page alone, as HTML that needs no network.
std::string formatCompressPage(const CompressReport& report);

// Names of its pictures, without ".png".
inline constexpr const char* kOriginalTransfer = "original";
inline constexpr const char* kCompressedTransfer = "compressed";
inline constexpr const char* kVertexErrors = "vertex-errors";
std::string fewVectorsPicture(std::size_t vectorCount);

/// What the strongest colour of the vertices' errors stands for, a part of the mean radiance.
float vertexErrorScale(const CompressReport& report);

}  // namespace prt::cli
