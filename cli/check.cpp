#include "courant/running/check.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <optional>
#include <ostream>

#include "courant/cli/command.hpp"
#include "courant/cli/experiment_file.hpp"
#include "courant/cli/text.hpp"
#include "courant/cli/waiting.hpp"
#include "courant/core/words/message.hpp"

namespace courant::cli {
namespace {

std::string yes_or_no(const Json& value) {
  if (value.is_null()) return "–";
  return value.get<bool>() ? "yes" : "no";
}

// A claim with the defect that it was measured by; null: there is nothing to claim.
std::string measured(const Json& method, const char* claim, const char* defect) {
  if (method.at(claim).is_null()) return "not defined";
  return yes_or_no(method.at(claim)) + " (" + shown(method.at(defect), 2) + ")";
}

void print_matrix(std::ostream& out, const char* name, const Json& matrix) {
  out << "    " << name << '\n';
  for (const Json& row : matrix) {
    out << "     ";
    for (const Json& entry : row) {
      const std::string number =
          shown(std::abs(entry.get<double>()) < 5e-13 ? 0.0 : entry.get<double>(), 4);
      out << std::string(number.size() < 10 ? 10 - number.size() : 1, ' ') << number;
    }
    out << '\n';
  }
}

std::string at_point(const Json& point) {
  std::string text;
  int shown_ones = 0;
  for (const auto& [name, value] : point.items()) {
    if (++shown_ones > 6) return text + ", …";
    text += (text.empty() ? "" : ", ") + name + " = " + shown(value, 4);
  }
  return text;
}

void print_structure(const Console& console, const Json& structure) {
  std::ostream& out = console.out;
  const std::string ports = structure.at("ports");
  out << "\n  structure " << structure.at("name").get<std::string>()
      << (ports.empty() ? "" : " (" + ports + ")") << '\n';
  print_wrapped(console,
                "dim D = " + shown(structure.at("dimension")) +
                    ", dim M = " + shown(structure.at("manifold_dimension")) + "; isotropic " +
                    yes_or_no(structure.at("isotropic")) + " (" +
                    shown(structure.at("isotropy_defect"), 2) + "), coisotropic " +
                    yes_or_no(structure.at("coisotropic")) + " (" +
                    shown(structure.at("coisotropy_defect"), 2) + "), Dirac " +
                    yes_or_no(structure.at("dirac")),
                "    ");
  if (!structure.at("dirac").get<bool>()) {
    out << "    dim F_D = " << shown(structure.at("rank_of_F")) << "; integrability "
        << structure.at("integrability").get<std::string>() << '\n';
    return;
  }
  out << "    " << structure.at("kind").get<std::string>()
      << ": dim F_D = " << shown(structure.at("rank_of_F"))
      << ", rank ω_D = " << shown(structure.at("rank_of_form")) << ", Casimirs "
      << shown(structure.at("casimirs")) << '\n';
  out << "    integrable " << yes_or_no(structure.at("integrable"));
  if (!structure.at("integrable").is_null())
    out << ", defect " << shown(structure.at("integrability_defect"), 2);
  out << ": " << structure.at("integrability").get<std::string>() << '\n';
  if (const Json& where = structure.at("not_integrable_at"); !where.is_null())
    out << "    it fails at " << at_point(where) << '\n';
  for (const Json& where : structure.at("rank_jumps_at"))
    out << "    the rank jumps at " << at_point(where) << ": D is not smooth there\n";
  const Json& pair = structure.at("pair");
  if (structure.at("manifold_dimension").get<int>() <= 8) {
    print_matrix(out, "F_D, a basis in columns:", pair.at("F"));
    print_matrix(out, "ω_D in it:", pair.at("omega"));
  } else {
    out << "    the pair (F_D, ω_D) is in the JSON\n";
  }
}

void print_report(const Console& console, const Json& report) {
  std::ostream& out = console.out;
  if (const std::string title = report.at("title"); !title.empty()) out << printable(title) << '\n';
  const auto system = report.at("system").get<std::string>();
  const std::string home = " on " + report.at("manifold").get<std::string>();
  out << "  " << system << (system.ends_with(home) ? "" : home) << "\n\n";
  TextTable table({"law", "defect", "bound", ""});
  for (const Json& check : report.at("checks"))
    table.add({check.at("subject").get<std::string>() + "  " + check.at("law").get<std::string>() +
                   " " + check.at("statement").get<std::string>(),
               shown(check.at("defect"), 2), shown(check.at("bound"), 2),
               check.at("passed").get<bool>() ? "passed" : "FAILED"});
  table.print(out, "  ", console.columns);
  for (const Json& check : report.at("checks"))
    if (!check.at("passed").get<bool>())
      out << "  " << check.at("law").get<std::string>() << " failed at "
          << check.at("where").get<std::string>() << '\n';
  if (report.at("structures").empty())
    out << "\n  structure: the system is given by its equations, without a Dirac structure\n";
  for (const Json& structure : report.at("structures")) print_structure(console, structure);
  if (const Json& method = report.at("method"); !method.is_null()) {
    out << "\n  method " << method.at("name").get<std::string>() << '\n';
    print_wrapped(
        console,
        "order " + shown(method.at("order")) + ", measured " +
            shown(method.at("measured_order"), 3) + "; symmetric " +
            measured(method, "symmetric", "symmetry_defect") + "; symplectic " +
            measured(method, "symplectic", "symplecticity_defect") +
            "; distance of the structure from its image " +
            (method.at("structure_defect").is_null() ? "not defined"
                                                     : shown(method.at("structure_defect"), 2)),
        "    ");
  }
  if (!report.at("symmetries").empty()) {
    out << "\n  momenta of symmetries\n";
    for (const Json& symmetry : report.at("symmetries")) {
      const std::string remark = symmetry.at("remark");
      out << "    "
          << (remark.empty() ? symmetry.at("name").get<std::string>() + " is conserved." : remark);
      if (remark.empty() && !symmetry.at("kept").is_null())
        out << " The method " << (symmetry.at("kept").get<bool>() ? "keeps" : "does not keep")
            << " it: drift " << shown(symmetry.at("drift"), 2) << " of its terms.";
      out << '\n';
    }
  }
  if (!report.at("invariants").empty()) {
    out << "\n  along solutions\n";
    for (const Json& quantity : report.at("invariants"))
      out << "    d" << quantity.at("name").get<std::string>()
          << "/dt = " << shown(quantity.at("rate"), 2) << " of terms "
          << shown(quantity.at("scale"), 2) << ": "
          << (quantity.at("invariant").get<bool>() ? "invariant" : "not invariant") << '\n';
  }
  out << "\n  " << (report.at("passed").get<bool>() ? "All laws hold." : "Some laws do not hold.")
      << '\n';
}

// Whether something is so, in a sentence; where it is not known, nothing is said.
void say(std::vector<std::string>& words, const Json& claim, const char* is, const char* is_not) {
  if (claim.is_boolean()) words.push_back(claim.get<bool>() ? is : is_not);
}

std::string sentence(const std::string& subject, const std::vector<std::string>& words) {
  std::string text = "  " + subject;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? " " : i + 1 == words.size() ? " and " : ", ") + words[i];
  return text + ".\n";
}

// What fails, and the rest in a few words.
void print_brief(const Console& console, const Json& report) {
  std::ostream& out = console.out;
  std::vector<std::pair<std::string, std::vector<const Json*>>> subjects;
  for (const Json& check : report.at("checks")) {
    const auto subject = check.at("subject").get<std::string>();
    if (subjects.empty() || subjects.back().first != subject) subjects.push_back({subject, {}});
    subjects.back().second.push_back(&check);
  }
  for (const auto& [subject, checks] : subjects) {
    std::size_t held = 0;
    for (const Json* check : checks) held += check->at("passed").get<bool>() ? 1 : 0;
    out << "  " << subject << ": "
        << (held == checks.size() ? "all " + std::to_string(held)
                                  : std::to_string(held) + " of " + std::to_string(checks.size()))
        << " laws hold\n";
    for (const Json* check : checks)
      if (!check->at("passed").get<bool>())
        out << "    " << check->at("statement").get<std::string>() << "\n      is off by "
            << shown(check->at("defect"), 2) << ", allowed " << shown(check->at("bound"), 2)
            << ", at " << check->at("where").get<std::string>() << '\n';
  }
  for (const Json& structure : report.at("structures")) {
    std::vector<std::string> words;
    say(words, structure.at("dirac"), "is Dirac", "is not Dirac");
    if (structure.contains("integrable"))
      say(words, structure.at("integrable"), "integrable", "not integrable");
    out << sentence("The structure " + structure.at("name").get<std::string>(), words);
  }
  if (const Json& method = report.at("method"); !method.is_null()) {
    std::vector<std::string> words{"has order " + shown(method.at("order"))};
    say(words, method.at("symmetric"), "is symmetric", "is not symmetric");
    say(words, method.at("symplectic"), "is symplectic", "is not symplectic");
    out << sentence("The method " + method.at("name").get<std::string>(), words);
  }
  out << "  " << (report.at("passed").get<bool>() ? "All laws hold." : "Some laws do not hold.")
      << '\n';
}

}  // namespace

void add_check(CLI::App& app, Session& session) {
  struct Arguments {
    std::string file;
    bool json = false;
    bool brief = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* check = app.add_subcommand(
      "check",
      "Check the laws of an experiment's manifold, structure and method, and say what they are");
  check->add_option("FILE", arguments->file, "the experiment, or - for standard input")->required();
  CLI::Option* const json = check->add_flag("--json", arguments->json, "print JSON");
  check->add_flag("--brief", arguments->brief, "print what fails, and a summary in words")
      ->excludes(json);
  check->callback([&session, arguments] {
    session.action = [arguments](const Console& console) {
      return with_experiment(console, arguments->file, [&](const Experiment& experiment) -> int {
        std::optional<Waiting> waiting(std::in_place, console, "laws");
        const Json report = check_experiment(experiment);
        waiting.reset();
        if (arguments->json)
          console.out << report.dump(2) << '\n';
        else if (arguments->brief)
          print_brief(console, report);
        else
          print_report(console, report);
        return report.at("passed").get<bool>() ? done : failed;
      });
    };
  });
}

}  // namespace courant::cli
