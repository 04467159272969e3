// Bakes a scene made by code into the asset named on the command line.
#include <cstdio>

#include "prt/asset/asset.h"
#include "prt/base/error.h"
#include "prt/compress/compress_transfer.h"
#include "prt/scene/procedural.h"
#include "prt/transport/bake.h"

int main(int argumentCount, char** arguments) {
    if (argumentCount != 2) return 2;
    try {
        const prt::Scene scene = prt::makeProceduralScene("sphere-over-plane");
        const prt::TransferField transfer =
            prt::bakeTransfer(scene, {.bandCount = 3, .sampleCount = 64});
        prt::writeAsset(arguments[1], scene, prt::compressTransfer(transfer),
                        {.generator = "outside"});
        return 0;
    } catch (const prt::Error& error) {
        std::fprintf(stderr, "%s\n", error.message().c_str());
        return 1;
    }
}
