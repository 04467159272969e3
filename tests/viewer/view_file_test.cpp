#include "apps/viewer/view_file.h"

#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "prt/base/error.h"
#include "tests/support/temporary_folder.h"

namespace prt::viewer {
namespace {

using nlohmann::json;

/// Every field other than ViewState has it.
ViewState makeOtherView() {
    ViewState view;
    view.objects = {{.asset = "a b/\"ä\\.prt.glb", .rotationDegrees = {1.5, -2.25, 1e-300}},
                    {.asset = "", .isShown = false}};
    view.lights = {{.source = "uniform:1,2,3"},
                   {.source = "x.hdr", .stops = -1.5, .azimuthDegrees = 1.0 / 3.0, .isOn = false}};
    view.lightRotationDegrees = {0.1, 0.2, 0.3};
    view.window = "lanczos";
    view.camera = CameraPose{.target = {1.0, -2.0, 3.0},
                             .distance = 0.1,
                             .azimuthDegrees = -179.99,
                             .elevationDegrees = 89.0,
                             .fovDegrees = 12.5};
    view.left = {.content = PaneContent::coefficient,
                 .transport = cli::ShownTransport::glossyShadowed,
                 .bandCount = 1,
                 .coefficient = 99};
    view.right = Pane{.content = PaneContent::reference, .bandCount = 7};
    view.splitPosition = 0.125;
    view.autoExposure = false;
    view.display = {.exposureStops = 0.1f, .toneCurve = ToneCurve::neutral};
    view.showBackground = false;
    view.wireFrame = true;
    view.showLightLobe = true;
    view.showTransferLobe = false;
    view.picked = PickedVertex{.object = 1, .vertex = 123456789};
    return view;
}

bool isSame(const ViewState& a, const ViewState& b) {
    return formatView(a) == formatView(b);
}

TEST(ViewFile, EveryFieldSurvives) {
    const ViewState view = makeOtherView();
    const ViewState read = parseView(formatView(view), "a view");
    ASSERT_EQ(read.objects.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(read.objects[i].asset, view.objects[i].asset);
        EXPECT_EQ(read.objects[i].rotationDegrees, view.objects[i].rotationDegrees);
        EXPECT_EQ(read.objects[i].isShown, view.objects[i].isShown);
        EXPECT_EQ(read.lights.at(i).source, view.lights[i].source);
        EXPECT_EQ(read.lights[i].stops, view.lights[i].stops);
        EXPECT_EQ(read.lights[i].azimuthDegrees, view.lights[i].azimuthDegrees);
        EXPECT_EQ(read.lights[i].isOn, view.lights[i].isOn);
    }
    EXPECT_EQ(read.lightRotationDegrees, view.lightRotationDegrees);
    EXPECT_EQ(read.window, view.window);
    ASSERT_TRUE(read.camera);
    EXPECT_EQ(read.camera->target, view.camera->target);
    EXPECT_EQ(read.camera->distance, view.camera->distance);
    EXPECT_EQ(read.camera->azimuthDegrees, view.camera->azimuthDegrees);
    EXPECT_EQ(read.camera->elevationDegrees, view.camera->elevationDegrees);
    EXPECT_EQ(read.camera->fovDegrees, view.camera->fovDegrees);
    EXPECT_EQ(read.left, view.left);
    EXPECT_EQ(read.right, view.right);
    EXPECT_EQ(read.splitPosition, view.splitPosition);
    EXPECT_EQ(read.autoExposure, view.autoExposure);
    EXPECT_EQ(read.display.exposureStops, view.display.exposureStops);
    EXPECT_EQ(read.display.toneCurve, view.display.toneCurve);
    EXPECT_EQ(read.showBackground, view.showBackground);
    EXPECT_EQ(read.wireFrame, view.wireFrame);
    EXPECT_EQ(read.showLightLobe, view.showLightLobe);
    EXPECT_EQ(read.showTransferLobe, view.showTransferLobe);
    EXPECT_EQ(read.picked, view.picked);
}

TEST(ViewFile, EveryNameIsOfAFieldThatIsReadAndDiffersHere) {
    // So that a field which is added later must be added here, too.
    const json plain = json::parse(formatView({}));
    const json other = json::parse(formatView(makeOtherView()));
    for (const auto& [name, value] : other.items())
        EXPECT_NE(value, plain.at(name)) << name;
    for (const auto& [name, value] : other.at("left").items())
        EXPECT_NE(value, plain.at("left").at(name)) << name;
    EXPECT_EQ(other.size(), 16u);
}

TEST(ViewFile, EveryNamedValueSurvives) {
    ViewState view;
    for (const char* window : {"none", "hann", "lanczos", "auto"}) {
        view.window = window;
        EXPECT_EQ(parseView(formatView(view), "").window, window);
    }
    for (const ToneCurve curve : {ToneCurve::none, ToneCurve::aces, ToneCurve::neutral}) {
        view.display.toneCurve = curve;
        EXPECT_EQ(parseView(formatView(view), "").display.toneCurve, curve);
    }
    for (const PaneContent content :
         {PaneContent::relit, PaneContent::coefficient, PaneContent::reference}) {
        view.left.content = content;
        EXPECT_EQ(parseView(formatView(view), "").left.content, content);
    }
    for (int i = 0; i <= static_cast<int>(cli::ShownTransport::glossy); ++i) {
        view.left.transport = static_cast<cli::ShownTransport>(i);
        EXPECT_EQ(parseView(formatView(view), "").left, view.left);
    }
}

TEST(ViewFile, WhatIsNotSaidIsAsViewsHaveIt) {
    EXPECT_TRUE(isSame(parseView("{}", "a view"), ViewState()));
    ViewState view;
    view.right = Pane{.bandCount = 3};
    EXPECT_TRUE(isSame(parseView(R"({"right": {"bands": 3}})", "a view"), view));
}

/// @return  what the error says, empty if there is none
template <class Read>
std::string refusal(const Read& read) {
    try {
        read();
        return {};
    } catch (const Error& error) {
        return error.message();
    }
}

std::string refusalOfView(const std::string& text) {
    return refusal([&] { parseView(text, "a.view"); });
}

TEST(ViewFile, WhatDoesNotFitIsRefusedByItsPlace) {
    const std::vector<std::pair<std::string, std::string>> wrong = {
        {R"({"objekts": []})", "'objekts'"},
        {R"({"left": {"band": 3}})", "'left.band'"},
        {R"({"objects": [{"asset": "a"}, {"asset": 3}]})", "objects[1].asset"},
        {R"({"objects": {}})", "objects"},
        {R"({"objects": [3]})", "objects[0]"},
        {R"({"lights": [{"stops": 101}]})", "lights[0].stops"},
        {R"({"camera": {"distance": 0}})", "camera.distance"},
        {R"({"camera": {"distance": -1}})", "camera.distance"},
        {R"({"camera": {"fov_degrees": 0}})", "camera.fov_degrees"},
        {R"({"camera": {"fov_degrees": 180}})", "camera.fov_degrees"},
        {R"({"camera": {"elevation_degrees": 91}})", "camera.elevation_degrees"},
        {R"({"camera": {"target": [1, 2]}})", "camera.target"},
        {R"({"camera": {"target": [1, 2, "3"]}})", "camera.target"},
        {R"({"left": {"bands": 0}})", "left.bands"},
        {R"({"left": {"bands": 2.5}})", "left.bands"},
        {R"({"left": {"bands": 1000}})", "left.bands"},
        {R"({"left": {"coefficient": -1}})", "left.coefficient"},
        {R"({"left": {"content": "unlit"}})", "left.content"},
        {R"({"left": {"transport": "none"}})", "left.transport"},
        {R"({"left": null})", "left"},
        {R"({"window": "hamming"})", "window"},
        {R"({"tone": 1})", "tone"},
        {R"({"split_position": 1.5})", "split_position"},
        {R"({"exposure_stops": 1e39})", "exposure_stops"},
        {R"({"picked": {"vertex": -1}})", "picked.vertex"},
        {R"({"picked": {"vertex": 1e300}})", "picked.vertex"},
        {R"({"picked": {"vertex": 18446744073709551615}})", "picked.vertex"},
        {R"({"wire_frame": 1})", "wire_frame"},
        {R"([])", "a view"},
        {R"(null)", "a view"},
        {R"("view")", "a view"},
    };
    for (const auto& [text, place] : wrong) {
        const std::string said = refusalOfView(text);
        EXPECT_NE(said.find("a.view"), std::string::npos) << text;
        EXPECT_NE(said.find(place), std::string::npos) << text << ": " << said;
    }
}

TEST(ViewFile, TextsLikeNumbersThatJsonDoesNotHaveAreRefused) {
    for (const char* number : {"NaN", "nan", "Infinity", "-Infinity", "inf", "1e999", "-1e999",
                               "0x10", "1,5", "+1", ".5", "1.", "01", "--1", "\"1\"", "\"NaN\""}) {
        EXPECT_NE(
            refusalOfView(std::string(R"({"light_rotation_degrees": [0, )") + number + ", 0]}"), "")
            << number;
        EXPECT_NE(refusalOfView(std::string(R"({"split_position": )") + number + "}"), "")
            << number;
    }
    EXPECT_EQ(refusalOfView(R"({"light_rotation_degrees": [1e308, -1e-999, 0]})"), "");
}

TEST(ViewFile, DeepNestingIsRefusedWithoutGoingDown) {
    constexpr std::size_t kDepth = 1000000;
    const test::TemporaryFolder folder;
    std::string nestedObjects = R"({"left":)";
    for (int i = 0; i < 100000; ++i)
        nestedObjects += R"({"left":)";
    for (const std::string& text :
         {std::string(kDepth, '['), std::string(kDepth, '[') + std::string(kDepth, ']'),
          R"({"objects": )" + std::string(kDepth, '['), nestedObjects}) {
        EXPECT_NE(refusalOfView(text), "");
        EXPECT_NE(refusal([&] { applyPatch({}, text, "a script"); }), "");
        test::writeText(folder.path() / "script.json", text);
        EXPECT_NE(refusal([&] { loadScript(folder.path() / "script.json"); }), "");
    }
}

// ── Patches ──────────────────────────────────────────────────────────────────────────────────────

TEST(ViewPatch, ChangesWhatItNamesAndKeepsTheRest) {
    const ViewState view = makeOtherView();
    ViewState expected = view;
    expected.left.bandCount = 4;
    expected.display.toneCurve = ToneCurve::none;
    EXPECT_TRUE(
        isSame(applyPatch(view, R"({"left": {"bands": 4}, "tone": "none"})", "p"), expected));
    EXPECT_TRUE(isSame(applyPatch(view, "", "p"), view));
    EXPECT_TRUE(isSame(applyPatch(view, "{}", "p"), view));
}

// RFC 7396, appendix A, in the words of views: null takes away, objects are merged at all depths,
// and arrays are replaced as a whole.
TEST(ViewPatch, MergesAsTheStandardSays) {
    const ViewState view = makeOtherView();
    ViewState expected = view;
    expected.right.reset();
    expected.camera.reset();
    EXPECT_TRUE(isSame(applyPatch(view, R"({"right": null, "camera": null})", "p"), expected));

    expected = view;
    expected.left.transport.reset();
    EXPECT_TRUE(isSame(applyPatch(view, R"({"left": {"transport": null}})", "p"), expected));

    expected = view;
    expected.objects = {{.asset = "only"}};
    EXPECT_TRUE(isSame(applyPatch(view, R"({"objects": [{"asset": "only"}]})", "p"), expected));

    // What is not there comes into being, with the values that views have.
    expected = ViewState();
    expected.right = Pane{.content = PaneContent::coefficient};
    EXPECT_TRUE(isSame(applyPatch({}, R"({"right": {"content": "coefficient"}})", "p"), expected));

    // Null goes back to what views have; of a name that no view has, it is nothing.
    expected = view;
    expected.window = ViewState().window;
    EXPECT_TRUE(isSame(applyPatch(view, R"({"window": null, "unknown": null})", "p"), expected));

    for (const char* patch : {"[]", "3", "\"a\"", R"({"left": 3})", R"({"left": ["a"]})",
                              R"({"unknown": 1})", R"({"left": {"bands": {"a": 1}}})"})
        EXPECT_NE(refusal([&] { applyPatch(view, patch, "p"); }), "") << patch;
}

TEST(ViewScript, StepsAreReadInTheirOrder) {
    const test::TemporaryFolder folder;
    const auto path = folder.path() / "script.json";
    test::writeText(path,
                    R"([{"view": {"window": "hann"}}, {"screenshot": "a.png"}, {},
                        {"screenshot": "b.exr", "view": {"left": {"bands": 2}}}])");
    const std::vector<ScriptStep> steps = loadScript(path);
    ASSERT_EQ(steps.size(), 4u);
    EXPECT_EQ(applyPatch({}, steps[0].patch, "").window, "hann");
    EXPECT_EQ(steps[0].screenshot, "");
    EXPECT_EQ(steps[1].screenshot, "a.png");
    EXPECT_TRUE(isSame(applyPatch({}, steps[1].patch, ""), ViewState()));
    EXPECT_TRUE(isSame(applyPatch({}, steps[2].patch, ""), ViewState()));
    EXPECT_EQ(applyPatch({}, steps[3].patch, "").left.bandCount, 2);
    EXPECT_EQ(steps[3].screenshot, "b.exr");
    for (const char* text : {"{}", "[3]", R"([{"view": []}])", R"([{"screenshot": 1}])",
                             R"([{"views": {}}])", "", "[", "[{}],"}) {
        test::writeText(path, text);
        EXPECT_NE(refusal([&] { loadScript(path); }).find("script.json"), std::string::npos)
            << text;
    }
    EXPECT_NE(refusal([&] { loadScript(folder.path() / "missing.json"); }), "");
}

TEST(ViewFile, IsSavedAndLoaded) {
    const test::TemporaryFolder folder;
    saveView(folder.path() / "a.json", makeOtherView());
    EXPECT_TRUE(isSame(loadView(folder.path() / "a.json"), makeOtherView()));
    EXPECT_NE(refusal([&] { loadView(folder.path() / "b.json"); }), "");
}

// ── Hostile texts ────────────────────────────────────────────────────────────────────────────────

/// A text either is refused by an Error, or is a view that can be written and read again.
void expectSafe(const std::string& text) {
    const auto expectSame = [&](const ViewState& view) {
        ASSERT_TRUE(isSame(parseView(formatView(view), "again"), view)) << text;
    };
    refusal([&] { expectSame(parseView(text, "a view")); });
    refusal([&] { expectSame(applyPatch(makeOtherView(), text, "a patch")); });
}

/// Without blanks.
std::string makeSmallText() {
    return json::parse(formatView(makeOtherView())).dump();
}

TEST(HostileView, EveryPrefixIsSafe) {
    const std::string text = makeSmallText();
    ASSERT_NO_FATAL_FAILURE(expectSafe(text));
    for (std::size_t size = 0; size < text.size(); ++size) {
        EXPECT_NE(refusalOfView(text.substr(0, size)), "");
        ASSERT_NO_FATAL_FAILURE(expectSafe(text.substr(0, size)));
    }
}

TEST(HostileView, EveryChangeOfAByteIsSafe) {
    const std::string text = makeSmallText();
    for (std::size_t i = 0; i < text.size(); ++i) {
        for (const char other :
             {'\0', '"', '{', '}', '[', ']', ',', ':', '-', '9', 'e', '.', '\\', ' ', '\n', '\x80',
              '\xff', static_cast<char>(text[i] ^ 1), static_cast<char>(text[i] ^ 32)}) {
            std::string changed = text;
            changed[i] = other;
            ASSERT_NO_FATAL_FAILURE(expectSafe(changed));
        }
    }
}

TEST(HostileView, EveryValueTakenForAnotherIsSafe) {
    const json view = json::parse(makeSmallText());
    const std::vector<json> others = {nullptr,
                                      true,
                                      0,
                                      -1,
                                      1e300,
                                      -1e300,
                                      4294967296,
                                      1e9,
                                      0.5,
                                      "",
                                      "none",
                                      json::array(),
                                      json::object(),
                                      json::array({json::array()}),
                                      std::string(100000, 'a'),
                                      std::string("\0", 1)};
    const json places = view.flatten();
    for (const auto& [place, value] : places.items()) {
        for (const json& other : others) {
            json changed = view;
            changed[json::json_pointer(place)] = other;
            ASSERT_NO_FATAL_FAILURE(expectSafe(changed.dump()));
        }
    }
}

TEST(HostileScript, EveryPrefixAndChangeOfAByteIsSafe) {
    const test::TemporaryFolder folder;
    const auto path = folder.path() / "script.json";
    const std::string text = R"([{"view":{"left":{"bands":2}},"screenshot":"a.png"},{}])";
    const auto expectSafeScript = [&](const std::string& script) {
        test::writeText(path, script);
        refusal([&] {
            for (const ScriptStep& step : loadScript(path))
                applyPatch({}, step.patch, "the script");
        });
    };
    for (std::size_t size = 0; size <= text.size(); ++size)
        expectSafeScript(text.substr(0, size));
    for (std::size_t i = 0; i < text.size(); ++i) {
        for (const char other : {'\0', '"', '{', '}', '[', ']', ',', ':', '-', '9', '\\', '\xff'}) {
            std::string changed = text;
            changed[i] = other;
            expectSafeScript(changed);
        }
    }
}

}  // namespace
}  // namespace prt::viewer
