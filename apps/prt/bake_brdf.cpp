#include "apps/prt/bake_brdf.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "apps/prt/brdf_argument.h"
#include "prt/base/fingerprint.h"
#include "prt/brdf/gltf_view_table.h"

namespace prt::cli {
namespace {

using BrdfTables = std::vector<std::shared_ptr<const BrdfViewTable>>;

std::string fingerprintTables(const BrdfTables& tables) {
    Fingerprint fingerprint;
    for (const auto& table : tables) {
        fingerprint.add(table != nullptr);
        if (!table) continue;
        for (std::size_t view = 0; view < table->viewCount(); ++view)
            fingerprint.add(std::as_bytes(table->row(view)));
    }
    return fingerprint.hex();
}

/// Without the folder of a file.
std::string withoutFolder(const std::string& text) {
    constexpr std::string_view kFilePrefix = "merl:";
    const std::size_t prefix = text.rfind(kFilePrefix);
    const std::size_t slash = text.rfind('/');
    if (prefix == std::string::npos || slash == std::string::npos || slash < prefix) return text;
    return text.substr(0, prefix + kFilePrefix.size()) + text.substr(slash + 1);
}

}  // namespace

BakeReflection makeBakeReflection(const Scene& scene, const BakeArguments& arguments) {
    if (arguments.brdfs.empty()) return {};
    const GivenBrdfs brdfs = resolveBrdfs(scene, arguments.brdfs, arguments.scene);
    const int bandCount = arguments.bake.incidentBandCount;
    BrdfTables tables = makeViewTables(brdfs, bandCount);
    std::string setting = describeBrdfs(arguments).substr(1) + " " + fingerprintTables(tables);
    // Names of materials may be of any letters, a manifest may not.
    std::replace_if(
        setting.begin(), setting.end(), [](char letter) { return letter < ' ' || letter > '~'; },
        '?');

    const bool allAreGiven = std::find(tables.begin(), tables.end(), nullptr) == tables.end();
    std::shared_ptr<const GltfViewTable> gltf;
    if (!allAreGiven)
        gltf = std::make_shared<GltfViewTable>(GltfViewTableOptions{.bandCount = bandCount});
    return {brdfReflection(scene, std::move(tables), std::move(gltf)), std::move(setting)};
}

std::string describeBrdfs(const BakeArguments& arguments) {
    std::string text;
    for (const std::string& brdf : arguments.brdfTexts)
        text += " --brdf " + withoutFolder(brdf);
    return text;
}

}  // namespace prt::cli
