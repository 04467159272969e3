#pragma once

#include <string>

#include "apps/viewer/stage.h"
#include "prt/compress/compress_transfer.h"
#include "prt/transport/bake.h"
#include "tests/gpu/gl_test.h"
#include "tests/support/scenes.h"
#include "tests/support/temporary_folder.h"

namespace prt::test {

/// Assets and lights in a folder of their own, for stages to read.
class StageTest : public GlTest {
  protected:
    std::string pathOf(const std::string& name) const { return folder_.path() / name; }

    /// @return  its path
    std::string writeBaked(const std::string& name, const Scene& scene, const BakeOptions& bake,
                           TransferEncoding encoding = TransferEncoding::float32) const {
        Provenance provenance;
        provenance.bounceCount = bake.bounceCount;
        writeAsset(pathOf(name), scene, compressTransfer(bakeTransfer(scene, bake), {encoding}),
                   provenance);
        return pathOf(name);
    }

    /// No process of its own for each image: that would be most of a test's time.
    static constexpr ImageLimits kLimits{.inOwnProcess = false};

  private:
    const TemporaryFolder folder_;
};

}  // namespace prt::test
