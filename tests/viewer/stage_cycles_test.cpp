#include <array>
#include <numeric>

#include <epoxy/gl.h>

#include "prt/base/resident_memory.h"
#include "tests/viewer/stage_fixture.h"

namespace prt::viewer {
namespace {

/// How many of OpenGL's names are in use, of each kind that we make.
std::array<int, 7> countGlNames() {
    constexpr GLuint kMostNames = 4096;  // drivers begin with 1
    std::array<int, 7> counts{};
    for (GLuint name = 1; name <= kMostNames; ++name) {
        counts[0] += glIsBuffer(name);
        counts[1] += glIsTexture(name);
        counts[2] += glIsProgram(name) || glIsShader(name);
        counts[3] += glIsVertexArray(name);
        counts[4] += glIsFramebuffer(name);
        counts[5] += glIsRenderbuffer(name);
        counts[6] += glIsSampler(name);
    }
    return counts;
}

/// Two objects, of vectors and of matrices, are put on the card, drawn, and taken away.
class StageCycles : public test::StageTest {
  protected:
    void SetUp() override {
        test::StageTest::SetUp();
        if (IsSkipped()) return;
        Scene ball = test::assembleScene({{makeSphere({0.0f, 0.0f, 0.0f}, 1.0f, 12)}});
        view_.objects = {
            {.asset = writeBaked(
                 "vectors.prt.glb", ball,
                 {.transport = Transport::shadowed, .bandCount = 3, .sampleCount = 16})}};
        ball.materials[0].metallicFactor = 1.0f;
        ball.materials[0].roughnessFactor = 0.0f;
        view_.objects.push_back({.asset = writeBaked("matrices.prt.glb", ball,
                                                     {.transport = Transport::glossyShadowed,
                                                      .bandCount = 3,
                                                      .incidentBandCount = 3,
                                                      .sampleCount = 16})});
        writeExr(pathOf("light.exr"), Image(8, 4, Vec3f(1.0f, 0.5f, 0.2f)));
        view_.lights = {{.source = pathOf("light.exr")}};
    }

    void run(Stage& stage, int count) const {
        for (int i = 0; i < count; ++i) {
            stage.finishLoading(view_);
            // What is read must have been drawn: drivers put off what nobody looks at.
            stage.draw(view_, 8, 8, 1).readRadiance();
            ASSERT_EQ(stage.describeFaults(), std::vector<std::string>());
            ASSERT_GT(stage.vertexCount(), 0u);
            stage.finishLoading(empty());
            ASSERT_EQ(stage.vertexCount(), 0u);
        }
    }

    /// Without objects.
    ViewState empty() const {
        ViewState view = view_;
        view.objects.clear();
        return view;
    }

    static double residentMegabytes() {
        releaseFreeMemory();
        return static_cast<double>(residentBytes()) * 1e-6;
    }

    ViewState view_;
};

class StageCyclesOnEither : public StageCycles, public testing::WithParamInterface<bool> {};

TEST_P(StageCyclesOnEither, AThousandLeaveNothingBehind) {
    Stage stage({.limits = kLimits, .relightsOnCard = GetParam(), .awaitedPathsPerPixel = 2});
    ASSERT_NO_FATAL_FAILURE(run(stage, 1));
    const std::array<int, 7> names = countGlNames();
    EXPECT_GT(std::accumulate(names.begin(), names.end(), 0), 10);
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    ASSERT_NO_FATAL_FAILURE(run(stage, 20));  // the sanitizers keep what was freed
#else
    constexpr double kMostGrowth = 0.02;
    ASSERT_NO_FATAL_FAILURE(run(stage, 99));
    const double afterHundred = residentMegabytes();
    ASSERT_NO_FATAL_FAILURE(run(stage, 900));
    EXPECT_LT(residentMegabytes(), afterHundred * (1.0 + kMostGrowth));
#endif
    EXPECT_EQ(countGlNames(), names);
}

INSTANTIATE_TEST_SUITE_P(, StageCyclesOnEither, testing::Bool(),
                         [](const auto& given) { return given.param ? "OnTheCard" : "OnTheCpu"; });

}  // namespace
}  // namespace prt::viewer
