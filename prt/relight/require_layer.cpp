#include "prt/relight/require_layer.h"

#include <string>

#include "prt/base/error.h"

namespace prt {

const CompressedLayer& requireLayer(const CompressedTransfer& transfer, Transport transport) {
    if (const CompressedLayer* layer = transfer.findLayer(transport)) return *layer;
    std::string available;
    for (const CompressedLayer& layer : transfer.layers)
        available +=
            (available.empty() ? "it has " : ", ") + std::string(transportName(layer.transport));
    throw Error(ErrorCode::invalidOption,
                "the asset holds no " + std::string(transportName(transport)) + " transfer", {},
                available);
}

}  // namespace prt
