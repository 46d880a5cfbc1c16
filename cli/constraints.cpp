#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <ostream>

#include "courant/cli/command.hpp"
#include "courant/cli/experiment_file.hpp"
#include "courant/cli/run_text.hpp"
#include "courant/cli/sweep.hpp"
#include "courant/cli/text.hpp"
#include "courant/cli/waiting.hpp"
#include "courant/core/files/own_file.hpp"
#include "courant/core/words/message.hpp"
#include "courant/reporting/branch_words.hpp"
#include "courant/reporting/ladder_diagram.hpp"
#include "courant/reporting/ladder_explanation.hpp"
#include "courant/reporting/ladder_page.hpp"
#include "courant/running/branch_report.hpp"
#include "courant/running/consistent_start.hpp"
#include "courant/running/discrete_ladder.hpp"
#include "courant/running/ladder_report.hpp"
#include "courant/running/other_values.hpp"

namespace courant::cli {
namespace {

// What the start is not, as it was given.
void print_moves(const Console& console, const LadderReport& ladder) {
  if (ladder.moves.empty()) return;
  // Of velocities and unknowns, which have units of their own, there is no sum.
  const std::string sum = ladder.moved > 0.0 ? ", by " + shown(ladder.moved, 4) + " in all:" : ":";
  print_wrapped(console,
                "Initial values that had to move to be consistent" +
                    std::string(ladder.is_impulse ? ", as an impulse moves them" : "") + sum,
                "  ");
  for (const Movement& move : ladder.moves)
    console.out << "      " << move.name << ' ' << from_and_to(move) << '\n';
  console.out << '\n';
}

void print_levels(const Console& console, const Experiment& experiment,
                  const LadderReport& ladder) {
  std::ostream& out = console.out;
  if (!experiment.title.empty()) out << printable(experiment.title) << '\n';
  print_wrapped(console, experiment.model.description, "  ");
  out << '\n';
  print_moves(console, ladder);
  for (const std::string& line : ladder_text_diagram(ladder)) out << "  " << line << '\n';
  out << "\n  (dim S, dim M): " << ladder_line(ladder) << "\n\n";
  TextTable table({"k", "dim S", "dim M", "fibre", "gap", "residual"});
  // What is left of equations that are solved is round-off.
  constexpr double nothing = 1e-20;
  for (const LadderReport::Level& level : ladder.levels)
    table.add({std::to_string(level.k), shown_if_known(level.dim_S), shown_if_known(level.dim_M),
               shown_if_known(level.fibre), shown_if_known(level.gap, 2),
               level.residual < nothing ? "0" : shown(level.residual, 2)});
  table.print(out);
  out << '\n';
}

void print_ladder(const Console& console, const Experiment& experiment, const LadderReport& ladder,
                  const std::optional<ConstraintBrackets>& brackets,
                  const std::vector<BranchReport>& branches) {
  std::ostream& out = console.out;
  print_levels(console, experiment, ladder);
  const bool is_stopped = ladder.reason.starts_with("Stopped");
  if (!is_stopped) print_wrapped(console, verdict_in_words(ladder), "  ");
  if (!ladder.reason.empty()) print_wrapped(console, ladder.reason, "  ");
  out << '\n';
  const std::vector<Prose> of_branches = branches_in_words(branches);
  for (const Prose& line : of_branches) print_wrapped(console, line.str(), "  ");
  if (!of_branches.empty()) out << '\n';
  for (const Prose& line : ladder_explanation(ladder, brackets))
    print_wrapped(console, line.str(), "  ");
}

void print_discrete(const Console& console, const Experiment& experiment,
                    const LadderReport& ladder, const LadderReport& continuous) {
  std::ostream& out = console.out;
  print_levels(console, experiment, ladder);
  for (const std::string& line : discrete_ladder_in_words(experiment, ladder))
    print_wrapped(console, line, "  ");
  out << "\n  without discretization: " << ladder_line(continuous) << '\n';
}

// The JSON of a ladder, and that of its brackets where there are some.
Json with_brackets(Json ladder, const std::optional<ConstraintBrackets>& brackets) {
  if (!brackets || !brackets->missing.empty()) return ladder;
  Json& json = ladder["brackets"];
  json = {{"constraints", brackets->constraints},
          {"matrix", Json::array()},
          {"first_class", brackets->is_first_class},
          {"hamiltonian", brackets->hamiltonian},
          {"generators", Json::array()},
          {"dirac", Json::array()}};
  for (const auto& row : brackets->matrix) {
    Json& texts = json["matrix"].emplace_back(Json::array());
    for (const ConstraintBrackets::Entry& entry : row) {
      if (entry.is_at_point) json["at_point"].push_back({json["matrix"].size() - 1, texts.size()});
      texts.push_back(entry.text);
    }
  }
  for (const auto& [constraint, moves] : brackets->generators) {
    json["generators"].push_back({{"constraint", constraint}, {"moves", Json::object()}});
    for (const auto& [coordinate, formula] : moves)
      json["generators"].back()["moves"][coordinate] = formula;
  }
  for (const auto& [first, second, value] : brackets->dirac_brackets)
    json["dirac"].push_back({{"of", {first, second}}, {"bracket", value}});
  return ladder;
}

using PageWriter = std::string (*)(const LadderPage&);

// By the ending of a file's name; null for others.
PageWriter page_writer(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  if (ending == ".html") return to_html;
  if (ending == ".tex") return to_latex;
  return ending == ".md" ? to_markdown : nullptr;
}

void write_page(const Console& console, const OwnFiles& files, const std::filesystem::path& path,
                const LadderPage& page) {
  files.write(path, page_writer(path)(page));
  console.out << shown_name(path) << '\n';
}

}  // namespace

void add_constraints(CLI::App& app, Session& session) {
  struct Arguments {
    std::string file;
    bool json = false, latex = false, markdown = false, discrete = false, digits = false,
         prove = false;
    Index level = -1;
    std::vector<std::string> settings;
    SweepArguments sweep;
    std::string output;  // a page; of a sweep its folder
    bool force = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* constraints = app.add_subcommand(
      "constraints", "Run the constraint algorithm at the initial point of an experiment");
  constraints->add_option("FILE", arguments->file, "the experiment, or - for standard input")
      ->required();
  add_settings(*constraints, arguments->settings);
  add_sweep(*constraints, arguments->sweep);
  CLI::Option* output =
      constraints
          ->add_option("-o", arguments->output,
                       "a page with the findings and their formulas set (.html, or .tex and .md); "
                       "of a sweep: the folder for its table and figure")
          ->type_name("FILE|DIR");
  constraints
      ->add_flag("--force", arguments->force,
                 "replace the page, or the sweep that is in the folder already")
      ->needs(output);
  CLI::Option* json = constraints->add_flag("--json", arguments->json, "print JSON");
  CLI::Option* latex =
      constraints->add_flag("--latex", arguments->latex, "print a document for LaTeX")
          ->excludes(json)
          ->excludes("--sweep");
  CLI::Option* markdown =
      constraints->add_flag("--markdown", arguments->markdown, "print Markdown with $formulas$")
          ->excludes(json)
          ->excludes(latex)
          ->excludes("--sweep");
  constraints
      ->add_flag("--digits", arguments->digits,
                 "decide ranks in two precisions, also those of a large system")
      ->excludes("--sweep");
  constraints
      ->add_flag("--prove", arguments->prove,
                 "prove by arithmetic with balls that there is a consistent point, and which "
                 "numbers are not zero")
      ->excludes("--sweep");
  CLI::Option* level =
      constraints->add_option("--level", arguments->level, "stop at this level of the ladder")
          ->check(CLI::Range(0, 1000).description(""))
          ->type_name("K")
          ->excludes("--sweep");
  constraints
      ->add_flag("--discrete", arguments->discrete,
                 "the ladder of the method's discretization map and step (Remark 6.1)")
      ->excludes(level)
      ->excludes(latex)
      ->excludes(markdown)
      ->excludes("--sweep");
  constraints->callback([&session, arguments] {
    if (arguments->sweep.ranges.empty() && !arguments->output.empty()) {
      if (!page_writer(arguments->output))
        throw CLI::ValidationError(
            "-o", "is " + arguments->output + "; expected a name that ends in .html, .tex or .md");
      if (arguments->discrete || arguments->json || arguments->latex || arguments->markdown)
        throw CLI::ValidationError(
            "-o", "is a page; --discrete, --json, --latex and --markdown print to the screen");
    }
    session.action = [arguments](const Console& console) {
      if (!arguments->sweep.ranges.empty())
        return run_sweep(console, {.file = arguments->file,
                                   .settings = arguments->settings,
                                   .sweep = arguments->sweep,
                                   .folder = arguments->output,
                                   .replace = arguments->force,
                                   .json = arguments->json,
                                   .action = [](const SweepCase& one,
                                                const auto&) { return ladder_of_case(one); },
                                   .columns = {{"verdict", "verdict"},
                                               {"ambiguous", "ambiguous"},
                                               {"ladder", "(dim S dim M)"},
                                               {"index", "index"},
                                               {"degrees_of_freedom", "degrees of freedom"},
                                               {"gap", "gap"}}});
      const OwnFiles files("constraints", arguments->force);
      if (!arguments->output.empty()) files.check(arguments->output);
      return with_experiment(
          console, arguments->file,
          [&](const Experiment& experiment) -> int {
            const bool as_page = !arguments->output.empty();
            std::optional<Waiting> waiting(std::in_place, console, "constraint algorithm");
            const ConsistentStart start =
                consistent_start(experiment, arguments->prove    ? Decider::proof
                                             : arguments->digits ? Decider::digits
                                                                 : Decider::both);
            const ImplicitSystem& system = *experiment.model.system;
            const ConstraintFormulas formulas = formulas_of_start(experiment, start);
            LadderReport whole = ladder_report(start, system, formulas);
            tell_of_start(experiment, start, whole);
            std::optional<ConstraintBrackets> brackets;
            if (!arguments->discrete && arguments->level < 0)
              brackets = constraint_brackets(system, start, formulas);
            const LadderReport ladder = arguments->discrete ? discrete_ladder(experiment, start)
                                        : arguments->level >= 0
                                            ? up_to_level(whole, arguments->level)
                                            : whole;
            const bool is_by_page = as_page || arguments->latex || arguments->markdown;
            const std::vector<BranchReport> branches = is_by_page || arguments->discrete
                                                           ? std::vector<BranchReport>()
                                                           : branch_reports(experiment);
            waiting.reset();
            if (as_page)
              write_page(console, files, arguments->output,
                         ladder_page(experiment, ladder, brackets));
            else if (arguments->latex)
              console.out << to_latex(ladder_page(experiment, ladder, brackets));
            else if (arguments->markdown)
              console.out << to_markdown(ladder_page(experiment, ladder, brackets));
            else if (arguments->json)
              console.out
                  << with_branches(with_brackets(to_json(ladder), brackets), branches).dump(2)
                  << '\n';
            else if (arguments->discrete)
              print_discrete(console, experiment, ladder, whole);
            else
              print_ladder(console, experiment, ladder, brackets, branches);
            return done;
          },
          arguments->settings);
    };
  });
}

}  // namespace courant::cli
