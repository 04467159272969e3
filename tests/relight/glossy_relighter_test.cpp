#include "prt/relight/glossy_relighter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "prt/base/random.h"
#include "prt/basis/sh.h"
#include "prt/math/frame.h"
#include "tests/support/instruction_sets.h"

namespace prt {
namespace {

/// The same for the tables and for what they are held against, so that it need not be fine.
constexpr LobeQuadratureOptions kCoarse{.polarNodeCount = 32, .azimuthNodeCount = 16};

/// Sums in float, and the tables' places in float, beside the sum of all absolute values.
constexpr double kRounding = 2e-5;

double randomSigned(RandomStream& random) {
    return 2.0 * random.nextUnitDouble() - 1.0;
}

Vec3f randomDirection(RandomStream& random) {
    const double z = randomSigned(random);
    const double angle = 2.0 * std::numbers::pi * random.nextUnitDouble();
    const double radius = std::sqrt(1.0 - z * z);
    return Vec3f(Vec3d(radius * std::cos(angle), radius * std::sin(angle), z));
}

Lighting makeRandomLighting(int bandCount, std::uint64_t seed) {
    RandomStream random(seed, 0);
    Lighting lighting(bandCount);
    for (Vec3d& coefficient : lighting.coefficients)
        coefficient = Vec3d(randomSigned(random), randomSigned(random), randomSigned(random));
    return lighting;
}

struct LayerShape {
    TransferEncoding encoding = TransferEncoding::float32;
    int channelCount = 1;
    std::vector<std::uint32_t> componentCounts{};  ///< none: without clusters
};

template <class Stored>
std::vector<Stored> drawNumbers(std::size_t count, double lowest, double largest,
                                RandomStream& random) {
    std::vector<Stored> numbers(count);
    for (Stored& number : numbers)
        number = static_cast<Stored>(lowest + (largest - lowest) * random.nextUnitDouble());
    return numbers;
}

/// @param lowest  of floats, whose largest is 1
CoefficientTable drawTable(TransferEncoding encoding, std::size_t rowCount, std::size_t columnCount,
                           double lowest, RandomStream& random) {
    const std::size_t count = rowCount * columnCount;
    switch (encoding) {
        case TransferEncoding::unorm16:
            return makeTable(columnCount, drawNumbers<std::uint16_t>(count, 0.0, 65535.0, random));
        case TransferEncoding::unorm8:
            return makeTable(columnCount, drawNumbers<std::uint8_t>(count, 0.0, 255.0, random));
        case TransferEncoding::float32:
            break;
    }
    return makeTable(columnCount, drawNumbers<float>(count, lowest, 1.0, random));
}

StoredTable drawMatrices(TransferEncoding encoding, std::size_t rowCount, std::size_t size,
                         RandomStream& random) {
    StoredTable table;
    table.encoding = encoding;
    table.numbers = drawTable(encoding, rowCount, size, -1.0, random);
    for (std::size_t i = 0; encoding != TransferEncoding::float32 && i < size; ++i) {
        table.scale.push_back(random.nextUnitFloat() + 0.1f);
        table.bias.push_back(static_cast<float>(randomSigned(random)));
    }
    return table;
}

/// Puts a cluster of any receiver first in its row, and zeros behind its components.
template <class Stored>
CoefficientTable labelRows(const CoefficientTable& table,
                           const std::vector<std::uint32_t>& componentCounts,
                           RandomStream& random) {
    std::vector<Stored> rows = copyRows<Stored>(table);
    for (auto row = rows.begin(); row != rows.end();
         row += static_cast<std::ptrdiff_t>(table.columnCount())) {
        const std::size_t k = random.nextBits() % componentCounts.size();
        *row = static_cast<Stored>(k);
        std::fill(row + 1 + componentCounts[k],
                  row + static_cast<std::ptrdiff_t>(table.columnCount()), Stored{0});
    }
    return makeTable(table.columnCount(), rows);
}

CompressedLayer makeLayer(const LayerShape& shape, const CompressedTransfer& transfer,
                          int incidentBandCount, Transport transport) {
    RandomStream random(static_cast<std::uint64_t>(transport), transfer.receiverCount);
    CompressedLayer layer;
    layer.transport = transport;
    layer.channelCount = shape.channelCount;
    layer.incidentBandCount = incidentBandCount;
    const std::size_t size = coefficientsPerReceiver(transfer.bandCount, layer);
    if (shape.componentCounts.empty()) {
        layer.table = drawMatrices(shape.encoding, transfer.receiverCount, size, random);
        return layer;
    }
    layer.bases.emplace();
    layer.bases->componentCounts = shape.componentCounts;
    layer.bases->vectors =
        drawMatrices(TransferEncoding::unorm16, layer.bases->firstVectors().back(), size, random);
    layer.table.encoding = shape.encoding;
    const CoefficientTable rows = drawTable(shape.encoding, transfer.receiverCount,
                                            1 + layer.bases->componentCount(), 0.0, random);
    if (shape.encoding == TransferEncoding::float32)
        layer.table.numbers = labelRows<float>(rows, shape.componentCounts, random);
    else if (shape.encoding == TransferEncoding::unorm16)
        layer.table.numbers = labelRows<std::uint16_t>(rows, shape.componentCounts, random);
    else
        layer.table.numbers = labelRows<std::uint8_t>(rows, shape.componentCounts, random);
    return layer;
}

struct Bands {
    int incident = 0;
    int light = 0;
};

/// With visibility alone, and all light.
CompressedTransfer makeTransfer(const LayerShape& shape, Bands bands, std::size_t receiverCount) {
    CompressedTransfer transfer;
    transfer.bandCount = bands.light;
    transfer.receiverCount = receiverCount;
    for (const Transport transport : {Transport::glossyShadowed, Transport::glossy})
        transfer.layers.push_back(makeLayer(shape, transfer, bands.incident, transport));
    return transfer;
}

/// Anywhere and of anything, of three materials.
std::vector<ReceiverSurface> makeReceivers(std::size_t count) {
    RandomStream random(5, count);
    std::vector<ReceiverSurface> receivers(count);
    for (ReceiverSurface& receiver : receivers) {
        receiver = {randomDirection(random), randomDirection(random), random.nextBits() % 3,
                    MetallicRoughness{random.nextUnitFloat(), random.nextUnitFloat()}};
    }
    return receivers;
}

GltfViewTable makeViews(int bandCount) {
    return GltfViewTable(
        {.bandCount = bandCount, .levelCount = 6, .viewCount = 7, .quadrature = kCoarse});
}

/// The second of three materials is Phong's, with another number of views than glTF's.
std::vector<std::shared_ptr<const BrdfViewTable>> makeMaterialTables(int bandCount) {
    const Brdf phong{.lobes = {LambertLobe{Vec3d(0.3, 0.2, 0.1)},
                               PhongLobe{.albedo = Vec3d(0.2, 0.3, 0.6), .exponent = 12.0}}};
    return {nullptr,
            std::make_shared<BrdfViewTable>(phong, BrdfViewTableOptions{.bandCount = bandCount,
                                                                        .viewCount = 9,
                                                                        .quadrature = kCoarse}),
            nullptr};
}

/// A result and the sum of the absolute values of all that is added up.
struct Exact {
    double value = 0.0;
    double magnitude = 0.0;

    Exact operator*(double factor) const { return {value * factor, magnitude * std::abs(factor)}; }
    Exact operator+(const Exact& other) const {
        return {value + other.value, magnitude + other.magnitude};
    }
    Exact operator-(const Exact& other) const {
        return {value - other.value, magnitude + other.magnitude};
    }
};

/// ∫ y_l0 over the upper hemisphere, by the midpoint rule.
double integrateUpward(int l) {
    constexpr int kSteps = 20000;
    std::vector<double> basis(static_cast<std::size_t>(shCoefficientCount(l + 1)));
    double sum = 0.0;
    for (int step = 0; step < kSteps; ++step) {
        const double z = (step + 0.5) / kSteps;
        evaluateSh(Vec3d(std::sqrt(1.0 - z * z), 0.0, z), l + 1, basis);
        sum += basis[static_cast<std::size_t>(shIndex(l, 0))];
    }
    return sum * 2.0 * std::numbers::pi / kSteps;
}

/// What the header says, as it says it, in double.
class SlowRelighter {
  public:
    SlowRelighter(const CompressedTransfer& transfer, Transport transport,
                  const std::vector<ReceiverSurface>& receivers, const GltfViewTable& views,
                  const GlossyRelightOptions& options)
        : transfer_(transfer), receivers_(receivers), views_(views), options_(options) {
        layer_ = transfer.findLayer(transport);
        visibility_ = transfer.findLayer(Transport::glossyShadowed);
        matrices_ = expandLayer(*layer_);
        if (visibility_) visibilities_ = expandLayer(*visibility_);
        rowCount_ = static_cast<std::size_t>(shCoefficientCount(layer_->incidentBandCount));
    }

    void expectSees(const Lighting& lighting, const Vec3f& eye, std::size_t begin,
                    std::span<const ExitRadiance> radiance) const {
        for (std::size_t i = 0; i < radiance.size(); ++i) {
            SCOPED_TRACE("receiver " + std::to_string(begin + i));
            expectSees(lighting, eye, begin + i, radiance[i]);
        }
    }

  private:
    using Response = std::vector<float>;

    void expectSees(const Lighting& lighting, const Vec3f& eye, std::size_t r,
                    const ExitRadiance& radiance) const {
        const ReceiverSurface& receiver = receivers_[r];
        const Vec3f view =
            frameFromNormal(receiver.normal).localFromWorld((eye - receiver.position).normalized());
        const BrdfViewTable* table = options_.materialTables.empty()
                                         ? nullptr
                                         : options_.materialTables[receiver.material].get();
        const bool isSplit =
            !table && visibility_ && receiver.surface.roughness < options_.leastRoughness;
        for (int color = 0; color < 3; ++color) {
            Exact perBaseColor, constant;
            if (table) {
                Response response(3 * rowCount_);
                table->addResponse(view, response);
                constant = reflect(&response[static_cast<std::size_t>(color) * rowCount_],
                                   receive(lighting, r, color, false));
            } else {
                const auto [dark, bright, diffuse] = gltfResponses(receiver, view);
                const std::vector<Exact> all = receive(lighting, r, color, false);
                const std::vector<Exact> bounced = receive(lighting, r, color, isSplit);
                const double m = receiver.surface.metallic;
                const Exact k = reflect(dark.data(), bounced);
                const Exact range = reflect(bright.data(), bounced) - k;
                perBaseColor = reflect(diffuse.data(), all) * ((1.0 - m) * 0.96) + range * m;
                constant = k + range * (0.04 * (1.0 - m));
            }
            ASSERT_NEAR(radiance.perBaseColor[color], perBaseColor.value,
                        kRounding * perBaseColor.magnitude);
            ASSERT_NEAR(radiance.constant[color], constant.value, kRounding * constant.magnitude);
        }
        expectVisible(isSplit, r, view, radiance.mirrorVisibility);
    }

    void expectVisible(bool isSplit, std::size_t r, const Vec3f& view, float visibility) const {
        if (!isSplit) {
            ASSERT_EQ(visibility, 0.0f);
            return;
        }
        const Response bright = gltfResponses(receivers_[r], view)[1];
        Exact arriving, open;
        for (std::size_t i = 0; i < rowCount_; ++i) {
            const double f = static_cast<double>(bright[i]);
            const double w = std::sqrt(4.0 * std::numbers::pi) *
                             static_cast<double>(visibilities_[row(*visibility_, r, 0, i)]);
            const auto l = static_cast<std::size_t>(shDegree(static_cast<int>(i)));
            const bool isZonal = static_cast<int>(i) == shIndex(static_cast<int>(l), 0);
            arriving = arriving + Exact{f * w, std::abs(f * w)};
            if (isZonal) open = open + Exact{f * upward_[l], std::abs(f * upward_[l])};
        }
        const double expected = std::clamp(arriving.value / open.value, 0.0, 1.0);
        const double bound =
            kRounding * (arriving.magnitude + open.magnitude) / std::abs(open.value);
        ASSERT_NEAR(visibility, open.value > 0.0 ? expected : 0.0, bound);
    }

    std::size_t row(const CompressedLayer& layer, std::size_t r, int color, std::size_t i) const {
        const std::size_t channel = r * static_cast<std::size_t>(layer.channelCount) +
                                    (layer.channelCount == 3 ? static_cast<std::size_t>(color) : 0);
        return (channel * rowCount_ + i) *
               static_cast<std::size_t>(shCoefficientCount(transfer_.bandCount));
    }

    /// l, or l − l⁰.
    std::vector<Exact> receive(const Lighting& lighting, std::size_t r, int color,
                               bool isBounced) const {
        std::vector<Exact> incident(rowCount_);
        for (std::size_t i = 0; i < rowCount_; ++i)
            for (std::size_t j = 0; j < lighting.coefficients.size(); ++j) {
                const double light = lighting.coefficients[j][color];
                double number = static_cast<double>(matrices_[row(*layer_, r, color, i) + j]);
                // What stored numbers are made of, at most.
                const double magnitude = (std::abs(number) + 4.0) * std::abs(light);
                if (isBounced)
                    number -=
                        static_cast<double>(visibilities_[row(*visibility_, r, color, i) + j]);
                incident[i] = incident[i] + Exact{number * light, magnitude};
            }
        return incident;
    }

    Exact reflect(const float* response, const std::vector<Exact>& incident) const {
        Exact sum;
        for (std::size_t i = 0; i < rowCount_; ++i) {
            const Exact part = incident[i] * static_cast<double>(response[i]);
            // The tables' responses are rounded beside the largest of them, a half.
            sum = sum + Exact{part.value, part.magnitude + 0.1 * incident[i].magnitude};
        }
        return sum;
    }

    /// GGX of F0 = 0 and of F0 = 1, and a layered Lambert lobe of albedo 1.
    std::array<Response, 3> gltfResponses(const ReceiverSurface& receiver,
                                          const Vec3f& view) const {
        const auto respond = [&](float baseColor, float metallic) {
            Response response(3 * rowCount_);
            views_.addResponse(Vec3f(baseColor), {metallic, receiver.surface.roughness}, view,
                               response);
            return response;
        };
        std::array<Response, 3> responses = {respond(0.0f, 1.0f), respond(1.0f, 1.0f),
                                             respond(1.0f, 0.0f)};
        const Response coat = respond(0.0f, 0.0f);
        for (std::size_t i = 0; i < coat.size(); ++i)
            responses[2][i] = (responses[2][i] - coat[i]) / 0.96f;
        return responses;
    }

    const CompressedTransfer& transfer_;
    const std::vector<ReceiverSurface>& receivers_;
    const GltfViewTable& views_;
    const GlossyRelightOptions& options_;
    const CompressedLayer* layer_ = nullptr;
    const CompressedLayer* visibility_ = nullptr;
    std::vector<float> matrices_;
    std::vector<float> visibilities_;
    std::size_t rowCount_ = 0;
    std::vector<double> upward_ = {integrateUpward(0), integrateUpward(1), integrateUpward(2),
                                   integrateUpward(3), integrateUpward(4), integrateUpward(5)};
};

bool sameBits(std::span<const ExitRadiance> a, std::span<const ExitRadiance> b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

const Vec3f kEye(2.5f, -1.5f, 3.0f);

class GlossyOfEncoding
    : public testing::TestWithParam<
          std::tuple<TransferEncoding, int /*channelCount*/, bool /*hasClusters*/>> {
  protected:
    LayerShape shape() const {
        const auto& [encoding, channelCount, hasClusters] = GetParam();
        LayerShape shape{encoding, channelCount, {}};
        if (hasClusters) shape.componentCounts = {3, 0, 7, 1, 2};
        return shape;
    }
};

TEST_P(GlossyOfEncoding, SendsWhatTheFormulaeSayForAnyBandsAndReceiverCount) {
    for (const Bands bands : {Bands{1, 1}, Bands{1, 4}, Bands{2, 3}, Bands{3, 2}, Bands{4, 3},
                              Bands{5, 5}, Bands{6, 2}}) {
        const GltfViewTable views = makeViews(bands.incident);
        const GlossyRelightOptions options{.leastRoughness = 0.3,
                                           .materialTables = makeMaterialTables(bands.incident)};
        for (const std::size_t receiverCount : {1, 16, 35}) {
            SCOPED_TRACE(std::to_string(bands.incident) + " and " + std::to_string(bands.light) +
                         " bands, " + std::to_string(receiverCount) + " receivers");
            const CompressedTransfer transfer = makeTransfer(shape(), bands, receiverCount);
            const std::vector<ReceiverSurface> receivers = makeReceivers(receiverCount);
            const Lighting lighting = makeRandomLighting(bands.light, 7);
            for (const Transport transport : {Transport::glossyShadowed, Transport::glossy}) {
                std::vector<ExitRadiance> radiance(receiverCount);
                GlossyRelighter(transfer, transport, receivers, views, options)
                    .relight(lighting, kEye, 0, radiance);
                SlowRelighter(transfer, transport, receivers, views, options)
                    .expectSees(lighting, kEye, 0, radiance);
            }
        }
    }
}

/// An asset of 5 bands and its relighter, of all kinds of receivers.
struct Asset {
    static constexpr Bands kBands{5, 5};
    CompressedTransfer transfer;
    std::vector<ReceiverSurface> receivers;
    GltfViewTable views = makeViews(kBands.incident);
    GlossyRelightOptions options{.leastRoughness = 0.3,
                                 .materialTables = makeMaterialTables(kBands.incident)};
    GlossyRelighter relighter;

    Asset(const LayerShape& shape, std::size_t receiverCount)
        : transfer(makeTransfer(shape, kBands, receiverCount)),
          receivers(makeReceivers(receiverCount)),
          relighter(transfer, Transport::glossy, receivers, views, options) {}

    std::vector<ExitRadiance> relight(const Lighting& lighting) const {
        std::vector<ExitRadiance> radiance(receivers.size());
        relighter.relight(lighting, kEye, 0, radiance);
        return radiance;
    }
    void expectSees(const Lighting& lighting, std::span<const ExitRadiance> radiance) const {
        SlowRelighter(transfer, Transport::glossy, receivers, views, options)
            .expectSees(lighting, kEye, 0, radiance);
    }
};

TEST_P(GlossyOfEncoding, SendsWhatTheFormulaeSayOnEveryInstructionSet) {
    const Asset asset(shape(), 37);
    const Lighting lighting = makeRandomLighting(5, 3);
    onEveryInstructionSet([&] { asset.expectSees(lighting, asset.relight(lighting)); });
}

TEST_P(GlossyOfEncoding, LeavesHigherBandsUnusedWhenTheLightHasFewer) {
    const Asset asset(shape(), 19);
    for (int bandCount = 0; bandCount <= 5; ++bandCount) {
        SCOPED_TRACE(bandCount);
        const Lighting lighting = makeRandomLighting(bandCount, 11);
        asset.expectSees(lighting, asset.relight(lighting));
    }
}

TEST_P(GlossyOfEncoding, GivesTheSameBitsWholeAndInPartsAndInTwoSteps) {
    constexpr std::size_t kReceiverCount = 3 * kGlossyPartSize + 21;
    const Asset asset(shape(), kReceiverCount);
    const GlossyRelighter& relighter = asset.relighter;
    const Lighting lighting = makeRandomLighting(5, 5);
    const std::vector<ExitRadiance> whole = asset.relight(lighting);
    for (const std::size_t partSize : {kGlossyPartSize, 2 * kGlossyPartSize}) {
        std::vector<ExitRadiance> parts(kReceiverCount), twoSteps(kReceiverCount);
        for (std::size_t begin = 0; begin < kReceiverCount; begin += partSize) {
            const std::size_t count = std::min(partSize, kReceiverCount - begin);
            relighter.relight(lighting, kEye, begin, std::span(parts).subspan(begin, count));
            std::vector<float> incident(count * relighter.incidentSize());
            relighter.receive(lighting, begin, incident);
            relighter.reflect(kEye, begin, incident, std::span(twoSteps).subspan(begin, count));
        }
        EXPECT_TRUE(sameBits(whole, parts)) << "parts of " << partSize;
        EXPECT_TRUE(sameBits(whole, twoSteps)) << "parts of " << partSize;
    }
}

TEST_P(GlossyOfEncoding, PartsThatEndInsideABlockLeaveTheRestAlone) {
    const Asset asset(shape(), kGlossyPartSize + 64);
    const GlossyRelighter& relighter = asset.relighter;
    const Lighting lighting = makeRandomLighting(5, 5);
    const std::vector<ExitRadiance> whole = asset.relight(lighting);

    constexpr float kUntouched = -12345.0f;
    std::vector<float> incident(5 * relighter.incidentSize() + 1, kUntouched);
    const auto written = std::span(incident).first(incident.size() - 1);
    relighter.receive(lighting, kGlossyPartSize, written);
    EXPECT_EQ(incident.back(), kUntouched);
    std::vector<ExitRadiance> few(8);
    few[5].mirrorVisibility = kUntouched;
    relighter.reflect(kEye, kGlossyPartSize, written, std::span(few).first(5));
    EXPECT_TRUE(sameBits(std::span(few).first(5), std::span(whole).subspan(kGlossyPartSize, 5)));
    EXPECT_EQ(few[5].mirrorVisibility, kUntouched);
    relighter.relight(lighting, kEye, kGlossyPartSize, std::span(few).first(3));
    EXPECT_TRUE(sameBits(std::span(few).first(5), std::span(whole).subspan(kGlossyPartSize, 5)));
}

TEST_P(GlossyOfEncoding, DarknessIsExactlyBlack) {
    const Asset asset(shape(), 20);
    for (const ExitRadiance& seen : asset.relight(Lighting(5))) {
        EXPECT_EQ(seen.perBaseColor, Vec3f(0.0f));
        EXPECT_EQ(seen.constant, Vec3f(0.0f));
    }
}

std::string paramName(const testing::TestParamInfo<GlossyOfEncoding::ParamType>& info) {
    const auto& [encoding, channelCount, hasClusters] = info.param;
    return std::string(encodingName(encoding)) + (channelCount == 1 ? "Grey" : "Coloured") +
           (hasClusters ? "Clusters" : "");
}

INSTANTIATE_TEST_SUITE_P(All, GlossyOfEncoding,
                         testing::Combine(testing::Values(TransferEncoding::float32,
                                                          TransferEncoding::unorm16,
                                                          TransferEncoding::unorm8),
                                          testing::Values(1, 3), testing::Bool()),
                         paramName);

TEST(GlossyRelighter, CountsTheBytesThatItReads) {
    const GltfViewTable views = makeViews(5);
    const std::vector<ReceiverSurface> receivers = makeReceivers(17);
    CompressedTransfer transfer = makeTransfer({TransferEncoding::unorm16, 1, {}}, {5, 5}, 17);
    const GlossyRelighter plain(transfer, Transport::glossy, receivers, views);
    EXPECT_EQ(plain.transferBytes(), 2u * 16u * 625u * 2u);
    EXPECT_EQ(plain.incidentSize(), 3u * 32u);
    EXPECT_EQ(plain.receiverCount(), 17u);
    EXPECT_EQ(plain.bandCount(), 5);
    EXPECT_EQ(plain.incidentBandCount(), 5);
    const GlossyRelighter split(transfer, Transport::glossy, receivers, views,
                                {.leastRoughness = 0.5});
    EXPECT_EQ(split.transferBytes(), 2u * plain.transferBytes());
    EXPECT_EQ(split.incidentSize(), 6u * 32u);
}

TEST(GlossyRelighter, AnAssetWithoutReceiversIsRelitToNothing) {
    const GlossyRelighter relighter(makeTransfer({}, {2, 2}, 0), Transport::glossy, {},
                                    makeViews(2));
    relighter.relight(makeRandomLighting(2, 1), kEye, 0, {});
    relighter.receive(makeRandomLighting(2, 1), 0, {});
    EXPECT_EQ(relighter.transferBytes(), 0u);
}

TEST(GlossyRelighter, LivesOnWhenMoved) {
    Asset asset({}, 21);
    const Lighting lighting = makeRandomLighting(5, 1);
    const std::vector<ExitRadiance> before = asset.relight(lighting);
    GlossyRelighter other = std::move(asset.relighter);
    asset.relighter = std::move(other);
    EXPECT_TRUE(sameBits(before, asset.relight(lighting)));
}

}  // namespace
}  // namespace prt
