#include "prt/gpu/gpu_vertex_radiance.h"

#include <algorithm>
#include <utility>

#include <epoxy/gl.h>

#include "prt/base/assert.h"
#include "prt/gpu/gl_objects.h"
#include "prt/gpu/shader_interface.h"

namespace prt {
namespace {

/// An ExitRadiance as relight.vert has it.
struct PaddedRadiance {
    Vec3f perBaseColor{0.0f, 0.0f, 0.0f};
    float mirrorVisibility = 0.0f;
    Vec3f constant{0.0f, 0.0f, 0.0f};
    float padding = 0.0f;
};

/// @param pad  makes a PaddedRadiance
template <class Value, class Pad>
void writePadded(const GlName& buffer, std::span<const Value> values, const Pad& pad) {
    std::vector<PaddedRadiance> padded(values.size());
    std::ranges::transform(values, padded.begin(), pad);
    writeBuffer(buffer, 0, std::as_bytes(std::span(padded)));
}

}  // namespace

GpuVertexRadiance::GpuVertexRadiance(std::size_t vertexCount, SharedGpuPrograms programs)
    : vertexCount_(vertexCount),
      programs_("#define RELIT 1\n#define CLUSTERED 0\n#define STORED_BYTES 4\n",
                std::move(programs)) {
    const std::size_t byteCount = vertexCount * sizeof(PaddedRadiance);
    requireShaderBuffers(byteCount);
    buffer_ = makeBuffer(byteCount, "radiance");
    upload(std::vector<Vec3f>(vertexCount, Vec3f(0.0f)));
}

void GpuVertexRadiance::use(const SurfaceFeatures& features) const {
    glUseProgram(programs_.find(features));
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, buffers::kTransfer, buffer_.get());
}

void GpuVertexRadiance::upload(std::span<const Vec3f> vertexRadiance) {
    PRT_ASSERT(vertexRadiance.size() == vertexCount_, "one radiance a vertex");
    writePadded(buffer_, vertexRadiance,
                [](const Vec3f& radiance) { return PaddedRadiance{.perBaseColor = radiance}; });
    hasMirrors_ = false;
}

void GpuVertexRadiance::upload(std::span<const ExitRadiance> vertexRadiance) {
    PRT_ASSERT(vertexRadiance.size() == vertexCount_, "one radiance a vertex");
    writePadded(buffer_, vertexRadiance, [](const ExitRadiance& radiance) {
        return PaddedRadiance{.perBaseColor = radiance.perBaseColor,
                              .mirrorVisibility = radiance.mirrorVisibility,
                              .constant = radiance.constant};
    });
    hasMirrors_ = std::ranges::any_of(vertexRadiance, [](const ExitRadiance& radiance) {
        return radiance.mirrorVisibility > 0.0f;
    });
}

const GlName& GpuVertexRadiance::buffer(bool hasMirrors) {
    hasMirrors_ = hasMirrors;
    return buffer_;
}

std::vector<ExitRadiance> GpuVertexRadiance::read() const {
    std::vector<PaddedRadiance> padded(vertexCount_);
    readBuffer(buffer_, std::as_writable_bytes(std::span(padded)));
    std::vector<ExitRadiance> vertices;
    for (const PaddedRadiance& vertex : padded)
        vertices.push_back({vertex.perBaseColor, vertex.constant, vertex.mirrorVisibility});
    return vertices;
}

}  // namespace prt
