// prt web: one page with assets and lights in it.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numbers>
#include <regex>
#include <string>
#include <vector>

#include "prt/asset/asset.h"
#include "prt/base/file.h"
#include "prt/gltf/glb_writer.h"
#include "prt/image/sphere_map.h"
#include "prt/io/image_io.h"
#include "prt/scene/framing.h"
#include "tests/cli/run_prt.h"
#include "tests/gltf/glb_file.h"
#include "tests/support/scenes.h"

namespace prt::test {
namespace {

using Json = nlohmann::json;

constexpr int kDataAtFault = 1, kWrongUsage = 2;
constexpr int kWidth = 128, kHeight = 64;
constexpr double kPi = std::numbers::pi;

// Eleven bits of a half, rounded.
constexpr double kHalfPrecision = 1.0 / 2048.0;

/// The page as a browser takes it apart: what stands in its script elements, by id.
///
/// A script element ends at the first "</script", whatever stands before it [HTML, 13.2.5.4].
std::string elementText(const std::string& page, const std::string& id) {
    const std::size_t tag = page.find(" id=\"" + id + "\">");
    EXPECT_NE(tag, std::string::npos) << id;
    if (tag == std::string::npos) return {};
    const std::size_t begin = page.find('>', tag) + 1;
    std::string text = page.substr(begin, page.find("</script", begin) - begin);
    EXPECT_EQ(text.find("<!--"), std::string::npos) << "the element would end elsewhere";
    return text;
}

/// Slow and obviously right [RFC 4648, 4]: the bits of all digits in a row, eight at a time.
std::string decodeBase64(const std::string& text) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    EXPECT_EQ(text.size() % 4, 0u);
    std::vector<bool> bits;
    for (const char c : text.substr(0, text.find('='))) {
        const std::size_t value = digits.find(c);
        EXPECT_NE(value, std::string::npos) << "'" << c << "' is not base64";
        for (int bit = 5; bit >= 0; --bit)
            bits.push_back((value >> bit) & 1);
    }
    std::string bytes;
    for (std::size_t i = 0; i + 8 <= bits.size(); i += 8) {
        int byte = 0;
        for (std::size_t k = 0; k < 8; ++k)
            byte = 2 * byte + (bits[i + k] ? 1 : 0);
        bytes += static_cast<char>(byte);
    }
    return bytes;
}

/// What 16 bits stand for: a sign, five bits of exponent, ten of fraction [IEEE 754].
double decodeHalf(unsigned bits) {
    const int exponent = static_cast<int>((bits >> 10) & 31);
    const double fraction = (bits & 1023) / 1024.0;
    EXPECT_LT(exponent, 31) << "neither infinite nor NaN";
    const double magnitude =
        exponent == 0 ? std::ldexp(fraction, -14) : std::ldexp(1.0 + fraction, exponent - 15);
    return bits >> 15 ? -magnitude : magnitude;
}

using Picture = std::vector<std::array<double, 3>>;

class CliWeb : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = new TemporaryFolder;
        Scene scene =
            assembleScene({{makeFloor(2.0f, 0.0f, 4), {0.9f, 0.8f, 0.7f}},
                           {makeSphere(Vec3f(0.0f, 0.51f, 0.0f), 0.5f, 8), {0.8f, 0.8f, 0.8f}}});
        writeGlb(file("stage.glb"), scene);
        scene.cameras.push_back({.name = "front",
                                 .eye = {0.5f, 1.0f, 3.0f},
                                 .forward = {0.0f, 0.0f, -1.0f},
                                 .up = {0.0f, 1.0f, 0.0f},
                                 .verticalFovRadians = 0.75f});
        writeGlb(file("seen.glb"), scene);
        bake("stage", "4");
        bake("seen", "3");
        hasPage_ =
            attempt({"web", "lost.prt.glb", "-o", "page.html"}).errors.find("without Node.js") ==
            std::string::npos;
    }
    static void TearDownTestSuite() { delete folder_; }
    void SetUp() override {
        if (!hasPage_) GTEST_SKIP() << "this prt was built without Node.js";
    }

    static CommandResult attempt(const std::vector<std::string>& arguments) {
        return runPrt(*folder_, arguments);
    }
    static CommandResult run(const std::vector<std::string>& arguments) {
        CommandResult result = attempt(arguments);
        EXPECT_EQ(result.exitCode, 0) << result.errors;
        return result;
    }
    static void bake(const std::string& scene, const std::string& bandCount) {
        run({"bake", scene + ".glb", "-o", scene + ".prt.glb", "--bands", bandCount, "--samples",
             "16", "--bounces", "0", "--max-edge", "none"});
    }
    static std::string makePage(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "web");
        arguments.insert(arguments.end(), {"-o", "page.html"});
        run(arguments);
        return readText(file("page.html"));
    }
    static Json readData(const std::string& page) {
        return Json::parse(elementText(page, "prt-data"));
    }
    static Picture readPicture(const std::string& page, std::size_t light) {
        const std::string bytes =
            decodeBase64(elementText(page, "prt-light-" + std::to_string(light)));
        Picture picture(kWidth * kHeight);
        EXPECT_EQ(bytes.size(), picture.size() * 6);
        if (bytes.size() != picture.size() * 6) return picture;
        for (std::size_t i = 0; i < 3 * picture.size(); ++i) {
            const auto low = static_cast<unsigned char>(bytes[2 * i]);
            const auto high = static_cast<unsigned char>(bytes[2 * i + 1]);
            picture[i / 3][i % 3] = decodeHalf(256u * high + low);
        }
        return picture;
    }
    static void expectRefused(const std::vector<std::string>& arguments, int exitCode,
                              const std::vector<std::string>& words) {
        test::expectRefused(*folder_, arguments, exitCode, words);
    }
    static std::filesystem::path file(const std::string& name) { return folder_->path() / name; }

  private:
    static inline TemporaryFolder* folder_ = nullptr;
    static inline bool hasPage_ = false;
};

TEST_F(CliWeb, ThePageHoldsTheBytesOfEachAsset) {
    // Files of every length modulo three.
    for (const std::string padding : {"", " ", "  "}) {
        GlbFile glb = splitGlb(readFile(file("stage.prt.glb"), 1 << 26));
        glb.json["asset"]["copyright"] = padding;
        const std::vector<std::byte> bytes = joinGlb(glb);
        writeText(file("padded.prt.glb"),
                  {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        const std::string page =
            makePage({"padded.prt.glb", "seen.prt.glb", "--light", "uniform:1"});
        EXPECT_EQ(decodeBase64(elementText(page, "prt-asset-0")), readText(file("padded.prt.glb")));
        EXPECT_EQ(decodeBase64(elementText(page, "prt-asset-1")), readText(file("seen.prt.glb")));
        EXPECT_EQ(page.find("prt-asset-2"), std::string::npos);
        EXPECT_TRUE(page.starts_with("<!doctype html>"));
        EXPECT_GT(page.rfind("</html>"), page.find("id=\"prt-light-0\""));
    }
}

TEST_F(CliWeb, NamesAreThoseOfFilesAndToldApart) {
    std::filesystem::create_directories(file("other"));
    std::filesystem::copy_file(file("seen.prt.glb"), file("other/stage.glb"));
    writeExr(file("museum.exr"), Image(16, 8, Vec3f(0.5f, 1.0f, 2.0f)));
    const Json data =
        readData(makePage({"stage.prt.glb", "seen.prt.glb", "other/stage.glb", "--light",
                           "museum.exr", "--light", "sun:60,40,20", "--light", "museum.exr"}));
    const std::array assets = {"stage", "seen", "stage 2"};
    const std::array lights = {"museum", "sun:60,40,20", "museum 2"};
    ASSERT_EQ(data.at("assets").size(), 3u);
    ASSERT_EQ(data.at("lights").size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(data["assets"][i].at("name"), assets[i]);
        EXPECT_EQ(data["lights"][i].at("name"), lights[i]);
    }
    std::filesystem::remove_all(file("other"));
}

TEST_F(CliWeb, CoefficientsAreThoseOfPrtLightInTheBandsOfTheAssetThatHasMost) {
    constexpr double kRounding = 1e-12;  // prt light turns what it prints by no degrees
    writeText(file("lamp.json"),
              R"({"bands": 1, "convention": "cs", "coefficients": [[1, 2, 3]]})");
    const std::vector<std::string> lights = {"sky:40,50,3", "sun:0,50,20", "lamp.json"};
    const Json data = readData(makePage({"seen.prt.glb", "stage.prt.glb", "seen.prt.glb", "--light",
                                         lights[0], "--light", lights[1], "--light", lights[2]}));
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const Json printed =
            Json::parse(run({"light", lights[i], "--bands", "4", "--format", "json"}).output);
        const Json& lighting = data.at("lights").at(i).at("lighting");
        EXPECT_EQ(lighting.at("bands"), lights[i] == "lamp.json" ? 1 : 4);
        for (const char* key : {"bands", "convention"})
            EXPECT_EQ(lighting.at(key), printed.at(key));
        const Json& expected = printed.at("coefficients");
        ASSERT_EQ(lighting.at("coefficients").size(), expected.size());
        for (std::size_t k = 0; k < 3 * expected.size(); ++k)
            EXPECT_NEAR(lighting["coefficients"][k / 3].at(k % 3).get<double>(),
                        expected[k / 3].at(k % 3).get<double>(), kRounding)
                << lights[i];
    }
}

TEST_F(CliWeb, WithoutALightThereAreThree) {
    const Json data = readData(makePage({"stage.prt.glb"}));
    ASSERT_EQ(data.at("lights").size(), 3u);
    EXPECT_EQ(data["lights"][0].at("name"), "daylight:150,40");
    EXPECT_EQ(data["lights"][1].at("name"), "sun:60,40,20");
    EXPECT_EQ(data["lights"][2].at("name"), "uniform:1");
}

void expectCamera(const Json& entry, const Camera& camera) {
    constexpr double kRounding = 1e-6;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const int i = static_cast<int>(axis);
        EXPECT_NEAR(entry.at("eye").at(axis).get<double>(), camera.eye[i], kRounding);
        EXPECT_NEAR(entry.at("forward").at(axis).get<double>(), camera.forward[i], kRounding);
    }
    EXPECT_NEAR(entry.at("verticalFovDegrees").get<double>() * kPi / 180.0,
                camera.verticalFovRadians, kRounding);
}

TEST_F(CliWeb, TheCameraIsThatOfPrtRender) {
    const Scene stage = readAsset(file("stage.prt.glb")).scene;
    const Scene seen = readAsset(file("seen.prt.glb")).scene;
    const Json assets =
        readData(makePage({"stage.prt.glb", "seen.prt.glb", "--light", "uniform:1"})).at("assets");
    expectCamera(assets.at(0).at("camera"), frameScene(stage, 16.0f / 9.0f));
    expectCamera(assets.at(1).at("camera"), seen.cameras.at(0));
    EXPECT_NEAR(assets[1]["camera"]["eye"][2].get<double>(), 3.0, 1e-6);

    const Json chosen = readData(makePage({"stage.prt.glb", "--eye", "1,2,3", "--target", "1,2,0",
                                           "--fov", "30", "--light", "uniform:1"}))
                            .at("assets");
    expectCamera(chosen.at(0).at("camera"), lookAt(Vec3f(1.0f, 2.0f, 3.0f), Vec3f(1.0f, 2.0f, 0.0f),
                                                   static_cast<float>(kPi / 6.0)));
}

TEST_F(CliWeb, UniformLightIsAUniformPicture) {
    const std::string page =
        makePage({"stage.prt.glb", "--light", "uniform:1", "--light", "uniform:0.5,2,1000000"});
    const Json size{{"width", kWidth}, {"height", kHeight}};
    for (const Json& light : readData(page).at("lights"))
        EXPECT_EQ(light.at("picture"), size);
    constexpr double kLargestHalf = 65504.0;
    for (const auto& texel : readPicture(page, 0))
        for (const double radiance : texel)
            ASSERT_NEAR(radiance, 1.0, kHalfPrecision);
    for (const auto& texel : readPicture(page, 1)) {
        ASSERT_NEAR(texel[0], 0.5, 0.5 * kHalfPrecision);
        ASSERT_NEAR(texel[1], 2.0, 2.0 * kHalfPrecision);
        ASSERT_EQ(texel[2], kLargestHalf);
    }
}

/// A disc of half angle α whose irradiance is L π sin²α = 1 has the flux L 2π (1 − cos α) = 1 /
/// cos²(α/2).
TEST_F(CliWeb, ASunsPictureHoldsItsFluxWhereItStands) {
    const double halfAngle = 10.0 * kPi / 180.0;
    const double elevation = 40.0 * kPi / 180.0;
    const Picture picture = readPicture(makePage({"stage.prt.glb", "--light", "sun:60,40,20"}), 0);
    double flux = 0.0, sum = 0.0;
    Vec3d centre(0.0);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const SphereTexel texel = sphereTexel(SphereMap::latLong, kWidth, kHeight, x, y);
            const double red = picture[static_cast<std::size_t>(y * kWidth + x)][0];
            flux += red * texel.solidAngle;
            sum += red;
            centre += texel.direction * red * texel.solidAngle;
        }
    EXPECT_GT(sum, 0.0);
    const double expected = 1.0 / std::pow(std::cos(halfAngle / 2.0), 2.0);
    EXPECT_NEAR(flux, expected, expected * kHalfPrecision);
    const Vec3d direction(std::cos(elevation) * 0.5, std::sin(elevation),
                          std::cos(elevation) * std::sqrt(0.75));
    constexpr double kCosineOfHalfATexel = 0.9997;
    EXPECT_GT(centre.normalized().dot(direction), kCosineOfHalfATexel);
}

/// Of an image of 2 × 2 texels a texel of the picture, each has the mean over solid angles.
TEST_F(CliWeb, APictureIsTheMeanOfTheTexelsBeneathIt) {
    Image image(2 * kWidth, 2 * kHeight);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            image.at(x, y) = Vec3f(x < image.width / 2 ? 1.0f : 3.0f);
    writeExr(file("halves.exr"), image);
    const Picture picture = readPicture(makePage({"stage.prt.glb", "--light", "halves.exr"}), 0);
    for (int y = 0; y < kHeight; ++y)
        for (const auto& [x, expected] :
             {std::pair(kWidth / 4, 1.0), std::pair(3 * kWidth / 4, 3.0)})
            EXPECT_NEAR(picture[static_cast<std::size_t>(y * kWidth + x)][1], expected,
                        expected * kHalfPrecision)
                << x << " " << y;
}

TEST_F(CliWeb, NegativeLobesOfCoefficientsAreBlack) {
    writeText(file("lobe.json"),
              R"({"bands": 2, "convention": "cs",
                  "coefficients": [[1, 1, 1], [0, 0, 0], [0, 0, 0], [2, 2, 2]]})");
    const Picture picture = readPicture(makePage({"stage.prt.glb", "--light", "lobe.json"}), 0);
    std::size_t blackCount = 0;
    for (const auto& texel : picture) {
        ASSERT_GE(texel[0], 0.0);
        blackCount += texel[0] == 0.0;
    }
    EXPECT_GT(blackCount, picture.size() / 4);
    EXPECT_LT(blackCount, picture.size() / 2);
}

TEST_F(CliWeb, NoNameCanBreakOutOfThePage) {
    const std::vector<std::string> names = {R"(<)"
                                            "\xE2\x81\x84"
                                            R"(script><script>alert(1)<!-- )",
                                            R"("quoted" 'twice' \ back & amp;)", "Käse 陶器",
                                            "bro\xFFken"};
    const std::string evil = "museum<!--<script>.exr";
    writeExr(file(evil), Image(16, 8, Vec3f(1.0f)));
    std::vector<std::string> arguments;
    for (const std::string& name : names) {
        std::filesystem::copy_file(file("stage.prt.glb"), file(name + ".prt.glb"));
        arguments.push_back(name + ".prt.glb");
    }
    writeText(file("lamp.json"),
              R"({"bands": 1, "convention": "cs", "coefficients": [[1, 2, 3]]})");
    arguments.insert(arguments.end(), {"--light", evil, "--light", "lamp.json"});
    const std::string page = makePage(arguments);
    const Json data = readData(page);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(data.at("assets").at(i).at("name"), names[i]);
    EXPECT_EQ(data["assets"][3].at("name"), "bro\xEF\xBF\xBDken");
    EXPECT_EQ(data.at("lights").at(0).at("name"), "museum<!--<script>");
    EXPECT_EQ(elementText(page, "prt-data").find('<'), std::string::npos);
    EXPECT_EQ(decodeBase64(elementText(page, "prt-asset-3")), readText(file("stage.prt.glb")));
    for (const std::string& name : names)
        std::filesystem::remove(file(name + ".prt.glb"));
}

/// Strings of libraries may name a namespace or a page to read: none may be fetched.
TEST_F(CliWeb, ThePageNeedsNoNetwork) {
    const std::string page = makePage({"stage.prt.glb", "--light", "uniform:1"});
    const std::regex fetched(
        R"re((src|href|import|from|fetch|url|open|Worker)\s*[=(]?\s*["'`]?\s*(https?:)?//[a-z0-9])re",
        std::regex::icase);
    std::smatch found;
    const std::string head = page.substr(0, page.find(" id=\"prt-data\""));
    const std::string tail = page.substr(page.rfind("id=\"prt-light-0\""));
    const std::string code = head + tail.substr(tail.find("</script>"));
    EXPECT_FALSE(std::regex_search(code, found, fetched)) << found.str();
    const std::regex linked(R"re(<(script|link|img|iframe)[^>]*\s(src|href)="?(?!data:|"))re");
    EXPECT_FALSE(std::regex_search(code, found, linked)) << found.str();
}

TEST_F(CliWeb, TheLogTellsTheSizeOfThePage) {
    const CommandResult result =
        run({"web", "stage.prt.glb", "-o", "page.html", "--light", "uniform:1"});
    EXPECT_NE(result.errors.find("1 light, 4 bands"), std::string::npos) << result.errors;
    EXPECT_NE(result.errors.find("page.html, "), std::string::npos) << result.errors;
    EXPECT_EQ(result.errors.find("prt compress"), std::string::npos) << result.errors;
    EXPECT_EQ(result.output, "");
}

TEST_F(CliWeb, OfALargePageItIsToldWhatMakesItSmaller) {
    GlbFile glb = splitGlb(readFile(file("stage.prt.glb"), 1 << 26));
    glb.json["asset"]["copyright"] = std::string(25'000'000, 'c');
    const std::vector<std::byte> bytes = joinGlb(glb);
    writeText(file("large.prt.glb"), {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    const CommandResult result =
        run({"web", "stage.prt.glb", "large.prt.glb", "-o", "page.html", "--light", "uniform:1"});
    for (const std::string words : {"large.prt.glb has 25", "prt compress", "page.html has 3"})
        EXPECT_NE(result.errors.find(words), std::string::npos) << result.errors;
    std::filesystem::remove(file("large.prt.glb"));
}

TEST_F(CliWeb, WrongInputIsOneSentence) {
    std::filesystem::remove(file("page.html"));
    const std::string whole = readText(file("stage.prt.glb"));
    std::string damaged = whole;
    damaged[damaged.size() - 9] ^= 1;
    writeText(file("damaged.prt.glb"), damaged);
    writeText(file("cut.prt.glb"), whole.substr(0, whole.size() / 2));
    const auto web = [](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "web");
        arguments.insert(arguments.end(), {"-o", "page.html"});
        return arguments;
    };
    expectRefused(web({}), kWrongUsage, {"ASSET"});
    expectRefused({"web", "stage.prt.glb"}, kWrongUsage, {"--output"});
    expectRefused(web({"lost.prt.glb"}), kDataAtFault, {"lost.prt.glb", "does not exist"});
    expectRefused(web({"damaged.prt.glb"}), kDataAtFault, {"damaged.prt.glb", "checksum"});
    expectRefused(web({"stage.prt.glb", "cut.prt.glb"}), kDataAtFault, {"cut.prt.glb"});
    expectRefused(web({"stage.glb"}), kDataAtFault, {"stage.glb", "prt bake"});
    expectRefused(web({"stage.prt.glb", "--light", "lost.exr"}), kDataAtFault, {"lost.exr"});
    expectRefused(web({"stage.prt.glb", "--light", "moon:1"}), kWrongUsage, {"moon:1"});
    expectRefused(web({"stage.prt.glb", "--camera", "front"}), kWrongUsage,
                  {"stage.prt.glb", "'front'"});
    expectRefused({"web", "stage.prt.glb", "-o", "page.htm"}, kWrongUsage, {"page.htm", ".html"});
    expectRefused({"web", "stage.prt.glb", "-o", "nowhere/page.html"}, kDataAtFault,
                  {"nowhere/page.html", "cannot be written"});
}

TEST_F(CliWeb, AnAssetIsNotOverwritten) {
    std::filesystem::copy_file(file("stage.prt.glb"), file("asset.html"));
    expectRefused({"web", "seen.prt.glb", "asset.html", "-o", "asset.html"}, kWrongUsage,
                  {"asset.html", "overwrite"});
    EXPECT_EQ(readText(file("asset.html")), readText(file("stage.prt.glb")));
}

TEST_F(CliWeb, AnAssetOfSeveralFilesIsRefused) {
    std::filesystem::remove(file("page.html"));
    GlbFile glb = splitGlb(readFile(file("stage.prt.glb"), 1 << 26));
    writeText(file("stage.bin"),
              {reinterpret_cast<const char*>(glb.binary.data()), glb.binary.size()});
    glb.json["buffers"][0]["uri"] = "stage.bin";
    writeText(file("text.gltf"), glb.json.dump());
    glb.binary.clear();
    const std::vector<std::byte> bytes = joinGlb(glb);
    writeText(file("apart.glb"), {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    for (const std::string name : {"text.gltf", "apart.glb"}) {
        expectRefused({"web", name, "-o", "page.html"}, kDataAtFault,
                      {name, "one file", "prt compress"});
        run({"compress", name, "-o", "one.prt.glb", "--method", "float"});
        makePage({"one.prt.glb", "--light", "uniform:1"});
        std::filesystem::remove(file("page.html"));
    }
}

TEST(CliWebWithoutNode, IsOneSentence) {
    const TemporaryFolder folder;
    const CommandResult result = runPrt(folder, {"web", "lost.prt.glb", "-o", "page.html"});
    EXPECT_EQ(result.exitCode, kDataAtFault);
    if (result.errors.find("lost.prt.glb") != std::string::npos)
        GTEST_SKIP() << "this prt was built with Node.js";
    for (const std::string words : {"Node.js", "nodejs", "npm ci --prefix web"})
        EXPECT_NE(result.errors.find(words), std::string::npos) << result.errors;
    EXPECT_EQ(folder.fileCount(), 0);
}

}  // namespace
}  // namespace prt::test
