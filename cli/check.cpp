#include "courant/running/check.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <ostream>

#include "courant/cli/command.hpp"
#include "courant/cli/experiment_file.hpp"
#include "courant/cli/text.hpp"
#include "courant/core/message.hpp"

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

void print_structure(std::ostream& out, const Json& structure) {
  const std::string ports = structure.at("ports");
  out << "\n  structure " << structure.at("name").get<std::string>()
      << (ports.empty() ? "" : " (" + ports + ")")
      << "\n    dim D = " << shown(structure.at("dimension"))
      << ", dim M = " << shown(structure.at("manifold_dimension")) << "; isotropic "
      << yes_or_no(structure.at("isotropic")) << " (" << shown(structure.at("isotropy_defect"), 2)
      << "), coisotropic " << yes_or_no(structure.at("coisotropic")) << " ("
      << shown(structure.at("coisotropy_defect"), 2) << "), Dirac "
      << yes_or_no(structure.at("dirac")) << '\n';
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
  table.print(out);
  for (const Json& check : report.at("checks"))
    if (!check.at("passed").get<bool>())
      out << "  " << check.at("law").get<std::string>() << " failed at "
          << check.at("where").get<std::string>() << '\n';
  if (report.at("structures").empty())
    out << "\n  structure: the system is given by its equations, without a Dirac structure\n";
  for (const Json& structure : report.at("structures")) print_structure(out, structure);
  if (const Json& method = report.at("method"); !method.is_null())
    out << "\n  method " << method.at("name").get<std::string>() << "\n    order "
        << shown(method.at("order")) << ", measured " << shown(method.at("measured_order"), 3)
        << "; symmetric " << measured(method, "symmetric", "symmetry_defect") << "; symplectic "
        << measured(method, "symplectic", "symplecticity_defect")
        << "; distance of the structure from its image "
        << (method.at("structure_defect").is_null() ? "not defined"
                                                    : shown(method.at("structure_defect"), 2))
        << "\n";
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

}  // namespace

void add_check(CLI::App& app, Session& session) {
  struct Arguments {
    std::string file;
    bool json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* check = app.add_subcommand(
      "check",
      "Check the laws of an experiment's manifold, structure and method, and say what they are");
  check->add_option("FILE", arguments->file, "the experiment, or - for standard input")->required();
  check->add_flag("--json", arguments->json, "print JSON");
  check->callback([&session, arguments] {
    session.action = [arguments](const Console& console) {
      return with_experiment(console, arguments->file, [&](const Experiment& experiment) -> int {
        const Json report = check_experiment(experiment);
        if (arguments->json)
          console.out << report.dump(2) << '\n';
        else
          print_report(console, report);
        return report.at("passed").get<bool>() ? done : failed;
      });
    };
  });
}

}  // namespace courant::cli
