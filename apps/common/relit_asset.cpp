#include "apps/common/relit_asset.h"

#include <algorithm>
#include <memory>
#include <span>

#include <fmt/format.h>

#include "apps/common/text.h"
#include "prt/base/error.h"
#include "prt/brdf/band_limit.h"
#include "prt/compress/compress_transfer.h"
#include "prt/io/image_io.h"
#include "prt/parallel/parallel_for.h"
#include "prt/relight/receiver_deringing.h"
#include "prt/transport/unshadowed.h"

namespace prt::cli {
namespace {

[[noreturn]] void throwLacking(ShownTransport shown, const std::string& path) {
    throw Error(ErrorCode::invalidOption,
                fmt::format("was baked without {} transport", shownTransportName(shown)), path,
                fmt::format("bake it with --transport {}", shown == ShownTransport::glossyUnshadowed
                                                               ? "glossy"
                                                               : shownTransportName(shown)));
}

CompressedTransfer storeAsFloats(const TransferField& field) {
    return compressTransfer(field, {.encoding = TransferEncoding::float32});
}

Relighter makeRelighter(const Asset& asset, const std::string& path, ShownTransport shown) {
    if (const CompressedLayer* layer = findShownLayer(asset.transfer, shown))
        return Relighter(asset.transfer, layer->transport);
    if (shown != ShownTransport::unshadowed) throwLacking(shown, path);
    return Relighter(storeAsFloats(makeUnshadowedTransfer(asset.scene, asset.transfer.bandCount)),
                     Transport::unshadowed);
}

/// Of the layer that is shown, or of any that has some.
int findIncidentBandCount(const CompressedTransfer& transfer, ShownTransport shown) {
    if (const CompressedLayer* layer = findShownLayer(transfer, shown))
        return layer->incidentBandCount;
    return std::find_if(transfer.layers.begin(), transfer.layers.end(),
                        [](const CompressedLayer& layer) { return isGlossy(layer.transport); })
        ->incidentBandCount;
}

}  // namespace

Asset readShownAsset(const std::string& path, const ImageLimits& limits) {
    Asset asset = readAsset(path);
    if (asset.scene.triangleCount() == 0)
        throw Error(ErrorCode::malformed, "has no triangles to show", path);
    decodeTextures(asset.scene, limits);
    return asset;
}

ShownTransport chooseShown(const Asset& asset, const std::string& path,
                           std::optional<ShownTransport> asked, const GivenBrdfs& brdfs) {
    const ShownTransport shown = asked.value_or(fullestShown(asset.transfer));
    if (!isAvailable(asset.transfer, shown)) throwLacking(shown, path);
    if (brdfs.empty() || isGlossy(shown)) return shown;
    if (!isAvailable(asset.transfer, ShownTransport::glossyUnshadowed))
        throwLacking(ShownTransport::glossy, path);
    throw Error(ErrorCode::invalidOption,
                fmt::format("is not shown by {} transport, for which all surfaces are diffuse",
                            shownTransportName(shown)),
                "--brdf", "show --transport glossy");
}

std::vector<std::string> describeLostLobes(const Asset& asset, ShownTransport shown,
                                           const GivenBrdfs& brdfs) {
    std::vector<std::string> sentences;
    for (auto brdf = brdfs.begin(); brdf != brdfs.end(); ++brdf) {
        if (!*brdf || std::find(brdfs.begin(), brdf, *brdf) != brdf) continue;
        const int bandCount = findIncidentBandCount(asset.transfer, shown);
        const double lost =
            measureBandLimitError(**brdf, {.incidentBandCount = bandCount, .viewBandCount = 1})
                .incident;
        if (lost <= kMostLobeError) continue;
        const Material& first =
            asset.scene.materials[static_cast<std::size_t>(brdf - brdfs.begin())];
        sentences.push_back(
            fmt::format("{} lose {:.0f} % of the lobe that --brdf gives {} (see prt brdf --help)",
                        formatCount(static_cast<std::uint64_t>(bandCount), "band"), 100.0 * lost,
                        first.name.empty() ? "a material" : first.name));
    }
    return sentences;
}

AssetRelighter::AssetRelighter(const Asset& asset, std::string path, GivenBrdfs brdfs,
                               int threadCount, std::shared_ptr<SurfaceTables> tables)
    : asset_(asset),
      path_(std::move(path)),
      brdfs_(std::move(brdfs)),
      threadCount_(threadCount),
      tables_(tables ? std::move(tables) : std::make_shared<SurfaceTables>()) {}

AssetRelighter::~AssetRelighter() = default;

std::vector<ExitRadiance> AssetRelighter::relight(ShownTransport shown, const Lighting& lighting,
                                                  const Vec3f& eye) {
    // The receivers of an asset, and of what its normals tell, are its vertices.
    std::vector<ExitRadiance> exit(asset_.scene.vertexCount());
    if (isGlossy(shown)) {
        // One part a thread: each makes ready for the light, which with clusters is most of the
        // work.
        const auto threadCount = static_cast<std::size_t>(resolveThreadCount(threadCount_));
        const std::size_t chunk =
            (exit.size() / threadCount / kGlossyPartSize + 1) * kGlossyPartSize;
        const GlossyRelighter& relighter = glossyRelighter(shown);
        parallelFor(exit.size(), {threadCount_, chunk}, [&](std::size_t begin, std::size_t end) {
            relighter.relight(lighting, eye, begin, std::span(exit).subspan(begin, end - begin));
        });
        return exit;
    }
    std::vector<Vec3f> radiance(exit.size());
    relightVectors(shown, lighting, radiance);
    for (std::size_t i = 0; i < exit.size(); ++i)
        exit[i].perBaseColor = radiance[i];
    return exit;
}

void AssetRelighter::relightVectors(ShownTransport shown, const Lighting& lighting,
                                    std::span<Vec3f> radiance) {
    if (!lastOfVectors_ || lastOfVectors_->first != shown) {
        lastOfVectors_.reset();  // before there are two
        lastOfVectors_.emplace(shown, makeRelighter(asset_, path_, shown));
    }
    const Relighter& relighter = lastOfVectors_->second;
    parallelFor(radiance.size(), {threadCount_, kRelightPartSize},
                [&](std::size_t begin, std::size_t end) {
                    relighter.relight(lighting, begin, radiance.subspan(begin, end - begin));
                });
}

const GlossyRelighter& AssetRelighter::glossyRelighter(ShownTransport shown) {
    if (!lastGlossy_ || lastGlossy_->first != shown) {
        lastGlossy_.reset();  // before there are two
        lastGlossy_.emplace(shown, makeGlossyRelighter<GlossyRelighter>(shown));
    }
    return lastGlossy_->second;
}

AssetRelighter::GlossyInputs AssetRelighter::prepareGlossy(ShownTransport shown) {
    if (!isAvailable(asset_.transfer, shown)) throwLacking(shown, path_);
    const int incidentBandCount = findIncidentBandCount(asset_.transfer, shown);
    GlossyInputs inputs{
        .layer = shown == ShownTransport::glossy ? Transport::glossy : Transport::glossyShadowed,
        .views = tables_->views(incidentBandCount),
        .options = {.leastRoughness = tables_->leastRoughness(incidentBandCount),
                    .materialTables = makeViewTables(brdfs_, incidentBandCount)}};
    if (shown == ShownTransport::glossyUnshadowed)
        inputs.ofNormals = storeAsFloats(
            makeUnshadowedMatrices(asset_.scene, asset_.transfer.bandCount, incidentBandCount));
    inputs.receivers =
        describeReceivers(asset_.scene, inputs.ofNormals ? *inputs.ofNormals : asset_.transfer);
    return inputs;
}

bool hasMirrors(const std::vector<ExitRadiance>& vertexRadiance) {
    return std::any_of(vertexRadiance.begin(), vertexRadiance.end(),
                       [](const ExitRadiance& exit) { return exit.mirrorVisibility > 0.0f; });
}

std::vector<double> deringForAsset(const Asset& asset, const std::string& path,
                                   ShownTransport shown, const Lighting& lighting) {
    if (isGlossy(shown))
        throw Error(ErrorCode::invalidOption,
                    "auto cannot tell what surfaces that are not diffuse reflect", "--window",
                    "name a window, or show --transport interreflected");
    // Eight bits a coefficient, and clusters, make more noise than the library's tolerance, which
    // is for sixteen bits.
    constexpr double kToleranceOfNoise = 1e-2;
    const CompressedLayer* layer = findShownLayer(asset.transfer, shown);
    ReceiverDeringingOptions options;
    if (layer && (layer->bases || layer->table.encoding == TransferEncoding::unorm8))
        options.tolerance = kToleranceOfNoise;
    return deringingFactors(makeRelighter(asset, path, shown), lighting, options);
}

std::vector<double> deringForAsset(const Asset& asset, const std::string& path,
                                   const Lighting& lighting) {
    auto shown = ShownTransport::interreflected;
    while (!isAvailable(asset.transfer, shown))
        shown = static_cast<ShownTransport>(static_cast<int>(shown) - 1);
    return deringForAsset(asset, path, shown, lighting);
}

}  // namespace prt::cli
