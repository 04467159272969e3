#include "apps/prt/arguments.h"

namespace prt::cli {

std::string describeCommand(const std::string& start, const CLI::App& command,
                            std::string_view outputOption) {
    std::string line = start;
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_lnames().empty() || option->get_lnames().front() == outputOption) continue;
        const bool isFlag = option->get_expected_min() == 0;
        for (const std::string& value : option->results())
            line += fmt::format(" --{}{}", option->get_lnames().front(), isFlag ? "" : " " + value);
    }
    return line;
}

}  // namespace prt::cli
