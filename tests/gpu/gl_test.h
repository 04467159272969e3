#pragma once

#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "prt/base/error.h"
#include "prt/gpu/gl_context.h"

namespace prt::test {

/// A test that draws; skipped where there is no EGL, and nowhere else.
class GlTest : public ::testing::Test {
  protected:
    void SetUp() override {
        try {
            context_.emplace();
        } catch (const Error& error) {
            if (std::string(error.what()).find("no EGL library") == std::string::npos) throw;
            GTEST_SKIP() << error.message();
        }
    }

    const GlContext& context() const { return *context_; }

  private:
    std::optional<GlContext> context_;
};

}  // namespace prt::test
