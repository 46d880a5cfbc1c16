#include "courant/cli/backend.hpp"

#include <CLI/CLI.hpp>
#include <map>
#include <string>

namespace courant::cli {

void add_backend(CLI::App& command, Backend::Kind& backend) {
  command
      .add_option(
          "--backend", backend,
          "what evaluates formulas: native code, made by a C compiler; the interpreter, slower "
          "and without a compiler; or auto, native where it is worth while")
      ->transform(CLI::CheckedTransformer(std::map<std::string, Backend::Kind>{
                                              {"auto", Backend::Kind::automatic},
                                              {"native", Backend::Kind::native},
                                              {"interpreter", Backend::Kind::interpreter}})
                      .description(""))
      ->type_name("auto|native|interpreter");
}

}  // namespace courant::cli
