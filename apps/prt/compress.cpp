#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/prt/arguments.h"
#include "apps/prt/asset_output.h"
#include "apps/prt/commands.h"
#include "apps/prt/compress_method.h"
#include "apps/prt/interrupts.h"
#include "apps/prt/stage_log.h"
#include "apps/prt/text.h"
#include "prt/asset/asset.h"
#include "prt/base/error.h"
#include "prt/compress/compress_transfer.h"
#include "prt/compress/compression_error.h"

namespace prt::cli {
namespace {

struct CompressArguments {
    std::string asset;
    std::string output;
    TransferEncoding encoding = TransferEncoding::unorm16;
    std::optional<Transport> transport;
};

/// Keeps one layer only.
void keepLayer(CompressedTransfer& transfer, Transport transport, const std::string& path) {
    if (!transfer.findLayer(transport))
        throw Error(ErrorCode::invalidOption,
                    fmt::format("was baked without {} transport", transportName(transport)), path);
    std::erase_if(transfer.layers,
                  [&](const CompressedLayer& layer) { return layer.transport != transport; });
}

void tellErrors(const CompressedTransfer& compressed, const CompressedTransfer& original,
                StageLog& log) {
    for (const CompressedLayer& layer : compressed.layers) {
        const CompressedLayer& before = *original.findLayer(layer.transport);
        const CompressionError error = measureCompressionError(layer, before);
        log.tell(fmt::format(
            "{}: {} a vertex instead of {}; error {:.2g} % of the transfer, at most {:.2g}",
            transportName(layer.transport), formatCount(bytesPerReceiver(layer), "byte"),
            bytesPerReceiver(before), 100.0 * error.relativeRmse, error.largest));
    }
}

void runCompress(const CompressArguments& arguments) {
    checkAssetOutput(arguments.output, arguments.asset, "the asset it is made from");
    stopIfInterrupted();
    StageLog log;
    const Stopwatch load;
    Asset asset = readAsset(arguments.asset);
    if (arguments.transport) keepLayer(asset.transfer, *arguments.transport, arguments.asset);
    log.finishStage("load", load.seconds(), arguments.asset);

    const Stopwatch compress;
    const CompressedTransfer compressed =
        compressTransfer(expandTransfer(asset.transfer), {.encoding = arguments.encoding});
    log.finishStage("compress", compress.seconds(),
                    fmt::format("{}, {}", methodName(arguments.encoding),
                                formatCount(asset.scene.vertexCount(), "vertex")));
    tellErrors(compressed, asset.transfer, log);
    asset.provenance.command +=
        fmt::format("; compress --method {}", methodName(arguments.encoding));

    const Stopwatch write;
    const DeferInterrupts whileWriting;
    writeAsset(arguments.output, asset.scene, compressed, asset.provenance);
    log.finishStage("write", write.seconds(),
                    fmt::format("{}, {}", arguments.output,
                                formatBytes(std::filesystem::file_size(arguments.output))));
}

constexpr const char* kFooter =
    R"(Example: prt compress statue.prt.glb -o statue-small.prt.glb --method u8 --transport interreflected

Each coefficient's range over all vertices is mapped to the integers. The errors that are told are those of
reading the new asset back, against the asset that was given.)";

}  // namespace

void addCompressCommand(CLI::App& app) {
    const auto arguments = std::make_shared<CompressArguments>();
    CLI::App* command =
        app.add_subcommand("compress", "Store a baked asset in fewer bytes: ASSET to OUT.prt.glb");
    command->footer(kFooter);
    command->add_option("ASSET", arguments->asset, "what prt bake wrote")->required();
    command->add_option("-o,--output", arguments->output, "the asset to write")
        ->type_name("OUT.prt.glb")
        ->required();
    addMethodOption(*command, arguments->encoding);
    addParsedOption(*command, "--transport", arguments->transport, parseTransport,
                    "unshadowed|shadowed|interreflected", "keep this kind alone [all there are]");
    command->callback([arguments] { runCompress(*arguments); });
}

}  // namespace prt::cli
