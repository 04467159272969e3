#include "prt/asset/asset.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <new>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "prt/asset/asset_header.h"
#include "prt/asset/reject_asset.h"
#include "prt/asset/table_header.h"
#include "prt/base/checksum.h"
#include "prt/base/error.h"
#include "prt/base/file.h"
#include "prt/gltf/glb_writer.h"
#include "prt/gltf/gltf_document.h"
#include "prt/gltf/json_cursor.h"

namespace prt {
namespace {

AssetHeader readHeader(const GltfDocument& document) {
    const std::optional<std::string> json = document.rootExtension(kAssetExtension);
    if (!json)
        throw Error(
            ErrorCode::unsupported,
            std::string("holds no radiance transfer (the glTF extension ") + kAssetExtension + ")",
            {}, "bake it first: prt bake");
    return parseHeader(*json);
}

void checkBufferViews(const GltfDocument& document, const std::vector<std::string>& checksums) {
    if (checksums.size() != document.bufferViewCount())
        rejectAsset("has " + std::to_string(document.bufferViewCount()) + " buffer views, but " +
                    std::to_string(checksums.size()) + " checksums");
    for (std::size_t view = 0; view < checksums.size(); ++view)
        if (checksums[view] != formatChecksum(computeCrc32(document.storedViewBytes(view))))
            rejectAsset("is damaged: the checksum of buffer view " + std::to_string(view) +
                        " differs");
}

/// The attributes of one primitive, each held to the checksum that binds it to the primitive.
class BoundAttributes {
  public:
    BoundAttributes(const GltfDocument& document, const PrimitiveId& id)
        : document_(document),
          id_(id),
          place_("mesh " + std::to_string(id.mesh) + ", primitive " +
                 std::to_string(id.primitive)) {
        const std::optional<std::string> json = document.primitiveExtension(id, kAssetExtension);
        if (!json)
            rejectAsset(place_ + " has no radiance transfer, as all of an asset's must have");
        const gltf::Json parsed = gltf::parseJson(*json);
        const gltf::JsonCursor object(parsed, place_);
        for (const auto& [semantic, checksum] : object.at("checksums").members())
            checksums_.emplace(semantic, checksum.toString());
    }

    const std::string& place() const { return place_; }

    /// The bytes of an attribute of the given form, tightly packed.
    std::vector<std::byte> read(const std::string& semantic, const AccessorInfo& expected) const {
        std::vector<std::byte> values = document_.readRaw(find(semantic, expected));
        const auto checksum = checksums_.find(semantic);
        if (checksum == checksums_.end() ||
            checksum->second != formatChecksum(computeCrc32(values)))
            rejectAsset(semantic + " of " + place_ +
                        " is not what was baked: its checksum is missing or differs");
        return values;
    }

  private:
    std::size_t find(const std::string& semantic, const AccessorInfo& expected) const {
        const std::optional<std::size_t> accessor = document_.attributeAccessor(id_, semantic);
        if (!accessor) rejectAsset(place_ + " lacks " + semantic);
        if (document_.describeAccessor(*accessor) != expected)
            rejectAsset(semantic + " of " + place_ +
                        " is not of the form that the asset's header says");
        return *accessor;
    }

    const GltfDocument& document_;
    PrimitiveId id_;
    std::string place_;
    std::map<std::string, std::string> checksums_;
};

/// The vectors of an attribute of a mesh, three numbers each.
std::vector<float> readVectors(const BoundAttributes& attributes, const std::string& semantic,
                               const Mesh& mesh) {
    const std::vector<std::byte> bytes = attributes.read(semantic, {mesh.vertexCount(), 3});
    std::vector<float> numbers(bytes.size() / sizeof(float));
    std::memcpy(numbers.data(), bytes.data(), bytes.size());
    return numbers;
}

/// Demands that a mesh is where it was baked and as it was baked: transfer belongs to the place,
/// and to the normal.
void checkGeometry(const BoundAttributes& attributes, const Mesh& mesh) {
    const std::vector<float> positions = readVectors(attributes, "POSITION", mesh);
    for (std::size_t vertex = 0; vertex < mesh.vertexCount(); ++vertex) {
        const float* const xyz = &positions[3 * vertex];
        if (Vec3f(xyz[0], xyz[1], xyz[2]) != mesh.positions[vertex])
            rejectAsset(attributes.place() + " is moved by its node, away from where it was baked");
    }
    for (const float number : readVectors(attributes, "NORMAL", mesh))
        if (!std::isfinite(number))
            rejectAsset(attributes.place() + " has a normal that is not finite");
}

/// Demands that each vertex has zeros beyond its last number.
void checkPadding(const CoefficientTable& data) {
    const std::size_t width = kCoefficientsPerAttribute * data.elementBytes();
    const std::size_t last = data.panelCount() - 1;
    const std::size_t usedBytes = data.columnCount() * data.elementBytes() - last * width;
    const std::span<const std::byte> panel = data.panel(last);
    for (std::size_t begin = 0; begin < panel.size(); begin += width)
        for (const std::byte b : panel.subspan(begin + usedBytes, width - usedBytes))
            if (b != std::byte{0})
                rejectAsset("holds a number other than 0 beyond the last of a vertex");
}

void checkNumbers(const CompressedLayer& layer) {
    checkPadding(layer.table.numbers);
    if (layer.bases)
        checkWeights(layer);
    else
        checkCoefficients(layer.table);
}

/// Reads the rows of a layer that belong to a mesh, whose first vertex has this number.
void readRows(const BoundAttributes& attributes, const AttributeRange& range,
              std::size_t firstVertex, std::size_t vertexCount, CompressedLayer& layer) {
    const AccessorInfo info = attributeInfo(layer, vertexCount);
    for (std::size_t part = 0; part < range.count; ++part)
        layer.table.numbers.writePanel(
            part, firstVertex, attributes.read(attributeSemantic(range.first + part), info));
}

/// Makes room for all layers, no more than the file has bytes for.
void allocateLayers(const GltfDocument& document, CompressedTransfer& transfer) {
    std::size_t bytesLeft = 0;
    for (std::size_t view = 0; view < document.bufferViewCount(); ++view)
        bytesLeft += document.bufferViewBytes(view).size();
    for (CompressedLayer& layer : transfer.layers) {
        const std::size_t coefficientBytes = bytesPerCoefficient(layer.table.encoding);
        const std::size_t vertexBytes = countAttributes(transfer.bandCount, layer) *
                                        kCoefficientsPerAttribute * coefficientBytes;
        if (transfer.receiverCount > bytesLeft / vertexBytes)
            rejectAsset("has more vertices than numbers for them");
        bytesLeft -= transfer.receiverCount * vertexBytes;
        layer.table.numbers = CoefficientTable(
            transfer.receiverCount, countNumbers(transfer.bandCount, layer), coefficientBytes);
    }
}

CompressedTransfer readTransfer(const GltfDocument& document, const FlattenedGltf& flattened,
                                AssetHeader header) {
    const Scene& scene = flattened.scene;
    CompressedTransfer transfer;
    transfer.bandCount = header.bandCount;
    transfer.receiverCount = scene.vertexCount();
    transfer.layers = std::move(header.layers);
    allocateLayers(document, transfer);
    for (std::size_t i = 0; i < transfer.layers.size(); ++i)
        if (transfer.layers[i].bases)
            readVectors(document, header.vectors[i], transfer.bandCount, transfer.layers[i]);
    transfer.receiverOfVertex.resize(transfer.receiverCount);
    std::iota(transfer.receiverOfVertex.begin(), transfer.receiverOfVertex.end(), 0u);

    const std::vector<std::size_t> offsets = vertexOffsets(scene);
    for (std::size_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
        const BoundAttributes attributes(document, flattened.primitiveOfMesh[mesh]);
        checkGeometry(attributes, scene.meshes[mesh]);
        for (std::size_t i = 0; i < transfer.layers.size(); ++i)
            readRows(attributes, header.ranges[i], offsets[mesh], scene.meshes[mesh].vertexCount(),
                     transfer.layers[i]);
    }
    for (const CompressedLayer& layer : transfer.layers)
        checkNumbers(layer);
    return transfer;
}

/// Demands that no primitive stands in the scene twice: each place receives light of its own.
void checkInstances(const std::vector<PrimitiveId>& primitiveOfMesh) {
    std::set<std::pair<std::size_t, std::size_t>> seen;
    for (const PrimitiveId& id : primitiveOfMesh)
        if (!seen.emplace(id.mesh, id.primitive).second)
            rejectAsset("places mesh " + std::to_string(id.mesh) +
                        " twice, with the transfer of one place");
}

Asset readFrom(const GltfDocument& document) {
    if (document.trailingByteCount() > 0) rejectAsset("has bytes after its end");
    AssetHeader header = readHeader(document);
    checkBufferViews(document, header.checksums);
    FlattenedGltf flattened = document.flatten();
    checkInstances(flattened.primitiveOfMesh);
    if (flattened.scene.vertexCount() != header.vertexCount)
        rejectAsset("has " + std::to_string(flattened.scene.vertexCount()) + " vertices, not the " +
                    std::to_string(header.vertexCount) + " of the bake");

    Asset asset;
    asset.provenance = header.provenance;
    asset.transfer = readTransfer(document, flattened, std::move(header));
    asset.scene = std::move(flattened.scene);
    return asset;
}

}  // namespace

Asset decodeAsset(std::vector<std::byte> file, const std::filesystem::path& path) {
    try {
        return readFrom(GltfDocument(std::move(file), path.parent_path()));
    } catch (const Error& error) {
        if (!error.where().empty()) throw;
        throw Error(error.code(), error.what(), path.string(), error.hint());
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::outOfMemory, "does not fit in memory", path.string());
    }
}

Asset readAsset(const std::filesystem::path& path) {
    return decodeAsset(readFile(path, GltfLimits().maxFileBytes), path);
}

}  // namespace prt
