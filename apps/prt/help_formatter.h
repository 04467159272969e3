#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace prt::cli {

/// Lays out --help: what an option takes beside its name, its default at the end of the sentence.
class HelpFormatter : public CLI::Formatter {
  public:
    HelpFormatter();

    std::string make_option_opts(const CLI::Option* option) const override;
    std::string make_option_desc(const CLI::Option* option) const override;
    std::string make_usage(const CLI::App* app, std::string name) const override;
};

}  // namespace prt::cli
