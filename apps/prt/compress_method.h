#pragma once

#include <string_view>

#include <CLI/CLI.hpp>

#include "prt/transfer/compressed_transfer.h"

namespace prt::cli {

/// Adds --method, which chooses how a coefficient is stored.
CLI::Option* addMethodOption(CLI::App& command, TransferEncoding& encoding);

/// As --method takes it.
std::string_view methodName(TransferEncoding encoding);

}  // namespace prt::cli
