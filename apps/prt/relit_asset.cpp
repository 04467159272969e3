#include "apps/prt/relit_asset.h"

#include <algorithm>

#include <fmt/format.h>

#include "prt/base/error.h"
#include "prt/compress/compress_transfer.h"
#include "prt/io/image_io.h"
#include "prt/relight/receiver_deringing.h"
#include "prt/transport/unshadowed.h"

namespace prt::cli {
namespace {

Relighter makeRelighter(const Asset& asset, const std::string& path, Transport transport) {
    if (asset.transfer.findLayer(transport)) return Relighter(asset.transfer, transport);
    if (transport == Transport::unshadowed)
        return Relighter(
            compressTransfer(makeUnshadowedTransfer(asset.scene, asset.transfer.bandCount),
                             {.encoding = TransferEncoding::float32}),
            transport);
    throw Error(ErrorCode::invalidOption,
                fmt::format("was baked without {} transport", transportName(transport)), path,
                fmt::format("bake it with --transport {}", transportName(transport)));
}

}  // namespace

Asset readPreparedAsset(const std::string& path, const ImageLimits& limits, StageLog& log) {
    const Stopwatch watch;
    Asset asset = readAsset(path);
    if (asset.scene.triangleCount() == 0)
        throw Error(ErrorCode::malformed, "has no triangles to show", path);
    decodeTextures(asset.scene, limits);
    for (const std::string& warning : asset.scene.warnings)
        log.warn(path + ": " + warning);
    log.finishStage("load", watch.seconds(), path);
    return asset;
}

Transport fullestTransport(const CompressedTransfer& transfer) {
    Transport fullest = Transport::unshadowed;
    for (const CompressedLayer& layer : transfer.layers)
        fullest = std::max(fullest, layer.transport);
    return fullest;
}

std::vector<Vec3f> relightVertices(const Asset& asset, const std::string& path, Transport transport,
                                   const Lighting& lighting) {
    // The receivers of an asset, and of unshadowed transfer, are its vertices.
    const Relighter relighter = makeRelighter(asset, path, transport);
    std::vector<Vec3f> radiance(relighter.receiverCount());
    relighter.relight(lighting, radiance);
    return radiance;
}

std::vector<double> deringForAsset(const Asset& asset, const std::string& path, Transport transport,
                                   const Lighting& lighting) {
    // Eight bits a coefficient, and clusters, make more noise than the library's tolerance, which
    // is for sixteen bits.
    constexpr double kToleranceOfNoise = 1e-2;
    const CompressedLayer* layer = asset.transfer.findLayer(transport);
    ReceiverDeringingOptions options;
    if (layer && (layer->bases || layer->table.encoding == TransferEncoding::unorm8))
        options.tolerance = kToleranceOfNoise;
    return deringingFactors(makeRelighter(asset, path, transport), lighting, options);
}

}  // namespace prt::cli
