#include "prt/gpu/gpu_glossy_relighter.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "prt/base/error.h"
#include "prt/base/random.h"
#include "prt/gpu/gpu_mirrors.h"
#include "prt/gpu/gpu_vertex_radiance.h"
#include "prt/gpu/gpu_view.h"
#include "prt/scene/framing.h"
#include "prt/scene/procedural.h"
#include "tests/gpu/gl_test.h"
#include "tests/support/clustered_layers.h"

namespace prt {
namespace {

/// The same for tables on both sides, so that they need not be fine.
constexpr LobeQuadratureOptions kCoarse{.polarNodeCount = 24, .azimuthNodeCount = 12};

/// Of what the card makes beside what GlossyRelighter makes: sums in float, in another sequence.
constexpr double kLeastDecibels = 90.0;
/// Of a share between 0 and 1.
constexpr float kVisibilityRounding = 1e-4f;

constexpr std::size_t kReceiverCount = 150;  // no multiple of a work group

struct Form {
    TransferEncoding encoding = TransferEncoding::float32;
    int channelCount = 1;
    bool isClustered = false;

    std::string name() const {
        return std::string(encodingName(encoding)) + " of " + std::to_string(channelCount) +
               (isClustered ? " in clusters" : "");
    }
};

std::vector<Form> listForms() {
    std::vector<Form> forms;
    for (const TransferEncoding encoding :
         {TransferEncoding::float32, TransferEncoding::unorm16, TransferEncoding::unorm8})
        for (const int channelCount : {1, 3})
            for (const bool isClustered : {false, true})
                forms.push_back({encoding, channelCount, isClustered});
    return forms;
}

struct Bands {
    int incident = 3;
    int light = 4;
};

CompressedLayer makeLayer(Transport transport, const Form& form, const Bands& bands) {
    RandomStream random(static_cast<std::uint64_t>(transport), 11);
    CompressedLayer layer{.transport = transport, .channelCount = form.channelCount};
    layer.incidentBandCount = bands.incident;
    const std::size_t size = coefficientsPerReceiver(bands.light, layer);
    if (!form.isClustered) {
        layer.table = test::makeRandomTable(form.encoding, kReceiverCount, size, random);
        return layer;
    }
    const CompressedLayer weights =
        test::makeClusteredLayer(Transport::shadowed, 1, kReceiverCount,
                                 {.weights = form.encoding, .componentCounts = {2, 0, 9, 4}},
                                 static_cast<std::uint64_t>(transport));
    layer.table = weights.table;
    layer.bases = weights.bases;
    layer.bases->vectors = test::makeRandomTable(TransferEncoding::unorm16,
                                                 layer.bases->firstVectors().back(), size, random);
    return layer;
}

/// Visibility alone, and all light; more vertices than receivers.
CompressedTransfer makeTransfer(const Form& form, const Bands& bands) {
    CompressedTransfer transfer;
    transfer.bandCount = bands.light;
    transfer.receiverCount = kReceiverCount;
    for (std::size_t vertex = 0; vertex < kReceiverCount + 33; ++vertex)
        transfer.receiverOfVertex.push_back(
            static_cast<std::uint32_t>((7 * vertex + 3) % kReceiverCount));
    for (const Transport transport : {Transport::glossyShadowed, Transport::glossy})
        transfer.layers.push_back(makeLayer(transport, form, bands));
    return transfer;
}

Vec3f drawDirection(RandomStream& random) {
    Vec3f direction(0.0f);
    while (direction.length() < 0.1f)
        for (int axis = 0; axis < 3; ++axis)
            direction[axis] = 2.0f * random.nextUnitFloat() - 1.0f;
    return direction.normalized();
}

/// Anywhere and of anything, of three materials.
std::vector<ReceiverSurface> makeReceivers() {
    RandomStream random(5, 1);
    std::vector<ReceiverSurface> receivers(kReceiverCount);
    for (ReceiverSurface& receiver : receivers)
        receiver = {drawDirection(random), drawDirection(random), random.nextBits() % 3,
                    MetallicRoughness{random.nextUnitFloat(), random.nextUnitFloat()}};
    receivers[0].normal = {0.0f, 0.0f, 1.0f};
    receivers[1].normal = {0.0f, 0.0f, -1.0f};
    receivers[2].surface.roughness = 1.0f;
    receivers[3].surface.roughness = 0.0f;
    return receivers;
}

Lighting makeLighting(int bandCount) {
    RandomStream random(9, 2);
    Lighting lighting(bandCount);
    for (Vec3d& coefficient : lighting.coefficients)
        for (int channel = 0; channel < 3; ++channel)
            coefficient[channel] = 2.0 * random.nextUnitDouble() - 1.0;
    return lighting;
}

GltfViewTable makeViews(int bandCount) {
    return GltfViewTable(
        {.bandCount = bandCount, .levelCount = 5, .viewCount = 6, .quadrature = kCoarse});
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

/// How much larger values are than their differences.
class Ratio {
  public:
    void add(const Vec3f& value, const Vec3f& other) {
        values_ += static_cast<double>(value.length2());
        differences_ += static_cast<double>((value - other).length2());
    }
    double decibels() const { return 10.0 * std::log10(values_ / differences_); }
    double meanSquare(std::size_t count) const { return values_ / static_cast<double>(count); }

  private:
    double values_ = 0.0, differences_ = 0.0;
};

class GpuGlossy : public test::GlTest {
  protected:
    void expectAsOnCpu(const CompressedTransfer& transfer, Transport transport,
                       const GlossyRelightOptions& options, const Lighting& lighting,
                       const std::string& what) {
        SCOPED_TRACE(what);
        const std::vector<ReceiverSurface> receivers = makeReceivers();
        const GltfViewTable views = makeViews(transfer.layers[0].incidentBandCount);
        const GlossyRelighter cpu(transfer, transport, receivers, views, options);
        GpuGlossyRelighter gpu(transfer, transport, receivers, views, options);
        gpu.relight(lighting);
        // Outside, inside, and at a receiver.
        for (const Vec3f& eye :
             {Vec3f(2.0f, 1.0f, 3.0f), Vec3f(0.1f, -0.2f, 0.0f), receivers[7].position}) {
            std::vector<ExitRadiance> expected(kReceiverCount);
            cpu.relight(lighting, eye, 0, expected);
            gpu.lookFrom(eye);
            expectSame(gpu.read(), expected, transfer.receiverOfVertex);
        }
    }

    void expectSame(const std::vector<ExitRadiance>& vertices,
                    const std::vector<ExitRadiance>& receivers,
                    const std::vector<std::uint32_t>& receiverOfVertex) {
        ASSERT_EQ(vertices.size(), receiverOfVertex.size());
        Ratio perBaseColor, constant;
        for (std::size_t vertex = 0; vertex < vertices.size(); ++vertex) {
            const ExitRadiance& expected = receivers[receiverOfVertex[vertex]];
            perBaseColor.add(expected.perBaseColor, vertices[vertex].perBaseColor);
            constant.add(expected.constant, vertices[vertex].constant);
            ASSERT_NEAR(vertices[vertex].mirrorVisibility, expected.mirrorVisibility,
                        kVisibilityRounding)
                << vertex;
            largestVisibility_ = std::max(largestVisibility_, expected.mirrorVisibility);
        }
        EXPECT_GE(perBaseColor.decibels(), kLeastDecibels);
        EXPECT_GE(constant.decibels(), kLeastDecibels);
        EXPECT_GE(perBaseColor.meanSquare(vertices.size()), 1e-4);  // there is something to see
        EXPECT_GE(constant.meanSquare(vertices.size()), 1e-5);
    }

    float largestVisibility_ = 0.0f;
};

TEST_F(GpuGlossy, EveryFormIsRelitAsOnTheCpu) {
    constexpr Bands kBands;
    for (const Form& form : listForms())
        expectAsOnCpu(makeTransfer(form, kBands), Transport::glossy, {}, makeLighting(kBands.light),
                      form.name());
}

TEST_F(GpuGlossy, EveryNumberOfBandsIsRelitAsOnTheCpu) {
    for (const Bands& bands :
         {Bands{1, 1}, Bands{1, 4}, Bands{2, 2}, Bands{4, 1}, Bands{3, 5}, Bands{6, 3}})
        for (const bool isClustered : {false, true})
            expectAsOnCpu(makeTransfer({TransferEncoding::unorm16, 3, isClustered}, bands),
                          Transport::glossy, {}, makeLighting(bands.light),
                          std::to_string(bands.incident) + " × " + std::to_string(bands.light));
}

TEST_F(GpuGlossy, LightOfFewerBandsLeavesTheHigherOnesOut) {
    for (const bool isClustered : {false, true})
        expectAsOnCpu(makeTransfer({TransferEncoding::unorm8, 1, isClustered}, {}),
                      Transport::glossy, {}, makeLighting(2), "two bands");
}

TEST_F(GpuGlossy, SplitReceiversAreRelitAsOnTheCpu) {
    constexpr Bands kBands;
    for (const Form& form : listForms())
        for (const Transport transport : {Transport::glossyShadowed, Transport::glossy}) {
            largestVisibility_ = 0.0f;
            expectAsOnCpu(makeTransfer(form, kBands), transport, {.leastRoughness = 0.5},
                          makeLighting(kBands.light),
                          form.name() + " " + std::string(transportName(transport)));
            EXPECT_GT(largestVisibility_, 0.05f);
        }
}

TEST_F(GpuGlossy, MaterialsOfOtherBrdfsAreRelitAsOnTheCpu) {
    constexpr Bands kBands;
    const GlossyRelightOptions options{.leastRoughness = 0.3,
                                       .materialTables = makeMaterialTables(kBands.incident)};
    expectAsOnCpu(makeTransfer({}, kBands), Transport::glossy, options, makeLighting(kBands.light),
                  "Phong");
}

/// White from everywhere.
MirrorEnvironment makeWhiteMirrors() {
    Environment environment{SphereMap::latLong, Image(4, 2)};
    environment.radiance.pixels.assign(8, Vec3f(1.0f));
    return makeMirrorEnvironment(environment, {},
                                 {.mostRoughness = 0.5, .faceSize = 4, .sampleCount = 16});
}

TEST_F(GpuGlossy, PictureIsThatOfRadianceHandedOverWithMirrorsAndWithout) {
    Scene scene;
    scene.materials.emplace_back().baseColorFactor = {0.8f, 0.5f, 0.2f, 1.0f};
    scene.meshes.push_back(makeSphere({0.0f, 0.0f, 0.0f}, 1.0f, 12));
    CompressedTransfer transfer = makeTransfer({TransferEncoding::unorm16, 3, false}, {});
    transfer.receiverOfVertex.resize(scene.vertexCount(), 0);
    const Camera camera = lookAt({2.0f, 1.0f, 3.0f}, {0.0f, 0.0f, 0.0f}, 0.7f);
    const GpuScene gpuScene(scene);
    const GpuMirrors mirrors(makeWhiteMirrors());
    GpuViewOptions options;
    options.mirrors = &mirrors;
    const auto draw = [&](const GpuRadiance& radiance) {
        const GpuTarget target(40, 30);
        drawGpuView({{{&gpuScene, &radiance}}}, camera, target, options);
        return target.readRadiance();
    };
    for (const bool hasMirrors : {false, true}) {
        SCOPED_TRACE(hasMirrors);
        GpuGlossyRelighter gpu(transfer, Transport::glossy, makeReceivers(), makeViews(3),
                               {.leastRoughness = hasMirrors ? 0.8 : 0.0});
        gpu.relight(makeLighting(4));
        gpu.lookFrom(camera.eye);
        EXPECT_EQ(gpu.hasMirrors(), hasMirrors);
        GpuVertexRadiance handedOver(scene.vertexCount());
        handedOver.upload(gpu.read());
        const Image picture = draw(gpu);
        EXPECT_EQ(picture.pixels, draw(handedOver).pixels);
        EXPECT_GT(std::ranges::count_if(picture.pixels, [](const Vec3f& p) { return p.x != 0.0f; }),
                  300);
    }
}

TEST_F(GpuGlossy, LayerThatIsNotThereIsRefused) {
    CompressedTransfer transfer = makeTransfer({}, {});
    transfer.layers.erase(transfer.layers.begin());
    try {
        GpuGlossyRelighter(transfer, Transport::glossyShadowed, makeReceivers(), makeViews(3));
        FAIL() << "it was there";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::invalidOption);
    }
}

TEST_F(GpuGlossy, LightComesAndGoes) {
    const CompressedTransfer transfer = makeTransfer({TransferEncoding::unorm8, 3, false}, {});
    const Vec3f eye(2.0f, 1.0f, 3.0f);
    GpuGlossyRelighter gpu(transfer, Transport::glossy, makeReceivers(), makeViews(3));
    EXPECT_EQ(gpu.bandCount(), 4);
    EXPECT_EQ(gpu.vertexCount(), transfer.receiverOfVertex.size());
    const auto brightest = [&] {
        gpu.lookFrom(eye);
        float value = 0.0f;
        for (const ExitRadiance& vertex : gpu.read())
            value = std::max(value, vertex.constant.length());
        return value;
    };
    EXPECT_EQ(brightest(), 0.0f);
    gpu.relight(makeLighting(4));
    EXPECT_GT(brightest(), 0.01f);
    gpu.relight(Lighting(1));
    EXPECT_EQ(brightest(), 0.0f);
}

}  // namespace
}  // namespace prt
