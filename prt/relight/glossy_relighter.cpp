// Bibliography
//   [Kautz02]  Fast, arbitrary BRDF shading for low-frequency lighting using spherical harmonics
//   [Sloan02]  Precomputed radiance transfer: matrices take light to incident radiance
#include "prt/relight/glossy_relighter.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include "prt/base/assert.h"
#include "prt/basis/sh.h"
#include "prt/relight/cluster_matrices.h"
#include "prt/relight/matrix_blocks.h"
#include "prt/relight/receiver_lobes.h"
#include "prt/relight/require_layer.h"

namespace prt {
namespace {

constexpr std::size_t kBlockSize = kMatrixBlockSize;
static_assert(kGlossyPartSize % kBlockSize == 0 && kBlockSize == kReflectBlockSize);

/// A layer of matrices, however it is stored.
class StoredMatrices {
  public:
    StoredMatrices(const CompressedTransfer& transfer, const CompressedLayer& layer)
        : matrices_(makeMatrices(transfer, layer)) {}

    std::size_t byteCount() const {
        return std::visit([](const auto& matrices) { return matrices.byteCount(); }, matrices_);
    }
    std::span<const std::byte> block(std::size_t begin) const {
        return std::visit([&](const auto& matrices) { return matrices.block(begin); }, matrices_);
    }
    AlignedBytes fold(const Lighting& lighting) const {
        return std::visit([&](const auto& matrices) { return matrices.fold(lighting); }, matrices_);
    }
    /// @param begin  of a block
    void multiplyBlocks(const AlignedBytes& light, std::size_t begin, std::size_t blockCount,
                        std::size_t stride, float* incident) const {
        std::visit(
            [&](const auto& matrices) {
                matrices.multiply(light, begin, blockCount, stride, incident);
            },
            matrices_);
    }

  private:
    using Matrices = std::variant<MatrixBlocks, ClusterMatrices>;

    static Matrices makeMatrices(const CompressedTransfer& transfer, const CompressedLayer& layer) {
        PRT_ASSERT(transfer.bandCount >= 1 && transfer.bandCount <= kMaxBandCount &&
                       layer.incidentBandCount >= 1 && layer.incidentBandCount <= kMaxBandCount,
                   "band counts of the kernels");
        PRT_ASSERT(layer.channelCount == 1 || layer.channelCount == 3, "grey or coloured transfer");
        PRT_ASSERT(isComplete(transfer, layer), "transfer for each receiver");
        if (layer.bases) return ClusterMatrices(layer, transfer.bandCount);
        return MatrixBlocks(layer.table, transfer.bandCount, layer.incidentBandCount,
                            layer.channelCount);
    }

    Matrices matrices_;
};

}  // namespace

struct GlossyRelighter::State {
    int bandCount = 0;
    int incidentBandCount = 0;
    ReceiverLobes lobes;
    StoredMatrices matrices;
    std::optional<StoredMatrices> direct;  ///< what comes straight from the light, where bounced
                                           ///< light must be told from it

    /// A light for both.
    struct FoldedLights {
        AlignedBytes all;
        AlignedBytes direct;
    };

    FoldedLights fold(const Lighting& lighting) const {
        PRT_ASSERT(lighting.bandCount <= bandCount, "light has no more bands than transfer");
        PRT_ASSERT(lighting.coefficients.size() ==
                       static_cast<std::size_t>(shCoefficientCount(lighting.bandCount)),
                   "n² coefficients of light");
        return {matrices.fold(lighting), direct ? direct->fold(lighting) : AlignedBytes()};
    }

    /// @param incident  whole blocks, written
    void receiveBlocks(const FoldedLights& lights, std::size_t begin, std::size_t blockCount,
                       float* incident) const {
        matrices.multiplyBlocks(lights.all, begin, blockCount, lobes.incidentSize(), incident);
        for (std::size_t block = 0; direct && block < blockCount; ++block)
            tellBounced(lights.direct, begin + block * kBlockSize,
                        incident + block * kBlockSize * lobes.incidentSize());
    }

    /// Puts l − l⁰ behind l, in a block where it is asked for, and else zeros.
    void tellBounced(const AlignedBytes& light, std::size_t begin, float* incident) const {
        const std::size_t size = 3 * lobes.rowSize();
        const std::size_t count = std::min(kBlockSize, lobes.receiverCount() - begin);
        bool isAsked = false;
        for (std::size_t r = 0; r < count; ++r)
            isAsked = isAsked || lobes.isSplit(begin + r);
        if (isAsked) direct->multiplyBlocks(light, begin, 1, lobes.incidentSize(), incident + size);
        for (std::size_t r = 0; r < count; ++r, incident += 2 * size)
            for (std::size_t i = 0; i < size; ++i)
                incident[size + i] = isAsked ? incident[i] - incident[size + i] : 0.0f;
    }
};

GlossyRelighter::GlossyRelighter(const CompressedTransfer& transfer, Transport transport,
                                 std::span<const ReceiverSurface> receivers,
                                 const GltfViewTable& views, const GlossyRelightOptions& options) {
    const CompressedLayer& layer = requireLayer(transfer, transport);
    PRT_ASSERT(isGlossy(transport), "the layer is of matrices");
    PRT_ASSERT(receivers.size() == transfer.receiverCount, "one surface a receiver");
    PRT_ASSERT(views.bandCount() == layer.incidentBandCount,
               "views for the bands of incident radiance");
    const LobeSplit split = chooseSplit(transfer, layer, options.leastRoughness);
    state_ = std::make_unique<State>(
        State{transfer.bandCount, layer.incidentBandCount,
              ReceiverLobes(receivers, views, options.materialTables, split),
              StoredMatrices(transfer, layer), std::nullopt});
    if (state_->lobes.incidentSize() > 3 * state_->lobes.rowSize())
        state_->direct.emplace(transfer, *split.visibility);
}

GlossyRelighter::~GlossyRelighter() = default;
GlossyRelighter::GlossyRelighter(GlossyRelighter&&) noexcept = default;
GlossyRelighter& GlossyRelighter::operator=(GlossyRelighter&&) noexcept = default;

std::size_t GlossyRelighter::receiverCount() const {
    return state_->lobes.receiverCount();
}

int GlossyRelighter::bandCount() const {
    return state_->bandCount;
}

int GlossyRelighter::incidentBandCount() const {
    return state_->incidentBandCount;
}

std::size_t GlossyRelighter::transferBytes() const {
    return state_->matrices.byteCount() + (state_->direct ? state_->direct->byteCount() : 0);
}

std::size_t GlossyRelighter::incidentSize() const {
    return state_->lobes.incidentSize();
}

void GlossyRelighter::receive(const Lighting& lighting, std::size_t begin,
                              std::span<float> incident) const {
    const std::size_t count = checkPart(begin, incident.size() / incidentSize());
    PRT_ASSERT(incident.size() == count * incidentSize(), "incident radiance of whole receivers");
    const State::FoldedLights lights = state_->fold(lighting);
    const std::size_t wholeBlocks = count / kBlockSize;
    state_->receiveBlocks(lights, begin, wholeBlocks, incident.data());

    // What ends within a block is copied from one.
    const std::size_t done = wholeBlocks * kBlockSize;
    if (done == count) return;
    std::vector<float> block(kBlockSize * incidentSize());
    state_->receiveBlocks(lights, begin + done, 1, block.data());
    std::copy_n(block.data(), (count - done) * incidentSize(),
                incident.data() + done * incidentSize());
}

void GlossyRelighter::reflect(const Vec3f& eye, std::size_t begin, std::span<const float> incident,
                              std::span<ExitRadiance> radiance) const {
    checkPart(begin, radiance.size());
    PRT_ASSERT(incident.size() == radiance.size() * incidentSize(),
               "incident radiance of the same receivers");
    state_->lobes.reflect(eye, begin, incident.data(), {}, radiance);
}

void GlossyRelighter::relight(const Lighting& lighting, const Vec3f& eye, std::size_t begin,
                              std::span<ExitRadiance> radiance) const {
    const std::size_t count = checkPart(begin, radiance.size());
    const State::FoldedLights lights = state_->fold(lighting);
    const AlignedBytes bytes = allocateAlignedBytes(kBlockSize * incidentSize() * sizeof(float));
    auto* const incident = reinterpret_cast<float*>(bytes.get());
    for (std::size_t done = 0; done < count; done += kBlockSize) {
        const auto block = radiance.subspan(done, std::min(kBlockSize, count - done));
        state_->receiveBlocks(lights, begin + done, 1, incident);
        const auto ahead = state_->matrices.block(begin + done + kBlockSize);
        state_->lobes.reflect(eye, begin + done, incident, ahead, block);
    }
}

std::size_t GlossyRelighter::checkPart(std::size_t begin, std::size_t count) const {
    PRT_ASSERT(begin % kGlossyPartSize == 0, "a part begins where parts may");
    PRT_ASSERT(begin <= receiverCount() && count <= receiverCount() - begin,
               "a part lies within the receivers");
    return count;
}

}  // namespace prt
