#include "prt/relight/cluster_matrix_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "prt/relight/cluster_matrix_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "prt/relight/relight_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace prt::HWY_NAMESPACE {
namespace {

/// Adds up kVectors vectors of one matrix, to have as many chains of additions.
template <std::size_t kVectors, class Stored>
HWY_INLINE void weighVectors(const float* products, std::size_t vectorSize, const Stored* weights,
                             std::size_t componentCount, float* incident) {
    const FloatTag d;
    Vector sums[kVectors];
    for (std::size_t v = 0; v < kVectors; ++v)
        sums[v] = hn::Load(d, products + v * hn::Lanes(d));
    for (std::size_t p = 0; p < componentCount; ++p) {
        products += vectorSize;
        const Vector weight = hn::Set(d, static_cast<float>(weights[p]));
        for (std::size_t v = 0; v < kVectors; ++v)
            sums[v] = hn::MulAdd(weight, hn::Load(d, products + v * hn::Lanes(d)), sums[v]);
    }
    for (std::size_t v = 0; v < kVectors; ++v)
        hn::StoreU(sums[v], d, incident + v * hn::Lanes(d));
}

template <class Stored>
void weighStored(const ClusteredMatrices& matrices, const float* products, std::size_t vectorSize,
                 std::size_t matrixCount, std::size_t stride, float* incident) {
    constexpr std::size_t kVectors = 3;  // of each vectorSize, three channels, there are as many
    const std::size_t step = kVectors * hn::Lanes(FloatTag());
    const auto* weights = reinterpret_cast<const Stored*>(matrices.weights);
    for (std::size_t i = 0; i < matrixCount; ++i) {
        const std::uint32_t* const first = matrices.firstVectors + matrices.clusters[i];
        const float* const mean = products + first[0] * vectorSize;
        for (std::size_t at = 0; at < vectorSize; at += step)
            weighVectors<kVectors>(mean + at, vectorSize, weights, first[1] - first[0] - 1,
                                   incident + at);
        weights += matrices.componentCount;
        incident += stride;
    }
}

void weigh(const ClusteredMatrices& matrices, const float* products, std::size_t vectorSize,
           std::size_t matrixCount, std::size_t stride, float* incident) {
    switch (matrices.encoding) {
        case TransferEncoding::float32:
            return weighStored<float>(matrices, products, vectorSize, matrixCount, stride,
                                      incident);
        case TransferEncoding::unorm16:
            return weighStored<std::uint16_t>(matrices, products, vectorSize, matrixCount, stride,
                                              incident);
        case TransferEncoding::unorm8:
            return weighStored<std::uint8_t>(matrices, products, vectorSize, matrixCount, stride,
                                             incident);
    }
}

}  // namespace
}  // namespace prt::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace prt {

HWY_EXPORT(weigh);

void weighProducts(const ClusteredMatrices& matrices, const float* products, std::size_t vectorSize,
                   std::size_t matrixCount, std::size_t stride, float* incident) {
    HWY_DYNAMIC_DISPATCH(weigh)(matrices, products, vectorSize, matrixCount, stride, incident);
}

}  // namespace prt
#endif  // HWY_ONCE
