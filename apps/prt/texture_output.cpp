#include "apps/prt/texture_output.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/common/text.h"
#include "prt/base/error.h"
#include "prt/base/file.h"
#include "prt/compress/transfer_textures.h"
#include "prt/io/image_io.h"

namespace prt::cli {
namespace {

using Json = nlohmann::ordered_json;

/// A layer whose receivers fill a grid: the last one is repeated.
TransferLayer fillGrid(const CompressedTransfer& transfer, std::size_t texelCount) {
    const CompressedLayer& layer = transfer.layers.front();
    const std::size_t rowLength = coefficientsPerReceiver(transfer.bandCount, layer);
    std::vector<float> rows = expandLayer(layer);
    const std::vector<float> last(rows.end() - static_cast<std::ptrdiff_t>(rowLength), rows.end());
    while (rows.size() < texelCount * rowLength)
        rows.insert(rows.end(), last.begin(), last.end());
    return {layer.transport, layer.channelCount, makeTable(rowLength, rows),
            layer.incidentBandCount};
}

Rgba8Image makeImage(const TransferTextures& textures, std::size_t index) {
    Rgba8Image image(textures.width, textures.height);
    const std::span<const std::byte> texels = textures.texture(index);
    std::memcpy(image.pixels.data(), texels.data(), texels.size());
    return image;
}

std::string textureName(std::size_t index) {
    return fmt::format("transfer-{:02}.png", index);
}

Json describe(const std::vector<float>& numbers) {
    Json json = Json::array();
    for (const float number : numbers)
        json.push_back(withDigitsOf(number));
    return json;
}

std::string describe(const TransferTextures& textures, std::size_t vertexCount) {
    Json json = {{"transport", transportName(textures.transport)},
                 {"bands", textures.bandCount},
                 {"convention", "cs"},
                 {"channels", textures.channelCount},
                 {"vertices", vertexCount},
                 {"width", textures.width},
                 {"height", textures.height},
                 {"coefficients", textures.coefficients},
                 {"scale", describe(textures.table.scale)},
                 {"bias", describe(textures.table.bias)}};
    if (textures.leftOut)
        json["left_out"] = {{"coefficient", textures.leftOut->index},
                            {"mean", describe(textures.leftOut->mean)},
                            {"rmse", textures.leftOut->rmse},
                            {"largest_error", textures.leftOut->largestError}};
    for (std::size_t i = 0; i < textures.textureCount(); ++i)
        json["textures"].push_back(textureName(i));
    return json.dump(2) + "\n";
}

}  // namespace

void checkFillsTextures(const CompressedTransfer& transfer, const std::string& asset) {
    if (transfer.bandCount < 2 || transfer.receiverCount == 0)
        throw Error(ErrorCode::invalidOption,
                    transfer.receiverCount == 0 ? "has no vertices to fill a texture"
                                                : "has a single band, which fills no texture",
                    asset, "leave --textures out");
}

void writeTransferTextures(const std::filesystem::path& folder,
                           const CompressedTransfer& transfer) {
    const std::size_t vertexCount = transfer.receiverCount;
    const auto width = static_cast<std::size_t>(std::ceil(std::sqrt(vertexCount)));
    const std::size_t height = (vertexCount + width - 1) / width;
    const TransferTextures textures =
        packTransferTextures(fillGrid(transfer, width * height), transfer.bandCount,
                             static_cast<int>(width), static_cast<int>(height));
    for (std::size_t i = 0; i < textures.textureCount(); ++i)
        writePng(folder / textureName(i), makeImage(textures, i));
    writeFileAtomically(folder / "textures.json", describe(textures, vertexCount));
}

}  // namespace prt::cli
