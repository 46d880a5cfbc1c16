#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "courant/cli/command.hpp"
#include "courant/cli/completion_script.hpp"

namespace courant::cli {

void add_completion(CLI::App& app, Session& session) {
  auto shell = std::make_shared<std::string>();
  CLI::App* completion =
      app.add_subcommand("completion", "Print what a shell needs to complete command lines");
  completion
      ->add_option("SHELL", *shell, "for source <(courant completion bash), or to be installed")
      ->check(CLI::IsMember({"bash", "zsh"}).description(""))
      ->type_name("bash|zsh")
      ->required();
  completion->callback([&app, &session, shell] {
    session.action = [&app, shell](const Console& console) -> int {
      const Synopsis all = synopsis(app);
      console.out << (*shell == "bash" ? bash_completion(all) : zsh_completion(all));
      return done;
    };
  });
}

}  // namespace courant::cli
