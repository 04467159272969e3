#include "apps/prt/compress_method.h"

#include <array>
#include <optional>
#include <utility>

#include "apps/prt/arguments.h"

namespace prt::cli {
namespace {

constexpr std::array<std::pair<std::string_view, TransferEncoding>, 3> kMethods = {{
    {"float", TransferEncoding::float32},
    {"u16", TransferEncoding::unorm16},
    {"u8", TransferEncoding::unorm8},
}};

std::optional<TransferEncoding> parseMethod(std::string_view name) {
    for (const auto& [method, encoding] : kMethods)
        if (method == name) return encoding;
    return std::nullopt;
}

}  // namespace

CLI::Option* addMethodOption(CLI::App& command, TransferEncoding& encoding) {
    return addParsedOption(command, "--method", encoding, parseMethod, "float|u16|u8",
                           "how a coefficient is stored: 4, 2 or 1 bytes")
        ->default_str(std::string(methodName(encoding)));
}

std::string_view methodName(TransferEncoding encoding) {
    for (const auto& [method, known] : kMethods)
        if (known == encoding) return method;
    return encodingName(encoding);
}

}  // namespace prt::cli
