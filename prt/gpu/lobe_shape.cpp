#include "prt/gpu/lobe_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "prt/basis/sh.h"
#include "prt/image/tone_curve.h"

namespace prt {
namespace {

/// How much white is in colours, so that none looks black beside the others.
constexpr float kWhiteShare = 0.1f;

/// f in the directions of a sphere's vertices.
std::vector<Vec3f> evaluateFunction(std::span<const Vec3f> directions, const Lighting& function) {
    const int bandCount = std::min(function.bandCount, kMaxBandCount);
    const auto coefficientCount = static_cast<std::size_t>(shCoefficientCount(bandCount));
    std::vector<Vec3f> coefficients(coefficientCount);
    for (std::size_t i = 0; i < coefficientCount; ++i)
        coefficients[i] = Vec3f(function.coefficients[i]);

    std::vector<Vec3f> values(directions.size(), Vec3f(0.0f));
    if (bandCount < 1) return values;
    std::vector<float> basis(coefficientCount * kShBatchSize);
    for (std::size_t begin = 0; begin < directions.size(); begin += kShBatchSize) {
        std::array<float, kShBatchSize> x{}, y{}, z{};
        const std::size_t count = std::min(kShBatchSize, directions.size() - begin);
        for (std::size_t j = 0; j < kShBatchSize; ++j) {
            const Vec3f& direction = directions[begin + std::min(j, count - 1)];
            x[j] = direction.x;
            y[j] = direction.y;
            z[j] = direction.z;
        }
        evaluateShBatch(x, y, z, bandCount, basis);
        for (std::size_t i = 0; i < coefficientCount; ++i)
            for (std::size_t j = 0; j < count; ++j)
                values[begin + j] += coefficients[i] * basis[i * kShBatchSize + j];
    }
    return values;
}

/// As bright as can be, of the same hue.
Vec3f brighten(const Vec3f& value) {
    const Vec3f positive(std::max(value.x, 0.0f), std::max(value.y, 0.0f), std::max(value.z, 0.0f));
    const float largest = std::max({positive.x, positive.y, positive.z});
    if (!(largest > 0.0f)) return Vec3f(1.0f);
    return positive * ((1.0f - kWhiteShare) / largest) + Vec3f(kWhiteShare);
}

/// The surface f(ω) ω passes smoothly through the origin where f changes its sign, and that of
/// |f(ω)| ω has the same normals: to turn a triangle's corners over turns the triangle over twice.
void computeNormals(const Mesh& sphere, std::vector<LobeVertex>& vertices) {
    std::vector<Vec3f> sums(vertices.size(), Vec3f(0.0f));
    const auto place = [&](std::uint32_t i) { return sphere.positions[i] * vertices[i].value; };
    for (std::size_t i = 0; i < sphere.indices.size(); i += 3) {
        const std::uint32_t* corners = &sphere.indices[i];
        const Vec3f a = place(corners[0]);
        const Vec3f twiceArea = (place(corners[1]) - a).cross(place(corners[2]) - a);
        for (int corner = 0; corner < 3; ++corner)
            sums[corners[corner]] += twiceArea;
    }
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const float length = sums[i].length();
        vertices[i].normal = length > 0.0f ? sums[i] / length : sphere.positions[i];
    }
}

}  // namespace

std::vector<LobeVertex> shapeLobe(const Mesh& sphere, const Lighting& function,
                                  const std::optional<Vec3f>& color) {
    const std::vector<Vec3f> values = evaluateFunction(sphere.positions, function);
    float largest = 0.0f;
    for (const Vec3f& value : values)
        largest = std::max(largest, std::abs(luminance(value)));
    std::vector<LobeVertex> vertices(values.size());
    if (!(largest > 0.0f)) return vertices;
    for (std::size_t i = 0; i < values.size(); ++i) {
        vertices[i].value = luminance(values[i]) / largest;
        vertices[i].position = sphere.positions[i] * std::abs(vertices[i].value);
        vertices[i].color = color ? *color : brighten(values[i]);
    }
    computeNormals(sphere, vertices);
    return vertices;
}

}  // namespace prt
