// Completion for shells: commands, options, words that an option knows, files and folders.
#pragma once

#include <string>

#include "courant/cli/synopsis.hpp"

namespace courant::cli {

// To be read by `source`, or installed as share/bash-completion/completions/courant. Needs bash 4.
std::string bash_completion(const Synopsis& synopsis);

// To be installed as `_courant` in a folder of $fpath, or read by `source` after compinit.
std::string zsh_completion(const Synopsis& synopsis);

}  // namespace courant::cli
