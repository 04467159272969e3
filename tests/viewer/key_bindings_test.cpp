#include "apps/viewer/key_bindings.h"

#include <gtest/gtest.h>

#include <set>

namespace prt::viewer {
namespace {

using cli::ShownTransport;

constexpr int kEscape = 256, kTab = 258, kRight = 262, kLeft = 263;  // as GLFW numbers them

class KeyBindings : public testing::Test {
  protected:
    void press(int key, bool shift = false, bool control = false) {
        applyKey(view_, desk_, {.key = key, .shift = shift, .control = control}, view_.left,
                 choices_);
    }

    ViewState view_;
    Desk desk_;
    Choices choices_{.bandCount = 5,
                     .transports = {ShownTransport::unshadowed, ShownTransport::shadowed,
                                    ShownTransport::interreflected}};
};

TEST_F(KeyBindings, DigitsChooseBands) {
    press('3');
    EXPECT_EQ(view_.left.bandCount, 3);
    press('0');
    EXPECT_EQ(view_.left.bandCount, 10);
}

TEST_F(KeyBindings, TransportsGoRoundBothWays) {
    press('T');  // from the fullest
    EXPECT_EQ(view_.left.transport, ShownTransport::unshadowed);
    press('T');
    EXPECT_EQ(view_.left.transport, ShownTransport::shadowed);
    press('T', true);
    press('T', true);
    EXPECT_EQ(view_.left.transport, ShownTransport::interreflected);
}

TEST_F(KeyBindings, WithoutObjectsThereIsNoTransportToChoose) {
    choices_ = {};
    press('T');
    EXPECT_FALSE(view_.left.transport);
    press('V');
    EXPECT_TRUE(view_.right);
}

TEST_F(KeyBindings, ArrowsStepThroughTheCoefficientsOfTheBandsThereAre) {
    press(kLeft);
    EXPECT_EQ(view_.left.content, PaneContent::coefficient);
    EXPECT_EQ(view_.left.coefficient, 24);
    press(kRight);
    press(kRight);
    EXPECT_EQ(view_.left.coefficient, 1);
    press('C');
    EXPECT_EQ(view_.left.content, PaneContent::relit);
}

TEST_F(KeyBindings, SplittingSetsTheFullestBesideTheLeast) {
    press('2');
    press('V');
    ASSERT_TRUE(view_.right);
    EXPECT_EQ(view_.right->bandCount, 2);
    EXPECT_EQ(view_.right->transport, ShownTransport::unshadowed);
    EXPECT_FALSE(view_.left.transport);
    press('V');
    EXPECT_FALSE(view_.right);
}

TEST_F(KeyBindings, TheReferenceStandsInTheRightHalf) {
    press('R');
    ASSERT_TRUE(view_.right);
    EXPECT_EQ(view_.right->content, PaneContent::reference);
    EXPECT_EQ(view_.left.content, PaneContent::relit);
    press('R');
    EXPECT_FALSE(view_.right);
}

TEST_F(KeyBindings, SwitchesGoThereAndBack) {
    const ViewState before;
    for (const int key : {'L', 'K', 'B', 'M', 'X'})
        press(key);
    EXPECT_NE(view_.showLightLobe, before.showLightLobe);
    EXPECT_NE(view_.showTransferLobe, before.showTransferLobe);
    EXPECT_NE(view_.showBackground, before.showBackground);
    EXPECT_NE(view_.wireFrame, before.wireFrame);
    EXPECT_NE(view_.autoExposure, before.autoExposure);
    for (const int key : {'L', 'K', 'B', 'M', 'X'})
        press(key);
    EXPECT_EQ(view_.showLightLobe, before.showLightLobe);
    EXPECT_EQ(view_.autoExposure, before.autoExposure);
}

TEST_F(KeyBindings, WindowsAndToneCurvesGoRound) {
    std::set<std::string> windows;
    std::set<ToneCurve> curves;
    for (int i = 0; i < 4; ++i) {
        press('N');
        press('Y');
        windows.insert(view_.window);
        curves.insert(view_.display.toneCurve);
    }
    EXPECT_EQ(windows, (std::set<std::string>{"none", "hann", "lanczos", "auto"}));
    EXPECT_EQ(curves, (std::set{ToneCurve::none, ToneCurve::aces, ToneCurve::neutral}));
}

TEST_F(KeyBindings, FramingForgetsTheCamera) {
    view_.camera = CameraPose{};
    press('F');
    EXPECT_FALSE(view_.camera);
}

TEST_F(KeyBindings, KeysWithControlDoNothingElse) {
    press('S', false, true);
    EXPECT_TRUE(desk_.wantsSave);
    press('O', false, true);
    EXPECT_TRUE(desk_.wantsLoad);
    press('V', false, true);
    EXPECT_FALSE(view_.right);
    EXPECT_FALSE(desk_.wantsClose);
    press('Q', false, true);
    EXPECT_TRUE(desk_.wantsClose);
}

TEST_F(KeyBindings, EscapeClosesTheHelpBeforeItForgetsTheVertex) {
    view_.picked = PickedVertex{};
    press('H');
    EXPECT_TRUE(desk_.isHelpOpen);
    press(kEscape);
    EXPECT_FALSE(desk_.isHelpOpen);
    EXPECT_TRUE(view_.picked);
    press(kEscape);
    EXPECT_FALSE(view_.picked);
}

TEST_F(KeyBindings, PanelAndScreenshotAreOnTheDesk) {
    press(kTab);
    EXPECT_TRUE(desk_.isPanelOpen);
    press('P');
    EXPECT_TRUE(desk_.wantsScreenshot);
}

TEST(Flying, IsAlongTheKeysThatAreHeld) {
    const auto held = [](std::set<int> keys) {
        return findFlight([keys = std::move(keys)](int key) { return keys.contains(key); });
    };
    EXPECT_EQ(held({}), Flight{});
    EXPECT_EQ(held({'W', 'D', 'Q'}), (Flight{.forward = 1, .rightward = 1, .upward = -1}));
    EXPECT_EQ(held({'W', 'S', 'A', 'E'}), (Flight{.forward = 0, .rightward = -1, .upward = 1}));
}

}  // namespace
}  // namespace prt::viewer
