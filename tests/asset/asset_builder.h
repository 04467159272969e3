#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "prt/asset/asset.h"
#include "prt/base/checksum.h"
#include "prt/base/random.h"
#include "prt/gltf/glb_writer.h"
#include "tests/gltf/glb_file.h"
#include "tests/support/clustered_layers.h"

namespace prt::test {

/// A grid in the plane y = height, with normals that differ from vertex to vertex.
inline Mesh makeGrid(const std::string& name, int cellCount, float height) {
    Mesh mesh;
    mesh.name = name;
    const auto side = static_cast<std::uint32_t>(cellCount + 1);
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const auto x = static_cast<float>(i % side);
        const auto z = static_cast<float>(i / side);
        mesh.positions.push_back(Vec3f(x, height, z) * 0.3f);
        mesh.normals.push_back(Vec3f(0.1f * x, 1.0f, -0.1f * z).normalized());
    }
    for (std::uint32_t z = 0; z + 1 < side; ++z)
        for (std::uint32_t x = 0; x + 1 < side; ++x) {
            const std::uint32_t corner = z * side + x;
            mesh.indices.insert(mesh.indices.end(), {corner, corner + side, corner + 1, corner + 1,
                                                     corner + side, corner + side + 1});
        }
    return mesh;
}

/// Two meshes, of 9 and of 4 vertices.
inline Scene makeTwoGrids() {
    Scene scene;
    scene.materials.resize(1);
    scene.meshes = {makeGrid("floor", 2, 0.0f), makeGrid("table", 1, 1.0f)};
    return scene;
}

/// No layers yet, and fewer receivers than vertices: some vertices share one.
inline CompressedTransfer makeReceivers(const Scene& scene, int bandCount) {
    CompressedTransfer transfer;
    transfer.bandCount = bandCount;
    transfer.receiverCount = scene.vertexCount() / 2 + 1;
    for (std::size_t vertex = 0; vertex < scene.vertexCount(); ++vertex)
        transfer.receiverOfVertex.push_back(
            static_cast<std::uint32_t>((vertex * 5) % transfer.receiverCount));
    return transfer;
}

/// Random stored numbers in bounds.
inline CompressedTransfer makeTransfer(const Scene& scene, int bandCount, TransferEncoding encoding,
                                       const std::vector<Transport>& transports) {
    CompressedTransfer transfer = makeReceivers(scene, bandCount);
    RandomStream random(7, static_cast<std::uint64_t>(bandCount));
    for (const Transport transport : transports) {
        CompressedLayer layer = makeLayerKind(transport, bandCount);
        layer.table.encoding = encoding;
        const std::size_t rowLength = coefficientsPerReceiver(bandCount, layer);
        const std::size_t byteCount = bytesPerCoefficient(encoding);
        layer.table.numbers = CoefficientTable(transfer.receiverCount, rowLength, byteCount);
        std::vector<std::byte> row(rowLength * byteCount);
        for (std::size_t receiver = 0; receiver < transfer.receiverCount; ++receiver) {
            for (std::size_t begin = 0; begin < row.size(); begin += byteCount) {
                const float value = 0.5f * random.nextUnitFloat() - 0.25f;
                const std::uint32_t bits = random.nextBits();
                const void* source = encoding == TransferEncoding::float32
                                         ? static_cast<const void*>(&value)
                                         : &bits;
                std::memcpy(row.data() + begin, source, byteCount);
            }
            layer.table.numbers.writeRows(receiver, std::span<const std::byte>(row));
        }
        for (std::size_t i = 0; encoding != TransferEncoding::float32 && i < rowLength; ++i) {
            layer.table.scale.push_back(0.3f * random.nextUnitFloat());
            layer.table.bias.push_back(-0.1f * random.nextUnitFloat());
        }
        transfer.layers.push_back(layer);
    }
    return transfer;
}

/// The same with clusters.
inline CompressedTransfer makeClusteredTransfer(const Scene& scene, int bandCount,
                                                const ClusterForm& form,
                                                const std::vector<Transport>& transports) {
    CompressedTransfer transfer = makeReceivers(scene, bandCount);
    for (const Transport transport : transports)
        transfer.layers.push_back(makeClusteredLayer(transport, bandCount, transfer.receiverCount,
                                                     form, transfer.layers.size()));
    return transfer;
}

inline Provenance makeProvenance() {
    Provenance provenance;
    provenance.generator = "OpenPRT 0.1.0";
    provenance.command = "bake --bands 3 --samples 256";
    provenance.sampleCount = 256;
    provenance.bounceCount = 2;
    provenance.seed = 18446744073709551615u;  // no double holds it
    provenance.isa = "avx2";
    return provenance;
}

inline nlohmann::json& headerOf(GlbFile& file) {
    return file.json["extensions"]["OPENPRT_radiance_transfer"];
}

inline std::string checksumOf(std::span<const std::byte> bytes) {
    return formatChecksum(computeCrc32(bytes));
}

/// The numbers of a layer's vectors, as the file holds them.
inline std::span<std::byte> vectorsOf(GlbFile& file, const nlohmann::json& clusters) {
    const nlohmann::json& accessor =
        file.json.at("accessors").at(GlbFile::readSize(clusters.at("accessor")));
    const std::size_t width = accessor.at("componentType") == 5126   ? 4
                              : accessor.at("componentType") == 5123 ? 2
                                                                     : 1;
    const std::span<std::byte> view = file.view(accessor.at("bufferView"));
    return view.first(std::min(GlbFile::readSize(accessor.at("count")), view.size() / width) *
                      width);
}

/// What the checksum of a layer covers of its clusters, the checksum of whose vectors is repaired.
inline std::string repairClusters(GlbFile& file, nlohmann::json& clusters) {
    clusters["checksum"] = checksumOf(vectorsOf(file, clusters));
    std::string text;
    for (const char* key : {"weights", "encoding", "checksum"})
        text += " " + clusters.at(key).get<std::string>();
    for (const nlohmann::json& count : clusters.at("components"))
        text += " " + count.dump();
    return text;
}

/// Makes a layer's checksums fit what the layer says, as docs/format.md defines them.
inline void repairLayer(GlbFile& file, nlohmann::json& layer) {
    std::string bytes =
        layer["transport"].get<std::string>() + " " + layer["encoding"].get<std::string>() + " " +
        layer["channels"].dump() + " " + headerOf(file)["bands"].dump() + " " +
        layer["attributes"]["first"].dump() + " " + layer["attributes"]["count"].dump();
    const bool isGlossy = layer["transport"].get<std::string>().starts_with("glossy");
    if (isGlossy && layer.contains("incidentBands")) bytes += " " + layer["incidentBands"].dump();
    const bool hasClusters = layer["encoding"] == "clusters";
    if (hasClusters) bytes += repairClusters(file, layer.at("clusters"));
    const nlohmann::json& ranged = hasClusters ? layer["clusters"] : layer;
    for (const char* key : {"scale", "bias"}) {
        if (!ranged.contains(key)) continue;
        for (const nlohmann::json& number : ranged[key]) {
            const float value = number.is_number() ? number.get<float>() : std::nanf("");
            bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
        }
    }
    if (layer.contains("largestError") && layer["largestError"].is_number()) {
        const auto error = layer["largestError"].get<float>();
        bytes.append(reinterpret_cast<const char*>(&error), sizeof(error));
    }
    layer["checksum"] = checksumOf(std::as_bytes(std::span(bytes)));
}

/// Makes all checksums of a changed file fit again, as docs/format.md defines them.
inline void repairChecksums(GlbFile& file) {
    nlohmann::json& header = headerOf(file);
    for (std::size_t view = 0; view < header["checksums"].size(); ++view)
        header["checksums"][view] = checksumOf(file.view(view));
    for (nlohmann::json& mesh : file.json["meshes"])
        for (nlohmann::json& primitive : mesh["primitives"])
            for (nlohmann::json& extension : primitive["extensions"])
                for (auto& [semantic, checksum] : extension["checksums"].items())
                    checksum = checksumOf(file.view(primitive["attributes"][semantic]));
    for (nlohmann::json& layer : header["layers"])
        repairLayer(file, layer);
}

/// The same as far as the parts of the file are where they are looked for.
inline void repairWhatCanBe(GlbFile& file) {
    try {
        repairChecksums(file);
    } catch (const nlohmann::json::exception&) {
    } catch (const std::out_of_range&) {
    }
}

}  // namespace prt::test
