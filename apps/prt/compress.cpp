#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/common/light_argument.h"
#include "apps/common/text.h"
#include "apps/prt/arguments.h"
#include "apps/prt/asset_output.h"
#include "apps/prt/commands.h"
#include "apps/prt/compress_method.h"
#include "apps/prt/compress_report.h"
#include "apps/prt/interrupts.h"
#include "apps/prt/limits.h"
#include "apps/prt/stage_log.h"
#include "apps/prt/staged_folder.h"
#include "apps/prt/texture_output.h"
#include "prt/asset/asset.h"
#include "prt/base/error.h"
#include "prt/compress/compress_transfer.h"
#include "prt/gltf/vertex_order.h"

namespace prt::cli {
namespace {

struct CompressArguments {
    std::string asset;
    std::string output;
    MethodArguments method{.byDefault = "u16"};
    std::optional<Transport> transport;
    bool meshopt = false;
    std::uint64_t seed = 1;
    int threadCount = 0;
    ReaderLimits limits;
    CompressReportArguments report;
    std::string textures{};  ///< a folder; empty: none
    std::string command;     ///< as it was given
};

constexpr const char* kReportLight = "daylight:60,40";

/// Keeps one layer only.
void keepLayer(CompressedTransfer& transfer, Transport transport, const std::string& path) {
    if (!transfer.findLayer(transport))
        throw Error(ErrorCode::invalidOption,
                    fmt::format("was baked without {} transport", transportName(transport)), path);
    std::erase_if(transfer.layers,
                  [&](const CompressedLayer& layer) { return layer.transport != transport; });
}

/// Compresses layer after layer, and keeps of each no more than is still needed.
CompressedTransfer compressAsset(const CompressedTransfer& original,
                                 const CompressArguments& arguments, const CompressOptions& options,
                                 const std::vector<Vec3d>& light, StageLog& log) {
    CompressedTransfer compressed{
        original.bandCount, original.receiverCount, original.receiverOfVertex, {}};
    for (const CompressedLayer& before : original.layers) {
        const TransferLayer layer = {
            before.transport, before.channelCount,
            makeTable(coefficientsPerReceiver(original.bandCount, before), expandLayer(before)),
            before.incidentBandCount};
        compressed.layers.push_back(compressLayer(layer, original.bandCount, options));
        compressed.layers.back().largestError += before.largestError;
        tellCompression(compressed.layers.back(), layer, bytesPerReceiver(before), arguments.method,
                        light, log);
    }
    return compressed;
}

CompressedTransfer takeLayer(const CompressedTransfer& transfer, Transport transport) {
    return {transfer.bandCount,
            transfer.receiverCount,
            transfer.receiverOfVertex,
            {*transfer.findLayer(transport)}};
}

/// The fullest of the layers of vectors, for what matrices have no use for.
///
/// @throws Error  invalidOption where there are matrices alone
Transport fullestVectors(const CompressedTransfer& transfer, const std::string& option,
                         const std::string& path) {
    std::optional<Transport> fullest;
    for (const CompressedLayer& layer : transfer.layers)
        if (!isGlossy(layer.transport)) fullest = layer.transport;
    if (!fullest)
        throw Error(ErrorCode::invalidOption, "has only matrices, and " + option + " needs vectors",
                    path, "leave it out, or keep a kind that is not glossy");
    return *fullest;
}

/// Fills a folder that appears whole or not at all, and tells where it is.
template <class Fill>
void writeFolder(const std::string& name, const std::string& firstFile, StageLog& log, Fill fill) {
    const DeferInterrupts whileWriting;
    StagedFolder folder(name);
    fill(folder.path());
    stopIfInterrupted();
    folder.commit();
    log.tell("see " + (std::filesystem::path(name) / firstFile).string());
}

/// Reports on the fullest of the layers of vectors.
void makeReport(const CompressArguments& arguments, Asset original,
                const CompressedTransfer& compressed, const CompressOptions& options,
                StageLog& log) {
    const CompressReportArguments& asked = arguments.report;
    const ImageLimits limits = arguments.limits.images();
    const LightSource light = loadLight(asked.light, original.transfer.bandCount, {}, limits);
    const Transport fullest = fullestVectors(compressed, "--report", arguments.asset);
    original.transfer = takeLayer(original.transfer, fullest);
    decodeTextures(original.scene, limits);
    CompressReport report = examineCompression(original, takeLayer(compressed, fullest), options,
                                               light.lighting, asked.view, log);
    report.asset = arguments.output;
    report.source = arguments.asset;
    report.command = arguments.command;
    report.lightName = asked.light;
    writeFolder(asked.folder, "index.html", log,
                [&](const std::filesystem::path& folder) { writeCompressReport(folder, report); });
}

void checkOutputs(const CompressArguments& arguments) {
    checkAssetOutput(arguments.output, arguments.asset, "the asset it is made from");
    const DeferInterrupts whileProbing;
    for (const std::string& folder : {arguments.report.folder, arguments.textures})
        if (!folder.empty()) StagedFolder::check(folder);
}

void writeCompressed(const CompressArguments& arguments, const Asset& asset,
                     const CompressedTransfer& compressed, StageLog& log) {
    const Stopwatch write;
    const DeferInterrupts whileWriting;
    if (arguments.meshopt) {
        Scene scene = asset.scene;
        CompressedTransfer ordered = compressed;
        orderForEncoding(scene, ordered.receiverOfVertex);
        writeAsset(arguments.output, scene, ordered, asset.provenance, {.meshopt = true});
    } else {
        writeAsset(arguments.output, asset.scene, compressed, asset.provenance);
    }
    log.finishStage("write", write.seconds(),
                    fmt::format("{}, {}", arguments.output,
                                formatBytes(std::filesystem::file_size(arguments.output))));
}

void runCompress(const CompressArguments& arguments) {
    CompressOptions options = makeCompressOptions(arguments.method, arguments.seed);
    checkOutputs(arguments);
    stopIfInterrupted();
    StageLog log;
    const Stopwatch load;
    Asset asset = readAsset(arguments.asset);
    if (arguments.transport) keepLayer(asset.transfer, *arguments.transport, arguments.asset);
    const std::vector<Vec3d> light =
        loadErrorLight(arguments.method, asset.transfer.bandCount, arguments.limits);
    log.finishStage("load", load.seconds(), arguments.asset);
    if (!arguments.report.folder.empty())
        fullestVectors(asset.transfer, "--report", arguments.asset);
    if (!arguments.textures.empty()) {
        fullestVectors(asset.transfer, "--textures", arguments.asset);
        checkFillsTextures(asset.transfer, arguments.asset);
    }

    const Stopwatch compress;
    if (options.clusters) options.clusters->light = light;
    options.threadCount = arguments.threadCount;
    options.progress = log.callback();
    const CompressedTransfer compressed =
        compressAsset(asset.transfer, arguments, options, light, log);
    log.finishStage("compress", compress.seconds(),
                    fmt::format("{}, {}", methodName(arguments.method),
                                formatCount(asset.scene.vertexCount(), "vertex")));
    asset.provenance.command += "; compress " + describeMethod(arguments.method);
    if (options.clusters) asset.provenance.command += fmt::format(" --seed {}", arguments.seed);

    writeCompressed(arguments, asset, compressed, log);
    if (!arguments.textures.empty())
        writeFolder(
            arguments.textures, "textures.json", log, [&](const std::filesystem::path& folder) {
                writeTransferTextures(
                    folder, takeLayer(asset.transfer, fullestVectors(asset.transfer, "--textures",
                                                                     arguments.asset)));
            });
    if (!arguments.report.folder.empty())
        makeReport(arguments, std::move(asset), compressed, options, log);
}

constexpr const char* kFooter =
    R"(Examples: prt compress statue.prt.glb -o small.prt.glb --method cpca --weigh-by museum.exr
          prt compress statue.prt.glb -o small.prt.glb --bytes-per-vertex 16 --transport interreflected
          prt compress statue.prt.glb -o small.prt.glb --method cpca --report report --light museum.exr

)";

constexpr const char* kErrorHelp = R"(

The errors that are told are those of reading the new asset back, against the asset that was given: the
root mean square over all coefficients, as a part of the transfer's; and with --weigh-by that of the radiance
under the light turned at random, as a part of the mean radiance: of what leaves a white surface, and of what
comes in where the transport is glossy.

Of --textures, number s of a vertex's channel is bias + scale * q/255, q the byte s mod 4 of that channel's
texture s div 4, neither sRGB nor premultiplied; vertex v, counted mesh after mesh, is texel (v mod width,
v div width). Of 5 bands 24 coefficients are kept in six textures, and the mean of the 25th; textures.json
has all that a reader needs.

)";

}  // namespace

void addCompressCommand(CLI::App& app) {
    const auto arguments = std::make_shared<CompressArguments>();
    CLI::App* command =
        app.add_subcommand("compress", "Store a baked asset in fewer bytes: ASSET to OUT.prt.glb");
    command->footer(std::string(kFooter) + kMethodHelp + kErrorHelp + kLightHelp);
    command->add_option("ASSET", arguments->asset, "what prt bake wrote")->required();
    command->add_option("-o,--output", arguments->output, "the asset to write")
        ->type_name("OUT.prt.glb")
        ->required();
    addMethodOptions(*command, arguments->method);
    addParsedOption(*command, "--transport", arguments->transport, parseTransport, "KIND",
                    "unshadowed, shadowed, interreflected, glossy-shadowed or glossy: keep this\n"
                    "kind alone [all there are]");
    CLI::Option* textures =
        command
            ->add_option(
                "--textures", arguments->textures,
                "also write the fullest kind of vectors as PNGs of 8 bits, a texel a vertex")
            ->type_name("DIR");
    command
        ->add_flag("--meshopt", arguments->meshopt,
                   "encode vertices and triangles too, without loss, and order them for\n"
                   "that: for readers that know EXT_meshopt_compression")
        ->excludes(textures);
    addParsedOption(*command, "--seed", arguments->seed, parseWholeNumber, "N", "of the clusters")
        ->default_str("1");
    addIntegerOption(*command, "--threads", arguments->threadCount, 0, 4096, "0 for one a core");
    addPixelLimit(*command, arguments->limits);
    CLI::Option* report =
        command
            ->add_option(
                "--report", arguments->report.folder,
                "also make a folder with a page: every method, what it costs, where it errs")
            ->type_name("REPORT_DIR");
    command
        ->add_option(
            "--light", arguments->report.light,
            "the light of the report [that of --weigh-by, or " + std::string(kReportLight) + "]")
        ->type_name("LIGHT")
        ->needs(report);
    addViewOptions(*command, arguments->report.view);
    command->callback([arguments, command] {
        if (arguments->report.light.empty())
            arguments->report.light =
                arguments->method.light.empty() ? kReportLight : arguments->method.light;
        arguments->command =
            describeCommand("prt compress " + arguments->asset, *command, "output");
        runCompress(*arguments);
    });
}

}  // namespace prt::cli
