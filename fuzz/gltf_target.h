#pragma once

#include <utility>

#include "fuzz/fuzz_target.h"
#include "prt/gltf/gltf_document.h"

namespace prt::fuzz {

/// Everything that GltfDocument offers, for the bytes of a .gltf or .glb without neighbours.
inline int readGltfBytes(std::vector<std::byte> file) {
    return readSafely([&] {
        // What is counted but not there costs only time.
        const GltfDocument document(std::move(file), "/nonexistent",
                                    {.maxZeroElementCount = 10'000});
        demandPromises(document.flatten().scene);
        for (std::size_t i = 0; i < document.accessorCount(); ++i) {
            const AccessorInfo info = document.describeAccessor(i);
            const auto componentCount = static_cast<std::size_t>(info.componentCount);
            PRT_ASSERT(document.readFloats(i).size() == info.count * componentCount,
                       "an accessor has all of its numbers");
            document.readRaw(i);
        }
        for (std::size_t i = 0; i < document.bufferViewCount(); ++i)
            PRT_ASSERT(document.bufferViewBytes(i).empty() == document.storedViewBytes(i).empty(),
                       "what is stored is what is read, or encodes it");
    });
}

}  // namespace prt::fuzz
