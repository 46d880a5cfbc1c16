#include "courant/cli/backend.hpp"

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "courant/core/words/spelling.hpp"
#include "courant/core/words/word_list.hpp"

namespace courant::cli {

void add_backend(CLI::App& command, Backend::Kind& backend) {
  static const std::map<std::string, Backend::Kind> kinds = {
      {"auto", Backend::Kind::automatic},
      {"native", Backend::Kind::native},
      {"interpreter", Backend::Kind::interpreter}};
  command
      .add_option_function<std::string>(
          "--backend",
          [&backend](const std::string& word) {
            if (const auto found = kinds.find(word); found != kinds.end()) {
              backend = found->second;
              return;
            }
            std::vector<std::string> words;
            for (const auto& [known, kind] : kinds) words.push_back(known);
            throw CLI::ValidationError("--backend", "is \"" + word + "\"" +
                                                        did_you_mean(word, words) +
                                                        "; expected one of: " + word_list(words));
          },
          "what evaluates formulas: native code, made by a C compiler; the interpreter, slower "
          "and without a compiler; or auto, native where it is worth while")
      ->type_name("auto|native|interpreter");
}

}  // namespace courant::cli
