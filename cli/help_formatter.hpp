// What `--help` prints, in lines of at most 100 columns.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace courant::cli {

// The formatter of CLI11, whose long lines go on below: descriptions where descriptions begin, any other
// line six columns in. Lines end between words, or behind the | of a list of words.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;
};

}  // namespace courant::cli
