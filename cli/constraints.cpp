#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <ostream>
#include <sstream>

#include "courant/cli/command.hpp"
#include "courant/cli/experiment_file.hpp"
#include "courant/cli/text.hpp"
#include "courant/core/message.hpp"
#include "courant/reporting/ladder_diagram.hpp"
#include "courant/reporting/ladder_explanation.hpp"
#include "courant/running/consistent_start.hpp"
#include "courant/running/ladder_json.hpp"

namespace courant::cli {
namespace {

// `text` in lines of at most 96 characters, each after `indent`; a line that is indented itself
// stays whole.
void print_wrapped(std::ostream& out, const std::string& text, const std::string& indent) {
  constexpr std::size_t columns = 96;
  if (text.starts_with(' ')) {
    out << indent << text << '\n';
    return;
  }
  std::string line;
  std::size_t length = 0;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const auto width = static_cast<std::size_t>(
        std::count_if(word.begin(), word.end(), [](char c) { return (c & 0xC0) != 0x80; }));
    if (length > 0 && length + 1 + width > columns) {
      out << indent << line << '\n';
      line.clear();
      length = 0;
    }
    line += (length == 0 ? "" : " ") + word;
    length += width + (length == 0 ? 0 : 1);
  }
  out << indent << line << '\n';
}

void print_ladder(const Console& console, const Experiment& experiment, const Json& ladder) {
  std::ostream& out = console.out;
  if (!experiment.title.empty()) out << printable(experiment.title) << '\n';
  out << "  " << experiment.model.description << "\n\n";
  for (const std::string& line : ladder_text_diagram(ladder)) out << "  " << line << '\n';
  out << "\n  (dim S, dim M): " << ladder_line(ladder) << "\n\n";
  TextTable table({"k", "dim S", "dim M", "fibre", "gap", "residual"});
  for (const Json& level : ladder.at("levels"))
    table.add({shown(level.at("k")), shown(level.at("dim_S")), shown(level.at("dim_M")),
               shown(level.at("fibre")), shown(level.at("gap"), 2),
               shown(level.at("residual"), 2)});
  table.print(out);
  out << '\n';
  print_wrapped(out, verdict_in_words(ladder), "  ");
  if (const std::string reason = ladder.at("reason"); !reason.empty())
    print_wrapped(out, reason, "  ");
  out << '\n';
  for (const std::string& line : ladder_explanation(ladder)) print_wrapped(out, line, "  ");
  if (!ladder.at("moves").empty()) {
    out << '\n';
    print_wrapped(out,
                  "Initial values that had to move to be consistent, by " +
                      shown(ladder.at("moved"), 4) + " in all:",
                  "  ");
    for (const Json& move : ladder.at("moves"))
      out << "      " << move.at("name").get<std::string>() << " from " << shown(move.at("from"))
          << " to " << shown(move.at("to")) << '\n';
  }
}

}  // namespace

void add_constraints(CLI::App& app, Session& session) {
  struct Arguments {
    std::string file;
    bool json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* constraints = app.add_subcommand(
      "constraints", "Run the constraint algorithm at the initial point of an experiment");
  constraints->add_option("FILE", arguments->file, "the experiment, or - for standard input")
      ->required();
  constraints->add_flag("--json", arguments->json, "print JSON");
  constraints->callback([&session, arguments] {
    session.action = [arguments](const Console& console) {
      return with_experiment(console, arguments->file, [&](const Experiment& experiment) -> int {
        const Json ladder = ladder_json(consistent_start(experiment), *experiment.model.system);
        if (arguments->json)
          console.out << ladder.dump(2) << '\n';
        else
          print_ladder(console, experiment, ladder);
        return done;
      });
    };
  });
}

}  // namespace courant::cli
