#include "apps/prt/asset_output.h"

#include <filesystem>
#include <system_error>

#include "apps/prt/arguments.h"
#include "apps/prt/interrupts.h"
#include "prt/base/error.h"
#include "prt/base/file.h"

namespace prt::cli {

void checkAssetOutput(const std::string& output, const std::string& source,
                      const std::string& sourceWords) {
    requireSuffix(output, ".glb");
    std::error_code ignored;
    if (std::filesystem::equivalent(source, output, ignored))
        throw Error(ErrorCode::invalidOption, "would overwrite " + sourceWords, output,
                    "choose another name, such as scene.prt.glb");
    const DeferInterrupts whileProbing;
    checkWritable(output);
}

}  // namespace prt::cli
