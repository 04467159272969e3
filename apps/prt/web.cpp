#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "apps/common/light_argument.h"
#include "apps/common/text.h"
#include "apps/prt/arguments.h"
#include "apps/prt/asset_output.h"
#include "apps/prt/commands.h"
#include "apps/prt/interrupts.h"
#include "apps/prt/limits.h"
#include "apps/prt/page_data.h"
#include "apps/prt/page_template.h"
#include "apps/prt/prepared_asset.h"
#include "apps/prt/stage_log.h"
#include "apps/prt/view_options.h"
#include "prt/base/error.h"
#include "prt/base/file.h"

namespace prt::cli {
namespace {

namespace fs = std::filesystem;

struct WebArguments {
    std::vector<std::string> assets;
    std::vector<std::string> lights{"daylight:150,40", "sun:60,40,20", "uniform:1"};
    std::string output;
    ViewArguments view;  // of pictures as prt render makes them
    ReaderLimits limits;
};

// Browsers keep an element's text as one string, which Chromium ends at 512 MiB.
constexpr std::uintmax_t kMaxAssetBytes = 400'000'000;

// More than this takes long to fetch, and more memory than phones give a page.
constexpr std::uintmax_t kLargePageBytes = 32'000'000;

void checkArguments(const WebArguments& arguments) {
    requireSuffix(arguments.output, ".html");
    for (const std::string& asset : arguments.assets)
        refuseOverwriting(arguments.output, asset, "the asset it is made from",
                          "choose another name, such as scene.html");
    if (kPageTemplate.empty())
        throw Error(ErrorCode::unsupported,
                    "can make no page, for this prt was built without Node.js", "prt web",
                    "install nodejs and npm, run npm ci --prefix web in the folder of OpenPRT, "
                    "then configure and build prt again");
    const DeferInterrupts whileProbing;
    checkWritable(arguments.output);
}

/// Whether it is a binary glTF [glTF 2.0, 4.4] whose buffers and images are all its own.
bool isWhole(std::span<const std::byte> file) {
    constexpr std::string_view kMagic = "glTF";
    constexpr std::size_t kJsonBegin = 20, kJsonLength = 12;
    if (file.size() < kJsonBegin || std::memcmp(file.data(), kMagic.data(), kMagic.size()) != 0)
        return false;
    std::uint32_t byteCount = 0;
    std::memcpy(&byteCount, file.data() + kJsonLength, sizeof(byteCount));
    const auto text =
        file.subspan(kJsonBegin).first(std::min<std::size_t>(byteCount, file.size() - kJsonBegin));
    const auto* begin = reinterpret_cast<const char*>(text.data());
    const auto json = nlohmann::json::parse(begin, begin + text.size());
    for (const char* parts : {"buffers", "images"})
        for (const auto& part : json.value(parts, nlohmann::json::array()))
            if (!part.value("uri", "data:").starts_with("data:")) return false;
    return true;
}

/// "teapot" of scenes/teapot.prt.glb.
std::string nameAsset(const std::string& path) {
    const fs::path stem = fs::path(path).stem();
    return stem.extension() == ".prt" ? stem.stem().string() : stem.string();
}

struct LoadedAssets {
    std::vector<PageAsset> assets;
    int bandCount = 1;  // of the one with most
};

LoadedAssets loadAssets(const WebArguments& arguments, StageLog& log) {
    LoadedAssets loaded;
    for (const std::string& path : arguments.assets) {
        stopIfInterrupted();
        const Asset asset = readPreparedAsset(path, arguments.limits.images(), log);
        loaded.bandCount = std::max(loaded.bandCount, asset.transfer.bandCount);
        loaded.assets.push_back({.name = nameAsset(path),
                                 .camera = chooseCamera(arguments.view, asset.scene, path),
                                 .file = readFile(path, kMaxAssetBytes)});
        if (!isWhole(loaded.assets.back().file))
            throw Error(ErrorCode::unsupported,
                        "is not one file with all that belongs to it, as a page must hold it", path,
                        "prt compress writes such a file");
    }
    return loaded;
}

std::vector<PageLight> loadLights(const WebArguments& arguments, int bandCount, StageLog& log) {
    constexpr int kPictureHeight = 64;
    const Stopwatch watch;
    std::vector<PageLight> lights;
    for (const std::string& argument : arguments.lights) {
        stopIfInterrupted();
        const LightSource light = loadLight(argument, bandCount, {}, arguments.limits.images());
        if (const auto mending = describeMending(light.mended))
            log.warn(argument + ": " + *mending);
        lights.push_back(
            {.name = nameLight(argument),
             .lighting = light.lighting,
             .picture = drawLight(light, {}, SphereMap::latLong, kPictureHeight).radiance});
    }
    log.finishStage(
        "project", watch.seconds(),
        fmt::format("{}, {}", formatCount(static_cast<std::uint64_t>(lights.size()), "light"),
                    formatCount(static_cast<std::uint64_t>(bandCount), "band")));
    return lights;
}

template <class Entry>
void nameApart(std::vector<Entry>& entries) {
    std::vector<std::string> names;
    for (const Entry& entry : entries)
        names.push_back(entry.name);
    names = tellApart(std::move(names));
    for (std::size_t i = 0; i < entries.size(); ++i)
        entries[i].name = names[i];
}

/// What would make a large page smaller.
std::string describeLargePage(std::uintmax_t pageBytes, const WebArguments& arguments,
                              const std::vector<PageAsset>& assets) {
    const auto largest = std::ranges::max_element(
        assets, {}, [](const PageAsset& asset) { return asset.file.size(); });
    const std::string& path = arguments.assets[static_cast<std::size_t>(largest - assets.begin())];
    return fmt::format(
        "{} has {}, which is much for a phone; {} has {}, and prt compress makes it smaller",
        arguments.output, formatBytes(pageBytes), path, formatBytes(largest->file.size()));
}

void runWeb(const WebArguments& arguments) {
    checkArguments(arguments);
    stopIfInterrupted();

    StageLog log;
    auto [assets, bandCount] = loadAssets(arguments, log);
    std::vector<PageLight> lights = loadLights(arguments, bandCount, log);
    nameApart(assets);
    nameApart(lights);

    const DeferInterrupts whileWriting;
    const Stopwatch watch;
    const std::string page = fillPage(kPageTemplate, assets, lights);
    writeFileAtomically(arguments.output, page);
    log.finishStage("write", watch.seconds(),
                    fmt::format("{}, {}", arguments.output, formatBytes(page.size())));
    if (page.size() > kLargePageBytes) log.warn(describeLargePage(page.size(), arguments, assets));
}

constexpr const char* kFooter =
    R"(Examples: prt web statue.prt.glb -o statue.html
          prt web statue.prt.glb --light museum.exr --light sun:60,40,10 -o statue.html
          prt web statue.prt.glb statue-small.prt.glb --light museum.exr -o compare.html

A page is one file that any browser with WebGL 2 opens, from disk too: it needs no server and no network. In
it one orbits, turns the light, chooses light, bands, transport and exposure, and splits the picture in two,
by mouse or by touch; its address keeps the view, to be shared. Add ?benchmark to the address for frame times.

The page holds each asset as it is, in four thirds of its bytes: prt compress makes it small enough to send.
Of lights it holds coefficients, as many bands as the asset of most bands has, and a picture of 128x64 texels
to be seen behind the scene. Without --light they are daylight:150,40, sun:60,40,20 and uniform:1.

)";

}  // namespace

void addWebCommand(CLI::App& app) {
    const auto arguments = std::make_shared<WebArguments>();
    CLI::App* command = app.add_subcommand(
        "web", "Make a page in which anyone can turn the light: ASSET to OUT.html");
    command->footer(std::string(kFooter) + kLightHelp);
    command
        ->add_option("ASSET", arguments->assets,
                     "what prt bake wrote; several, to choose in the page")
        ->required();
    command->add_option("-o,--output", arguments->output, "the page to write")
        ->type_name("OUT.html")
        ->required();
    command
        ->add_option("--light", arguments->lights,
                     "a light of the page, as below; again for more [day, sun, white sky]")
        ->type_name("LIGHT");
    addCameraOptions(*command, arguments->view);
    addPixelLimit(*command, arguments->limits);
    command->callback([arguments] { runWeb(*arguments); });
}

}  // namespace prt::cli
