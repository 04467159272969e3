// Bibliography
//   [Sloan03]  Clustered principal components for precomputed radiance transfer
#include "prt/gpu/gpu_matrices.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <epoxy/gl.h>

#include "prt/base/assert.h"
#include "prt/basis/sh.h"
#include "prt/gpu/compute.h"
#include "prt/gpu/gl_objects.h"
#include "prt/gpu/gpu_table.h"
#include "prt/gpu/matrix_light.h"
#include "prt/gpu/shader_interface.h"
#include "prt/gpu/shader_program.h"
#include "prt/relight/cluster_matrices.h"
#include "prt/relight/incident_order.h"

namespace prt {
namespace {

std::size_t countRows(const CompressedLayer& layer) {
    return static_cast<std::size_t>(shCoefficientCount(layer.incidentBandCount));
}

std::string defineFor(const CompressedLayer& layer) {
    return "#define STORED_BYTES " + std::to_string(bytesPerCoefficient(layer.table.encoding)) +
           "\n#define CLUSTERED " + (layer.bases ? "1" : "0") + "\n#define CHANNEL_COUNT " +
           std::to_string(layer.channelCount) + "\n#define COEFFICIENT_COUNT " +
           std::to_string(countRows(layer)) + "u\n";
}

}  // namespace

struct GpuMatrices::Content {
    int bandCount = 0;
    int incidentBandCount = 0;
    std::size_t receiverCount = 0;
    std::vector<StoredRange> ranges;          ///< of the columns, without clusters
    std::optional<ClusterMatrices> clusters;  ///< what a light is multiplied with on the CPU
    std::size_t productBytes = 0;             ///< of clusters
    std::size_t groupCount = 0;               ///< of what is computed of a receiver
    SharedGpuPrograms programs;
    unsigned program = 0;
    std::vector<std::pair<int, std::size_t>> uniformValues;
    GlName transfer;
    GlName rows;   ///< or the first product of each cluster
    GlName light;  ///< or products

    Content(const CompressedTransfer& asset, const CompressedLayer& layer, SharedGpuPrograms shared)
        : bandCount(asset.bandCount),
          incidentBandCount(layer.incidentBandCount),
          receiverCount(asset.receiverCount),
          programs(std::move(shared)) {
        const CoefficientTable& table = layer.table.numbers;
        requireComputed(receiverCount, gpuTableBytes(table));
        requireComputed(receiverCount, 3 * countRows(layer) * receiverCount * sizeof(float));
        program =
            findComputeProgram(*programs, findShader("shaders/receive.comp"), defineFor(layer));
        setUniform(uniforms::kReceiverCount, receiverCount);
        setUniform(uniforms::kPanelCount, table.panelCount());
        transfer = uploadTable(table);
        if (layer.bases)
            addClusters(layer);
        else
            addMatrices(layer);
    }

    /// Others who share the program set their own.
    void setUniform(int location, std::size_t value) {
        uniformValues.emplace_back(location, value);
    }

    void use() const {
        glUseProgram(program);
        for (const auto& [location, value] : uniformValues)
            glUniform1ui(location, static_cast<GLuint>(value));
    }

    void addMatrices(const CompressedLayer& layer) {
        constexpr std::size_t kRowsTogether = 4;  // which begin with a panel
        ranges = storedRanges(layer.table);
        const MatrixLight dark = foldMatrixLight(ranges, bandCount, incidentBandCount, Lighting(1));
        rows = makeBuffer(std::span(dark.rows), "light");
        light = makeBuffer(std::span(dark.factors), "light");
        const std::size_t rowCount = dark.rows.size() - 1;
        setUniform(uniforms::kColumnCount, static_cast<std::size_t>(shCoefficientCount(bandCount)));
        setUniform(uniforms::kRowCount, rowCount);
        groupCount = (rowCount + kRowsTogether - 1) / kRowsTogether;
    }

    void addClusters(const CompressedLayer& layer) {
        const std::vector<std::size_t> firsts = layer.bases->firstVectors();
        const std::vector<std::uint32_t> shaderFirsts(firsts.begin(), firsts.end());
        clusters.emplace(layer, bandCount);
        rows = makeBuffer(std::span(shaderFirsts), "clusters");
        const std::size_t paddedCount = incidentRowSize(incidentBandCount);
        productBytes = firsts.back() * 3 * paddedCount * sizeof(float);
        // A receiver multiplies its zeros, too, with what stands behind the last product.
        const std::size_t behind = layer.table.numbers.panelCount() * CoefficientTable::kPanelWidth;
        const std::vector<float> zeros((firsts.back() + behind) * 3 * paddedCount);
        requireComputed(receiverCount, std::span(zeros).size_bytes());
        light = makeBuffer(std::span(zeros), "clusters");
        setUniform(uniforms::kPaddedCount, paddedCount);
        groupCount = countRows(layer);
    }

    void fold(const Lighting& lighting) const {
        if (clusters) {
            const AlignedBytes products = clusters->fold(lighting);
            writeBuffer(light, 0, {products.get(), productBytes});
            return;
        }
        const MatrixLight folded = foldMatrixLight(ranges, bandCount, incidentBandCount, lighting);
        writeBuffer(rows, 0, std::as_bytes(std::span(folded.rows)));
        writeBuffer(light, 0, std::as_bytes(std::span(folded.factors)));
    }
};

GpuMatrices::GpuMatrices(const CompressedTransfer& transfer, const CompressedLayer& layer,
                         SharedGpuPrograms programs)
    : content_(std::make_unique<Content>(transfer, layer, std::move(programs))) {}

GpuMatrices::~GpuMatrices() = default;
GpuMatrices::GpuMatrices(GpuMatrices&&) noexcept = default;
GpuMatrices& GpuMatrices::operator=(GpuMatrices&&) noexcept = default;

GlName GpuMatrices::makeIncident() const {
    const auto rowCount = static_cast<std::size_t>(shCoefficientCount(content_->incidentBandCount));
    return makeBuffer(3 * rowCount * content_->receiverCount * sizeof(float), "incident radiance");
}

void GpuMatrices::receive(const Lighting& lighting, const GlName& incident) const {
    PRT_ASSERT(lighting.bandCount <= content_->bandCount, "light has no more bands than transfer");
    content_->fold(lighting);
    content_->use();
    bindBuffer(buffers::kTransfer, content_->transfer);
    bindBuffer(buffers::kRows, content_->rows);
    bindBuffer(buffers::kLight, content_->light);
    bindBuffer(buffers::kReceived, incident);
    computeFor(content_->receiverCount, content_->groupCount);
}

}  // namespace prt
