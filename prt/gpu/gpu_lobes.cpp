#include "prt/gpu/gpu_lobes.h"

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <epoxy/gl.h>

#include "prt/base/assert.h"
#include "prt/basis/zonal.h"
#include "prt/brdf/view_angle.h"
#include "prt/gpu/compute.h"
#include "prt/gpu/gl_objects.h"
#include "prt/gpu/shader_interface.h"
#include "prt/gpu/shader_program.h"

namespace prt {
namespace {

/// A receiver as reflect.comp has it.
struct Surface {
    Vec3f position{0.0f, 0.0f, 0.0f};
    std::uint32_t kind = 0;  ///< a LobeKind
    Vec3f normal{0.0f, 0.0f, 1.0f};
    std::uint32_t firstElement = 0;
    float levelShare = 0.0f;
    float metallic = 0.0f;
    std::uint32_t viewCount = 0;
    std::uint32_t padding = 0;
};

std::uint32_t numberOf(LobeKind kind) {
    return static_cast<std::uint32_t>(kind);
}

/// Tables of all materials, one behind the other, as reflect.comp has them.
struct ElementTables {
    std::vector<Vec4f> elements;
    std::vector<std::uint32_t> firstOfMaterial;  ///< behind glTF's

    ElementTables(const GltfViewTable& views,
                  std::span<const std::shared_ptr<const BrdfViewTable>> materialTables) {
        for (std::size_t level = 0; level < views.levelCount(); ++level)
            for (std::size_t view = 0; view < views.viewCount(); ++view)
                for (const GltfViewTable::Element& element : views.row(level, view))
                    elements.emplace_back(element.dark, element.bright, element.diffuse, 0.0f);
        for (const std::shared_ptr<const BrdfViewTable>& table : materialTables) {
            firstOfMaterial.push_back(static_cast<std::uint32_t>(elements.size()));
            if (table) addOther(*table, uprightCount(views.bandCount()));
        }
    }

    void addOther(const BrdfViewTable& table, std::size_t count) {
        for (std::size_t view = 0; view < table.viewCount(); ++view) {
            const std::span<const float> row = table.row(view);
            PRT_ASSERT(row.size() == 3 * count, "views for the same bands");
            for (std::size_t i = 0; i < count; ++i)
                elements.emplace_back(row[i], row[count + i], row[2 * count + i], 0.0f);
        }
    }
};

}  // namespace

GpuLobes::GpuLobes(const CompressedTransfer& transfer, std::span<const ReceiverSurface> receivers,
                   const GltfViewTable& views,
                   std::span<const std::shared_ptr<const BrdfViewTable>> materialTables,
                   const LobeSplit& split, SharedGpuPrograms programs)
    : vertexCount_(transfer.receiverOfVertex.size()),
      receiverCount_(receivers.size()),
      programs_(std::move(programs)) {
    requireComputed(vertexCount_, receivers.size() * sizeof(Surface));
    const ElementTables tables(views, materialTables);
    const std::size_t levelSize = views.viewCount() * uprightCount(views.bandCount());
    std::vector<Surface> surfaces;
    for (const ReceiverSurface& receiver : receivers) {
        Surface surface{.position = receiver.position, .normal = receiver.normal};
        if (!materialTables.empty() && materialTables[receiver.material]) {
            surface.kind = numberOf(LobeKind::other);
            surface.firstElement = tables.firstOfMaterial[receiver.material];
            surface.viewCount =
                static_cast<std::uint32_t>(materialTables[receiver.material]->viewCount());
        } else {
            const TablePlace level = placeBetween(
                std::clamp(receiver.surface.roughness, 0.0f, 1.0f), views.levelCount());
            surface.kind = numberOf(isSplit(split, receiver) ? LobeKind::split : LobeKind::gltf);
            surface.firstElement = static_cast<std::uint32_t>(level.first * levelSize);
            surface.levelShare = level.share;
            surface.metallic = receiver.surface.metallic;
            surface.viewCount = static_cast<std::uint32_t>(views.viewCount());
        }
        hasSplit_ |= surface.kind == numberOf(LobeKind::split);
        surfaces.push_back(surface);
    }
    hasBounced_ = hasSplit_ && split.hasBounced;

    program_ = findComputeProgram(*programs_, findShader("shaders/reflect.comp"),
                                  "#define BAND_COUNT " + std::to_string(views.bandCount()) +
                                      "\n#define SPLIT " + (hasSplit_ ? "1" : "0") +
                                      "\n#define BOUNCED " + (hasBounced_ ? "1" : "0") + "\n");
    const std::vector<double> hemisphere = capZonal(views.bandCount(), 0.5 * std::numbers::pi);
    open_.assign(hemisphere.begin(), hemisphere.end());
    surfaces_ = makeBuffer(std::span<const Surface>(surfaces), "materials");
    vertices_ = makeBuffer(std::span(transfer.receiverOfVertex), "materials");
    elements_ = makeBuffer(std::span(tables.elements), "materials");
}

void GpuLobes::reflect(const Vec3f& eye, const Incident& incident, const GlName& relit) const {
    glUseProgram(program_);
    glUniform1ui(uniforms::kReceiverCount, static_cast<GLuint>(receiverCount_));
    glUniform1ui(uniforms::kVertexCount, static_cast<GLuint>(vertexCount_));
    if (hasSplit_) glUniform1fv(uniforms::kOpen, static_cast<GLsizei>(open_.size()), open_.data());
    glUniform3f(uniforms::kReflectedEye, eye.x, eye.y, eye.z);
    bindBuffer(buffers::kSurfaces, surfaces_);
    bindBuffer(buffers::kVertices, vertices_);
    bindBuffer(buffers::kElements, elements_);
    bindBuffer(buffers::kIncident, incident.all);
    bindBuffer(buffers::kRelit, relit);
    if (hasSplit_) bindBuffer(buffers::kArriving, incident.arriving);
    if (hasBounced_) bindBuffer(buffers::kDirect, incident.direct);
    computeFor(vertexCount_);
}

}  // namespace prt
