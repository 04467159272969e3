#include "apps/prt/help_formatter.h"

namespace prt::cli {

HelpFormatter::HelpFormatter() {
    column_width(34);
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
    const std::string takes = option->get_type_size() == 0 ? "" : option->get_type_name();
    return takes.empty() || option->get_positional() ? "" : " " + takes;
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
    const std::string byDefault = option->get_default_str();
    return option->get_description() + (byDefault.empty() ? "" : " [" + byDefault + "]");
}

/// `prt bake SCENE -o OUT [OPTIONS]`: what must be given, by name.
std::string HelpFormatter::make_usage(const CLI::App* app, std::string name) const {
    std::string usage = "\nUsage: " + name;
    for (const CLI::Option* option : app->get_options()) {
        if (option->get_positional())
            usage += " " + make_option_usage(option);
        else if (option->get_required())
            usage += " " + option->get_name() + make_option_opts(option);
    }
    const bool hasSubcommands = app->get_require_subcommand_min() > 0;
    return usage + (hasSubcommands ? " COMMAND" : "") + " [OPTIONS]\n";
}

}  // namespace prt::cli
