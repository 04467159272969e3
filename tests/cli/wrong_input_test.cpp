// Each wrong input gives one sentence that names the file and the cause, the right exit code, no
// output file and no crash (docs/architecture.md, errors).

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "prt/image/image.h"
#include "prt/io/image_io.h"
#include "tests/cli/gltf_text.h"
#include "tests/cli/run_prt.h"

namespace prt::test {
namespace {

constexpr int kDataAtFault = 1;
constexpr int kWrongUsage = 2;

/// Runs prt, which must fail with one line that holds all the words, and leave no
/// file but those that lay there.
void expectOneSentence(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                       int exitCode, const std::vector<std::string>& words) {
    const std::ptrdiff_t fileCount = folder.fileCount();
    const CommandResult result = runPrt(folder, arguments);
    EXPECT_EQ(result.exitCode, exitCode) << result.errors;
    EXPECT_EQ(result.signal, 0);
    EXPECT_EQ(result.output, "");

    std::string lastLine = result.errors;
    if (lastLine.ends_with('\n')) lastLine.pop_back();
    lastLine = lastLine.substr(lastLine.rfind('\n') + 1);
    EXPECT_TRUE(lastLine.starts_with("prt: error: ")) << result.errors;
    EXPECT_EQ(result.errors.find("prt: error: "), result.errors.rfind("prt: error: "))
        << result.errors;
    for (const std::string& word : words)
        EXPECT_NE(lastLine.find(word), std::string::npos) << word << " in " << lastLine;
    EXPECT_EQ(folder.fileCount(), fileCount) << "a file was left behind";
}

std::vector<std::string> bakeCommand(const std::string& scene) {
    return {"bake", scene,     "-o", "out.prt.glb", "--samples",
            "16",   "--bands", "2",  "--max-edge",  "none"};
}

/// A scene file that cannot be baked, and the words its error must hold.
struct BadScene {
    std::string name;
    std::string file;
    std::function<void(const TemporaryFolder&)> write;
    std::vector<std::string> words;
};

void PrintTo(const BadScene& scene, std::ostream* stream) {
    *stream << scene.name;
}

std::function<void(const TemporaryFolder&)> writing(const std::string& file,
                                                    const std::string& text) {
    return [file, text](const TemporaryFolder& folder) { writeText(folder.path() / file, text); };
}

void writeTruncatedGlb(const TemporaryFolder& folder) {
    ASSERT_EQ(runPrt(folder, {"scene", "box", "-o", "short.glb"}).exitCode, 0);
    const std::string whole = readText(folder.path() / "short.glb");
    writeText(folder.path() / "short.glb", whole.substr(0, whole.size() / 2));
}

std::vector<BadScene> badScenes() {
    const TriangleGltf indexBeyondTheEnd{.indices = "AAABAAcA"};  // 0 1 7
    const TriangleGltf notANumber{
        .positions = "AAAAAAAAAAAAAAAAAADAfwAAAAAAAAAAAAAAAAAAgD8AAAAA"};  // x of the second
    const TriangleGltf cycle{.nodes = R"([{"mesh": 0, "children": [1]}, {"children": [0]}])"};
    const TriangleGltf escape{.uri = "../../../etc/passwd"};
    const TriangleGltf lostBuffer{.uri = "lost.bin"};
    return {
        {"Missing", "a.glb", [](const TemporaryFolder&) {}, {"a.glb", "does not exist"}},
        {"Empty", "a.glb", writing("a.glb", ""), {"a.glb", "is empty"}},
        {"NotAGltf", "a.gltf", writing("a.gltf", "Dear diary, this is no scene."), {"a.gltf"}},
        {"UnknownSuffix", "a.blend", writing("a.blend", "BLENDER"), {"a.blend"}},
        {"TruncatedGlb", "short.glb", writeTruncatedGlb, {"short.glb"}},
        {"IndexOutOfRange", "a.gltf", writing("a.gltf", indexBeyondTheEnd.text()), {"a.gltf", "7"}},
        {"PositionNotANumber",
         "a.gltf",
         writing("a.gltf", notANumber.text()),
         {"a.gltf", "finite"}},
        {"CyclicNodes", "a.gltf", writing("a.gltf", cycle.text()), {"a.gltf", "node"}},
        {"UriLeavesTheFolder", "a.gltf", writing("a.gltf", escape.text()), {"a.gltf", "folder"}},
        {"BufferFileMissing",
         "a.gltf",
         writing("a.gltf", lostBuffer.text()),
         {"lost.bin", "does not exist"}},
    };
}

class BadSceneTest : public testing::TestWithParam<BadScene> {};

TEST_P(BadSceneTest, IsRefusedInOneSentence) {
    const TemporaryFolder folder;
    GetParam().write(folder);
    expectOneSentence(folder, bakeCommand(GetParam().file), kDataAtFault, GetParam().words);
}

INSTANTIATE_TEST_SUITE_P(Cli, BadSceneTest, testing::ValuesIn(badScenes()),
                         [](const auto& parameter) { return parameter.param.name; });

TEST(CliTriangle, TheSceneThatTheBadOnesAreMadeFromIsGood) {
    const TemporaryFolder folder;
    writeText(folder.path() / "a.gltf", TriangleGltf().text());
    const CommandResult result = runPrt(folder, bakeCommand("a.gltf"));
    EXPECT_EQ(result.exitCode, 0) << result.errors;
}

/// An EXR file of 8 × 4 pixels whose header claims 32768 × 32768.
void writeExrThatClaimsABillionPixels(const std::filesystem::path& path) {
    writeExr(path, Image(8, 4, Vec3f(1.0f)));
    std::string bytes = readText(path);
    const std::int32_t window[4] = {0, 0, 32767, 32767};
    for (const std::string attribute : {"dataWindow", "displayWindow"}) {
        const std::string head = attribute + '\0' + "box2i" + '\0';
        const std::size_t place = bytes.find(head);
        ASSERT_NE(place, std::string::npos);
        std::memcpy(bytes.data() + place + head.size() + sizeof(std::int32_t), window,
                    sizeof window);
    }
    writeText(path, bytes);
}

TEST(CliWrongLight, AnExrHeaderThatClaimsABillionPixelsIsRefused) {
    const TemporaryFolder folder;
    writeExrThatClaimsABillionPixels(folder.path() / "huge.exr");
    expectOneSentence(folder, {"light", "huge.exr"}, kDataAtFault, {"huge.exr", "32768"});
}

TEST(CliLimits, PixelsBeyondTheLimitAreRefusedAndTheLimitCanBeMoved) {
    const TemporaryFolder folder;
    writeExr(folder.path() / "sky.exr", Image(8, 4, Vec3f(1.0f)));
    expectOneSentence(folder, {"light", "sky.exr", "--max-pixels", "7"}, kDataAtFault,
                      {"sky.exr", "8 × 4", "limit of 7 × 7", "--max-pixels"});
    EXPECT_EQ(runPrt(folder, {"light", "sky.exr", "--max-pixels", "8"}).exitCode, 0);
    expectOneSentence(folder, {"light", "sky.exr", "--max-pixels", "0"}, kWrongUsage,
                      {"--max-pixels"});
}

TEST(CliLimits, VerticesBeyondTheLimitAreRefusedAndTheLimitCanBeMoved) {
    const TemporaryFolder folder;
    writeText(folder.path() / "a.gltf", TriangleGltf().text());
    std::vector<std::string> command = bakeCommand("a.gltf");
    command.insert(command.end(), {"--max-vertices", "2"});
    expectOneSentence(folder, command, kDataAtFault, {"a.gltf", "limit of 2", "--max-vertices"});
    command.back() = "3";
    EXPECT_EQ(runPrt(folder, command).exitCode, 0);
}

TEST(CliWrongLight, AnUnreadableImageIsRefused) {
    const TemporaryFolder folder;
    writeText(folder.path() / "sky.png", "not a picture");
    expectOneSentence(folder, {"light", "sky.png"}, kDataAtFault, {"sky.png"});
    expectOneSentence(folder, {"light", "lost.hdr"}, kDataAtFault, {"lost.hdr", "does not exist"});
}

TEST(CliWrongLight, MalformedLightsAreWrongUsage) {
    const TemporaryFolder folder;
    for (const std::string light : {"uniform:1,2", "uniform:", "uniform:nan", "uniform:1,-1,1",
                                    "sun:0,0", "sun:0,91,1", "sun:0,0,-1", "moon:1"})
        expectOneSentence(folder, {"light", light}, kWrongUsage, {light});
}

TEST(CliWrongBrdf, MalformedOnesAreWrongUsage) {
    const TemporaryFolder folder;
    for (const std::string spec :
         {"lambert:1,1", "lambert:1,1,2", "ggx:1,1,1", "ggx:1,1,1,1.5", "phong:1,1,1,-1",
          "phong:1,1,1,1e9", "gltf:1,1,1,nan,1", "steel", "lambert:1,1,1,", "floor=lambert:1,1,1"})
        expectOneSentence(folder, {"brdf", spec}, kWrongUsage, {spec, "prt brdf --help"});
    expectOneSentence(folder, {"brdf", "lambert:1,1,1", "--picture", "lobe.jpg"}, kWrongUsage,
                      {"lobe.jpg", ".png"});
    expectOneSentence(folder, {"brdf", "lambert:1,1,1", "--bands", "11"}, kWrongUsage, {"--bands"});
}

TEST(CliWrongBrdf, MaterialsThatAreNotThereOrGivenTwiceAreWrongUsage) {
    const TemporaryFolder folder;
    ASSERT_EQ(runPrt(folder, {"scene", "cornell", "-o", "a.glb"}).exitCode, 0);
    const auto refuse = [&](const std::vector<std::string>& specs,
                            const std::vector<std::string>& words) {
        std::vector<std::string> command = bakeCommand("a.glb");
        command.insert(command.end(), {"--transport", "glossy"});
        for (const std::string& spec : specs)
            command.insert(command.end(), {"--brdf", spec});
        expectOneSentence(folder, command, kWrongUsage, words);
    };
    refuse({"blue=lambert:1,1,1"}, {"a.glb", "'blue'", "green, red, white"});
    refuse({"lambert:1,1,1", "ggx:1,1,1,1"}, {"--brdf", "twice for all materials"});
    refuse({"red=lambert:1,1,1", "lambert:1,1,1", "red=ggx:1,1,1,1"}, {"--brdf", "twice", "'red'"});
    refuse({"red=lambert:1,1,2"}, {"lambert:1,1,2", "from 0 to 1"});
}

TEST(CliWrongBrdf, MeasuredFilesOfAnotherSizeAreRefused) {
    const TemporaryFolder folder;
    expectOneSentence(folder, {"brdf", "merl:lost.binary"}, kDataAtFault,
                      {"lost.binary", "does not exist"});
    std::string file("\x5a\0\0\0\x5a\0\0\0\xb4\0\0\0", 12);  // 90, 90, 180
    file.resize(10'000);
    writeText(folder.path() / "short.binary", file);
    expectOneSentence(folder, {"brdf", "merl:short.binary"}, kDataAtFault,
                      {"short.binary", "34992012"});
}

TEST(CliWrongLight, MalformedCoefficientsAreRefused) {
    const TemporaryFolder folder;
    writeText(folder.path() / "a.json",
              R"({"bands": 2, "convention": "cs", "coefficients": [[1, 1, 1]]})");
    expectOneSentence(folder, {"light", "a.json"}, kDataAtFault, {"a.json"});
}

TEST(CliWrongLight, ALayoutForALightThatIsNoImageIsWrongUsage) {
    const TemporaryFolder folder;
    expectOneSentence(folder, {"light", "uniform:1", "--map", "lat-long"}, kWrongUsage,
                      {"uniform:1", "--map"});
}

class WrongOutput : public testing::Test {
  protected:
    void SetUp() override { writeText(folder.path() / "a.gltf", TriangleGltf().text()); }

    std::vector<std::string> bakeTo(const std::string& output) const {
        return {"bake", "a.gltf", "-o", output, "--samples", "16", "--bands", "2"};
    }

    TemporaryFolder folder;
};

TEST_F(WrongOutput, AMissingFolderIsNoticedBeforeTheWork) {
    expectOneSentence(folder, bakeTo("nowhere/out.prt.glb"), kDataAtFault,
                      {"nowhere/out.prt.glb", "cannot be written"});
    expectOneSentence(folder, bakeTo("a.gltf/out.prt.glb"), kDataAtFault,
                      {"a.gltf/out.prt.glb", "cannot be written"});
}

TEST_F(WrongOutput, AReadOnlyFolderIsNoticedBeforeTheWork) {
    if (::geteuid() == 0) GTEST_SKIP() << "nothing is read-only to root";
    std::filesystem::permissions(
        folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    expectOneSentence(folder, bakeTo("out.prt.glb"), kDataAtFault,
                      {"out.prt.glb", "cannot be written"});
    std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
}

TEST_F(WrongOutput, AFullDiskLeavesNoFile) {
    constexpr rlim_t kFewBytes = 1000;
    for (const std::vector<std::string>& arguments :
         {bakeTo("out.prt.glb"),
          {"scene", "teapot", "-o", "out.glb"},
          {"light", "uniform:1", "--reconstruct", "out.exr"}}) {
        const CommandResult result = PrtProcess(folder, arguments, kFewBytes).wait();
        EXPECT_EQ(result.exitCode, kDataAtFault) << result.errors;
        EXPECT_NE(result.errors.find("prt: error: out."), std::string::npos) << result.errors;
        EXPECT_EQ(folder.fileCount(), 1) << arguments.front();
    }
}

TEST_F(WrongOutput, TheSceneIsNotOverwritten) {
    ASSERT_EQ(runPrt(folder, {"scene", "box", "-o", "box.glb"}).exitCode, 0);
    expectOneSentence(folder, {"bake", "box.glb", "-o", "./box.glb"}, kWrongUsage,
                      {"box.glb", "overwrite"});
}

TEST_F(WrongOutput, AnotherFormatThanTheSuffixSaysIsNotWritten) {
    expectOneSentence(folder, bakeTo("out.obj"), kWrongUsage, {"out.obj", ".glb"});
    expectOneSentence(folder, {"scene", "box", "-o", "out.gltf"}, kWrongUsage,
                      {"out.gltf", ".glb"});
    expectOneSentence(folder, {"render", "x.prt.glb", "--light", "uniform:1", "-o", "out.jpg"},
                      kWrongUsage, {"out.jpg"});
}

TEST_F(WrongOutput, AnAssetOfAnotherVersionIsRefused) {
    ASSERT_EQ(runPrt(folder, bakeTo("out.prt.glb")).exitCode, 0);
    std::string bytes = readText(folder.path() / "out.prt.glb");
    const std::size_t place = bytes.find(R"("version":"1.2")");
    ASSERT_NE(place, std::string::npos);
    bytes.replace(place, 15, R"("version":"9.0")");
    writeText(folder.path() / "out.prt.glb", bytes);
    for (const std::string command : {"info", "check"})
        expectOneSentence(folder, {command, "out.prt.glb"}, kDataAtFault,
                          {"out.prt.glb", "version", "9.0"});
    expectOneSentence(folder, {"render", "out.prt.glb", "--light", "uniform:1", "-o", "out.png"},
                      kDataAtFault, {"out.prt.glb", "version", "9.0"});
}

TEST_F(WrongOutput, AChangedByteIsFoundByCheck) {
    ASSERT_EQ(runPrt(folder, bakeTo("out.prt.glb")).exitCode, 0);
    std::string bytes = readText(folder.path() / "out.prt.glb");
    bytes[bytes.size() - 8] = static_cast<char>(bytes[bytes.size() - 8] ^ 1);
    writeText(folder.path() / "out.prt.glb", bytes);
    expectOneSentence(folder, {"check", "out.prt.glb"}, kDataAtFault, {"out.prt.glb"});
}

TEST_F(WrongOutput, APlainSceneIsNoAsset) {
    ASSERT_EQ(runPrt(folder, {"scene", "box", "-o", "box.glb"}).exitCode, 0);
    expectOneSentence(folder, {"info", "box.glb"}, kDataAtFault, {"box.glb"});
}

TEST_F(WrongOutput, OptionsOutOfRangeAreWrongUsage) {
    const std::vector<std::vector<std::string>> wrong = {
        {"--bands", "0"},    {"--bands", "99"},    {"--samples", "-5"}, {"--samples", "1e9"},
        {"--bounces", "-1"}, {"--bounces", "1.5"}, {"--method", "zip"}, {"--memory", "lots"},
        {"--memory", "0"},   {"--threads", "-1"},  {"--max-edge", "0"}, {"--transport", "all"},
        {"--isa", "z80"},    {"--seed", "-1"},     {"--frobnicate"},
    };
    for (const std::vector<std::string>& options : wrong) {
        std::vector<std::string> arguments = {"bake", "a.gltf", "-o", "out.prt.glb"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        expectOneSentence(folder, arguments, kWrongUsage, {options.front()});
    }
}

TEST_F(WrongOutput, BouncesWithoutInterreflectionAreWrongUsage) {
    expectOneSentence(
        folder,
        {"bake", "a.gltf", "-o", "out.prt.glb", "--transport", "shadowed", "--bounces", "2"},
        kWrongUsage, {"--bounces", "interreflected"});
}

TEST_F(WrongOutput, ALayerThatWasNotBakedIsNamed) {
    std::vector<std::string> arguments = bakeTo("out.prt.glb");
    arguments.insert(arguments.end(), {"--transport", "shadowed"});
    ASSERT_EQ(runPrt(folder, arguments).exitCode, 0);
    expectOneSentence(folder,
                      {"render", "out.prt.glb", "--light", "uniform:1", "-o", "out.png",
                       "--transport", "interreflected"},
                      kWrongUsage, {"out.prt.glb", "without interreflected transport"});
}

TEST(CliUsage, UnknownCommandsAndMissingArgumentsAreWrongUsage) {
    const TemporaryFolder folder;
    expectOneSentence(folder, {}, kWrongUsage, {"prt --help"});
    expectOneSentence(folder, {"frobnicate"}, kWrongUsage, {"frobnicate"});
    expectOneSentence(folder, {"bake"}, kWrongUsage, {"SCENE"});
    expectOneSentence(folder, {"bake", "a.glb"}, kWrongUsage, {"--output"});
    expectOneSentence(folder, {"scene", "no-such-scene", "-o", "a.glb"}, kWrongUsage,
                      {"no-such-scene"});
}

}  // namespace
}  // namespace prt::test
