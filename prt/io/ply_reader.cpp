#include "prt/io/ply_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "prt/base/error.h"
#include "prt/base/file.h"
#include "prt/image/tone_curve.h"
#include "prt/io/mesh_completion.h"
#include "prt/io/ply_body.h"
#include "prt/io/scene_io.h"

namespace prt {
namespace {

constexpr std::uintmax_t kMaxPlyBytes = std::uintmax_t(8) << 30;

/// What a vertex property means to us.
enum VertexSlot { x, y, z, nx, ny, nz, u, v, red, green, blue, alpha, kVertexSlotCount };

/// Where the properties of the vertex element go.
struct VertexLayout {
    std::vector<std::optional<VertexSlot>> slotOfProperty;
    std::array<std::optional<PlyType>, kVertexSlotCount> typeOfSlot;

    bool has(VertexSlot first, int count) const {
        for (int i = 0; i < count; ++i)
            if (!typeOfSlot[std::size_t(first + i)]) return false;
        return true;
    }
};

std::optional<VertexSlot> slotNamed(std::string_view name) {
    struct Name {
        std::string_view name;
        VertexSlot slot;
    };
    constexpr std::array<Name, 22> kNames = {
        {{"x", x},         {"y", y},         {"z", z},         {"nx", nx},       {"ny", ny},
         {"nz", nz},       {"s", u},         {"t", v},         {"u", u},         {"v", v},
         {"texture_u", u}, {"texture_v", v}, {"texture_s", u}, {"texture_t", v}, {"red", red},
         {"green", green}, {"blue", blue},   {"alpha", alpha}, {"r", red},       {"g", green},
         {"b", blue},      {"a", alpha}}};
    for (const Name& known : kNames)
        if (known.name == name) return known.slot;
    return std::nullopt;
}

VertexLayout layOutVertex(const PlyElement& element) {
    VertexLayout layout;
    for (const PlyProperty& property : element.properties) {
        std::optional<VertexSlot> slot = slotNamed(property.name);
        if (property.isList || (slot && layout.typeOfSlot[*slot])) slot.reset();
        if (slot) layout.typeOfSlot[*slot] = property.type;
        layout.slotOfProperty.push_back(slot);
    }
    return layout;
}

/// A colour channel as a fraction of the type's largest value;
/// floating-point ones are fractions already.
float fractionOf(double value, PlyType type) {
    if (type == PlyType::uint8) value /= std::numeric_limits<std::uint8_t>::max();
    if (type == PlyType::uint16) value /= std::numeric_limits<std::uint16_t>::max();
    return static_cast<float>(value);
}

class PlyReader {
  public:
    PlyReader(std::string_view file, const std::string& name)
        : name_(name),
          header_(parsePlyHeader(file, name)),
          body_(file.substr(header_.byteCount), header_.format, name) {}

    Scene read() {
        for (const PlyElement& element : header_.elements) {
            body_.checkCount(element);
            if (element.name == "vertex" && mesh_.positions.empty()) {
                readVertices(element);
            } else if (element.name == "face") {
                readFaces(element);
            } else {
                skipElement(element);
            }
        }
        if (mesh_.indices.empty())
            throw Error(ErrorCode::unsupported, "has no faces", name_,
                        "point clouds cannot be baked: make a mesh of it first");
        return finishScene();
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(ErrorCode::malformed, what, name_);
    }

    void readVertices(const PlyElement& element) {
        const VertexLayout layout = layOutVertex(element);
        if (!layout.has(x, 3)) fail("has vertices without x, y and z");
        if (element.count > std::numeric_limits<std::uint32_t>::max())
            throw Error(ErrorCode::limitExceeded, "has more vertices than 32-bit indices reach",
                        name_);
        mesh_.positions.reserve(element.count);
        for (std::uint64_t i = 0; i < element.count; ++i) {
            std::array<double, kVertexSlotCount> values{};
            for (std::size_t p = 0; p < element.properties.size(); ++p) {
                const std::optional<VertexSlot> slot = layout.slotOfProperty[p];
                if (slot)
                    values[*slot] = body_.readNumber(element.properties[p].type);
                else
                    body_.skip(element.properties[p]);
            }
            addVertex(values, layout);
        }
    }

    void addVertex(const std::array<double, kVertexSlotCount>& values, const VertexLayout& layout) {
        mesh_.positions.emplace_back(finite(values[x]), finite(values[y]), finite(values[z]));
        if (layout.has(nx, 3))
            mesh_.normals.emplace_back(float(values[nx]), float(values[ny]), float(values[nz]));
        // As in OBJ files, v counts from the bottom of the image; glTF counts from the top.
        if (layout.has(u, 2))
            mesh_.uvSets[0].emplace_back(finite(values[u]), 1.0f - finite(values[v]));
        if (layout.has(red, 3)) mesh_.colors.push_back(linearColor(values, layout));
    }

    float finite(double value) const {
        if (!(std::abs(value) <= std::numeric_limits<float>::max()))
            fail("vertex " + std::to_string(mesh_.positions.size()) +
                 " has a coordinate that is not finite");
        return static_cast<float>(value);
    }

    Vec4f linearColor(const std::array<double, kVertexSlotCount>& values,
                      const VertexLayout& layout) const {
        const auto channel = [&](VertexSlot slot) {
            const PlyType type = *layout.typeOfSlot[slot];
            const float fraction = fractionOf(finite(values[slot]), type);
            return isPlyInteger(type) ? decodeSrgb(std::clamp(fraction, 0.0f, 1.0f)) : fraction;
        };
        const float opacity = layout.has(alpha, 1)
                                  ? fractionOf(finite(values[alpha]), *layout.typeOfSlot[alpha])
                                  : 1.0f;
        return {channel(red), channel(green), channel(blue), opacity};
    }

    void readFaces(const PlyElement& element) {
        for (std::uint64_t i = 0; i < element.count; ++i)
            for (const PlyProperty& property : element.properties) {
                const bool isCorners =
                    property.isList && isPlyInteger(property.type) &&
                    (property.name == "vertex_indices" || property.name == "vertex_index");
                if (isCorners)
                    readFace(property, i);
                else
                    body_.skip(property);
            }
    }

    void readFace(const PlyProperty& property, std::uint64_t face) {
        const std::size_t cornerCount = body_.readListCount(property);
        polygon_.clear();
        polygonPositions_.clear();
        for (std::size_t i = 0; i < cornerCount; ++i) {
            const double index = body_.readNumber(property.type);
            if (index < 0.0 || index >= double(mesh_.positions.size()))
                fail("face " + std::to_string(face) + " has a vertex index that is out of range");
            polygon_.push_back(static_cast<std::uint32_t>(index));
            polygonPositions_.push_back(mesh_.positions[polygon_.back()]);
        }
        if (cornerCount < 3) {
            ++degenerateFaceCount_;
            return;
        }
        polygonTriangles_.clear();
        triangulatePolygon(polygonPositions_, polygonTriangles_);
        for (const std::uint32_t corner : polygonTriangles_)
            mesh_.indices.push_back(polygon_[corner]);
    }

    void skipElement(const PlyElement& element) {
        for (std::uint64_t i = 0; i < element.count; ++i)
            for (const PlyProperty& property : element.properties)
                body_.skip(property);
    }

    Scene finishScene() {
        Scene scene;
        if (degenerateFaceCount_ > 0)
            scene.warnings.push_back(std::to_string(degenerateFaceCount_) +
                                     " faces with fewer than three corners were left out");
        if (const std::size_t count = completeNormals(mesh_))
            scene.warnings.push_back(std::to_string(count) +
                                     " normals were zero and were computed");
        mesh_.name = "mesh";
        scene.materials.emplace_back().name = "default";
        scene.meshes.push_back(std::move(mesh_));
        return scene;
    }

    const std::string& name_;
    PlyHeader header_;
    PlyBody body_;
    Mesh mesh_;
    std::vector<std::uint32_t> polygon_;
    std::vector<Vec3f> polygonPositions_;
    std::vector<std::uint32_t> polygonTriangles_;
    std::size_t degenerateFaceCount_ = 0;
};

}  // namespace

Scene parsePly(std::string_view file, const std::string& name) {
    return PlyReader(file, name).read();
}

Scene readPly(const std::filesystem::path& path) {
    const std::vector<std::byte> bytes = readFile(path, kMaxPlyBytes);
    const std::string_view file(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return parsePly(file, path.string());
}

}  // namespace prt
