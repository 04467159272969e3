#include "apps/prt/asset_output.h"

#include <filesystem>
#include <system_error>

#include "apps/prt/arguments.h"
#include "apps/prt/interrupts.h"
#include "prt/base/error.h"
#include "prt/base/file.h"

namespace prt::cli {

void refuseOverwriting(const std::string& output, const std::string& source,
                       const std::string& sourceWords, const std::string& hint) {
    std::error_code ignored;
    if (std::filesystem::equivalent(source, output, ignored))
        throw Error(ErrorCode::invalidOption, "would overwrite " + sourceWords, output, hint);
}

void checkAssetOutput(const std::string& output, const std::string& source,
                      const std::string& sourceWords) {
    requireSuffix(output, ".glb");
    refuseOverwriting(output, source, sourceWords, "choose another name, such as scene.prt.glb");
    const DeferInterrupts whileProbing;
    checkWritable(output);
}

}  // namespace prt::cli
