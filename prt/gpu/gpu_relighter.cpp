// Bibliography
//   [Sloan02]  Precomputed radiance transfer: B is an inner product of light and transfer
//   [Sloan03]  Clustered principal components for precomputed radiance transfer
#include "prt/gpu/gpu_relighter.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <epoxy/gl.h>

#include "prt/base/assert.h"
#include "prt/base/error.h"
#include "prt/gpu/gl_objects.h"
#include "prt/gpu/gpu_table.h"
#include "prt/gpu/panel_light.h"
#include "prt/gpu/shader_interface.h"
#include "prt/relight/require_layer.h"
#include "prt/relight/vector_blocks.h"

namespace prt {
namespace {

const CompressedLayer& requireVectors(const CompressedTransfer& transfer, Transport transport) {
    const CompressedLayer& layer = requireLayer(transfer, transport);
    if (isGlossy(transport))
        throw Error(ErrorCode::unsupported, "transfer matrices are not relit on the graphics card",
                    {}, "choose a transport of vectors, or draw on the CPU");
    PRT_ASSERT(isComplete(transfer, layer), "transfer for each receiver");
    return layer;
}

std::string defineFor(const CompressedLayer& layer) {
    return "#define RELIT 0\n#define STORED_BYTES " +
           std::to_string(bytesPerCoefficient(layer.table.encoding)) + "\n#define CLUSTERED " +
           (layer.bases ? "1" : "0") + "\n";
}

/// A product as the shader has it, in 16 bytes.
struct PaddedProduct {
    Vec3f radiance{0.0f, 0.0f, 0.0f};
    float padding = 0.0f;
};

}  // namespace

struct GpuRelighter::Content {
    /// What a light is multiplied with on the CPU, of a layer with clusters.
    struct Clusters {
        VectorBlocks vectors;
        std::vector<std::size_t> firstVectors;
        GlName firstProducts;
    };

    int bandCount = 0;
    std::size_t vertexCount = 0;
    TransferEncoding encoding = TransferEncoding::float32;
    std::vector<StoredRange> ranges;  ///< of the columns, without clusters
    std::optional<Clusters> clusters;
    std::size_t productCount = 0;  ///< of clusters, padded
    SurfacePrograms programs;
    std::size_t receiverCount = 0;
    std::size_t panelCount = 0;  ///< that are read
    Vec3f biasRadiance{0.0f, 0.0f, 0.0f};
    GlName transfer;
    GlName receivers;
    GlName light;  ///< or products

    Content(const CompressedTransfer& asset, const CompressedLayer& layer, SharedGpuPrograms shared)
        : bandCount(asset.bandCount),
          vertexCount(asset.receiverOfVertex.size()),
          encoding(layer.table.encoding),
          programs(defineFor(layer), std::move(shared)),
          receiverCount(layer.table.numbers.rowCount()) {
        const CoefficientTable& table = layer.table.numbers;
        requireShaderBuffers(gpuTableBytes(table));
        transfer = uploadTable(table);
        receivers = makeBuffer(std::span(asset.receiverOfVertex), "transfer");
        if (layer.bases) {
            addClusters(asset.bandCount, layer);
        } else {
            ranges = storedRanges(layer.table);
            light = makeBuffer(foldLight(ranges, bandCount, {}).factors.size() * sizeof(float),
                               "light");
        }
    }

    void addClusters(int layerBandCount, const CompressedLayer& layer) {
        const ClusterBases& bases = *layer.bases;
        std::vector<std::size_t> firsts = bases.firstVectors();
        const std::vector<std::uint32_t> shaderFirsts(firsts.begin(), firsts.end());
        clusters.emplace(Clusters{VectorBlocks(bases.vectors, layerBandCount, layer.channelCount),
                                  std::move(firsts),
                                  makeBuffer(std::span(shaderFirsts), "clusters")});
        panelCount = layer.table.numbers.panelCount();
        // A vertex multiplies its zeros, too, with what stands behind the last product.
        productCount = clusters->vectors.vectorCount() + panelCount * CoefficientTable::kPanelWidth;
        const std::size_t byteCount = productCount * sizeof(PaddedProduct);
        requireShaderBuffers(byteCount);
        light = makeBuffer(byteCount, "clusters");
    }

    /// R_kp, and for the components divided by the stored number that stands for 1.
    std::vector<PaddedProduct> multiplyClusters(const Lighting& lighting) const {
        std::vector<Vec3f> products(clusters->vectors.vectorCount());
        clusters->vectors.relight(lighting, 0, ResultStore::cached, products);
        const auto fraction = static_cast<float>(1.0 / largestStored(encoding));
        std::vector<PaddedProduct> padded(productCount);
        for (std::size_t k = 0; k + 1 < clusters->firstVectors.size(); ++k) {
            const std::size_t first = clusters->firstVectors[k];
            for (std::size_t i = first; i < clusters->firstVectors[k + 1]; ++i)
                padded[i].radiance = products[i] * (i == first ? 1.0f : fraction);
        }
        return padded;
    }

    void relight(const Lighting& lighting) {
        PRT_ASSERT(lighting.bandCount <= bandCount, "light has no more bands than transfer");
        if (clusters) {
            const std::vector<PaddedProduct> products = multiplyClusters(lighting);
            writeBuffer(light, 0, std::as_bytes(std::span(products)));
            return;
        }
        const PanelLight folded = foldLight(ranges, bandCount, lighting);
        writeBuffer(light, 0, std::as_bytes(std::span(folded.factors)));
        panelCount = folded.panelCount;
        biasRadiance = folded.biasRadiance;
    }
};

GpuRelighter::GpuRelighter(const CompressedTransfer& transfer, Transport transport,
                           SharedGpuPrograms programs)
    : content_(std::make_unique<Content>(transfer, requireVectors(transfer, transport),
                                         std::move(programs))) {
    relight(Lighting(1));
}

GpuRelighter::~GpuRelighter() = default;
GpuRelighter::GpuRelighter(GpuRelighter&&) noexcept = default;
GpuRelighter& GpuRelighter::operator=(GpuRelighter&&) noexcept = default;

std::size_t GpuRelighter::vertexCount() const {
    return content_->vertexCount;
}

int GpuRelighter::bandCount() const {
    return content_->bandCount;
}

void GpuRelighter::relight(const Lighting& lighting) {
    content_->relight(lighting);
}

void GpuRelighter::use(const SurfaceFeatures& features) const {
    const auto bind = [](unsigned place, const GlName& buffer) {
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, place, buffer.get());
    };
    glUseProgram(content_->programs.find(features));
    glUniform1ui(uniforms::kReceiverCount, static_cast<GLuint>(content_->receiverCount));
    glUniform1ui(uniforms::kPanelCount, static_cast<GLuint>(content_->panelCount));
    if (!content_->clusters) glUniform3fv(uniforms::kBiasRadiance, 1, &content_->biasRadiance.x);
    bind(buffers::kTransfer, content_->transfer);
    bind(buffers::kReceivers, content_->receivers);
    bind(buffers::kLight, content_->light);
    if (content_->clusters) bind(buffers::kFirstProducts, content_->clusters->firstProducts);
}

}  // namespace prt
