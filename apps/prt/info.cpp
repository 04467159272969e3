#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "apps/common/text.h"
#include "apps/prt/commands.h"
#include "apps/prt/mirror_like.h"
#include "prt/asset/asset.h"
#include "prt/basis/sh.h"

namespace prt::cli {
namespace {

struct InfoArguments {
    std::string asset;
    bool json = false;
};

void printRow(std::string_view name, const std::string& value) {
    fmt::print("{:<12} {}\n", name, value);
}

void printScene(const Scene& scene) {
    printRow("scene", fmt::format("{}, {}, {}", formatCount(scene.meshes.size(), "mesh"),
                                  formatCount(scene.vertexCount(), "vertex"),
                                  formatCount(scene.triangleCount(), "triangle")));
    printRow("", fmt::format("{}, {}, {}", formatCount(scene.materials.size(), "material"),
                             formatCount(scene.images.size(), "image"),
                             formatCount(scene.cameras.size(), "camera")));
    for (const Camera& camera : scene.cameras)
        printRow("camera", camera.name);
}

void printProvenance(const Provenance& provenance) {
    printRow("made by", provenance.generator);
    printRow("with", provenance.command);
    printRow("samples",
             fmt::format("{} a vertex",
                         formatCount(static_cast<std::uint64_t>(provenance.sampleCount), "ray")));
    printRow("bounces", std::to_string(provenance.bounceCount));
    printRow("seed", std::to_string(provenance.seed));
    printRow("isa", provenance.isa);
}

void printMirrorLike(const MirrorLike& mirrorLike) {
    std::string names;
    for (const std::string& name : mirrorLike.materials)
        names += (names.empty() ? "" : ", ") + name;
    const std::string limit = fmt::format("(roughness under {:.2f})", mirrorLike.leastRoughness);
    if (names.empty())
        printRow("mirror-like", "no material " + limit);
    else
        printRow("mirror-like",
                 names + " " + limit +
                     (mirrorLike.isSplitOff ? ": their specular light is taken from the environment"
                                            : ": what they mirror is blurred to the bands"));
}

void printTransfer(const CompressedTransfer& transfer) {
    printRow(
        "bands",
        fmt::format("{} ({} a channel)", transfer.bandCount,
                    formatCount(static_cast<std::uint64_t>(shCoefficientCount(transfer.bandCount)),
                                "coefficient")));
    fmt::print("\n{:<16} {:>8} {:>14} {:>10} {:>8} {:>10} {:>14} {:>10} {:>10}\n", "layer",
               "channels", "incident bands", "encoding", "clusters", "components", "bytes/vertex",
               "bytes", "and bases");
    for (const CompressedLayer& layer : transfer.layers)
        fmt::print("{:<16} {:>8} {:>14} {:>10} {:>8} {:>10} {:>14} {:>10} {:>10}\n",
                   transportName(layer.transport), layer.channelCount,
                   isGlossy(layer.transport) ? std::to_string(layer.incidentBandCount) : "",
                   encodingName(layer.table.encoding),
                   layer.bases ? formatCount(layer.bases->clusterCount()) : "",
                   layer.bases ? formatCount(layer.bases->componentCount()) : "",
                   bytesPerReceiver(layer), formatBytes(layer.table.numbers.byteCount()),
                   layer.bases ? formatBytes(countSharedBytes(layer)) : "");
}

void printTable(const std::string& path, const Asset& asset,
                const std::optional<MirrorLike>& mirrorLike) {
    printRow("asset", fmt::format("{}, {}", path, formatBytes(std::filesystem::file_size(path))));
    printScene(asset.scene);
    printProvenance(asset.provenance);
    if (mirrorLike) printMirrorLike(*mirrorLike);
    printTransfer(asset.transfer);
}

nlohmann::ordered_json describeLayers(const CompressedTransfer& transfer) {
    auto layers = nlohmann::ordered_json::array();
    for (const CompressedLayer& layer : transfer.layers) {
        layers.push_back({{"transport", transportName(layer.transport)},
                          {"channels", layer.channelCount},
                          {"encoding", encodingName(layer.table.encoding)},
                          {"bytes_per_vertex", bytesPerReceiver(layer)},
                          {"bytes", layer.table.numbers.byteCount()}});
        if (isGlossy(layer.transport)) layers.back()["incident_bands"] = layer.incidentBandCount;
        if (!layer.bases) continue;
        layers.back()["clusters"] = layer.bases->clusterCount();
        layers.back()["components"] = layer.bases->componentCount();
        layers.back()["vectors"] = layer.bases->vectors.numbers.rowCount();
        layers.back()["bases_encoding"] = encodingName(layer.bases->vectors.encoding);
        layers.back()["shared_bytes"] = countSharedBytes(layer);
    }
    return layers;
}

void printJson(const std::string& path, const Asset& asset,
               const std::optional<MirrorLike>& mirrorLike) {
    auto cameras = nlohmann::ordered_json::array();
    for (const Camera& camera : asset.scene.cameras)
        cameras.push_back(camera.name);
    const Provenance& provenance = asset.provenance;
    nlohmann::ordered_json json = {
        {"asset", path},
        {"bytes", std::filesystem::file_size(path)},
        {"meshes", asset.scene.meshes.size()},
        {"vertices", asset.scene.vertexCount()},
        {"triangles", asset.scene.triangleCount()},
        {"materials", asset.scene.materials.size()},
        {"images", asset.scene.images.size()},
        {"cameras", cameras},
        {"bands", asset.transfer.bandCount},
        {"layers", describeLayers(asset.transfer)},
        {"provenance",
         {{"generator", provenance.generator},
          {"command", provenance.command},
          {"samples", provenance.sampleCount},
          {"bounces", provenance.bounceCount},
          {"seed", provenance.seed},
          {"isa", provenance.isa}}},
    };
    if (mirrorLike)
        json["mirror_like"] = {{"least_roughness", mirrorLike->leastRoughness},
                               {"materials", mirrorLike->materials},
                               {"from_environment", mirrorLike->isSplitOff}};
    fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

}  // namespace

void addInfoCommand(CLI::App& app) {
    const auto arguments = std::make_shared<InfoArguments>();
    CLI::App* command = app.add_subcommand("info", "Show what an asset holds and how it was baked");
    command->footer("Example: prt info statue.prt.glb --json");
    command->add_option("ASSET", arguments->asset, "what prt bake wrote")->required();
    command->add_flag("--json", arguments->json, "the same as JSON");
    command->callback([arguments] {
        Asset asset = readAsset(arguments->asset);
        const std::optional<MirrorLike> mirrorLike = findMirrorLike(asset);
        arguments->json ? printJson(arguments->asset, asset, mirrorLike)
                        : printTable(arguments->asset, asset, mirrorLike);
    });
}

}  // namespace prt::cli
