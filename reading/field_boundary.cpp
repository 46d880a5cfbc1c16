#include "courant/reading/field_boundary.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "courant/core/numbers/as_size.hpp"
#include "courant/core/words/message.hpp"
#include "courant/core/words/spelling.hpp"

namespace courant {
namespace {

using Kind = RegionCondition::Kind;

// The form on k-cells of the boundary: an effort over the cells, or a flow over their duals within the region.
CellForm form_on_boundary(const CellComplex& complex, Index degree, VectorXd sizes) {
  return {degree > 0, complex.positions(degree), complex.directions(degree), std::move(sizes)};
}

std::optional<RegionCondition> read_condition(const std::string& region, const JsonReader& value,
                                              const CellForm& form,
                                              const std::vector<std::string>& efforts) {
  if (!value.value().is_object()) {
    value.expected("an object, with \"" + efforts[0] + "\", \"" + efforts[1] +
                   "\", \"impedance\" or \"port\"");
    return std::nullopt;
  }
  ObjectReader object(value);
  const auto effort = object.optional(efforts[0]), flow = object.optional(efforts[1]),
             impedance = object.optional("impedance"), port = object.optional("port"),
             profile = object.optional("profile");
  const int kinds = int(effort.has_value()) + int(flow.has_value()) + int(impedance.has_value()) +
                    int(port.has_value());
  if (kinds != 1) {
    value.problem("says in " + std::to_string(kinds) +
                  " ways what happens there; expected one of \"" + efforts[0] + "\", \"" +
                  efforts[1] + "\", \"impedance\" or \"port\"");
    return std::nullopt;
  }
  if (profile && !port) {
    profile->problem("is for a port; expected \"port\" beside it");
    return std::nullopt;
  }
  RegionCondition condition{region, value.pointer(), Kind::flow, {}, {}};
  std::optional<WrittenFormulas> formulas;
  if (effort || flow) {
    condition.kind = effort ? Kind::effort : Kind::flow;
    formulas = read_form(effort ? *effort : *flow, form);
  } else if (impedance) {
    condition.kind = Kind::impedance;
    if (const auto one = read_formula(*impedance)) formulas = WrittenFormulas{{}, {*one}};
  } else {
    const auto word = port->word(efforts);
    if (!word) return std::nullopt;
    condition.kind = *word == efforts[0] ? Kind::effort_port : Kind::flow_port;
    if (profile)
      formulas = read_form(*profile, form);
    else if (!form.is_vector)
      formulas = WrittenFormulas{{}, {{"1", port->pointer()}}};
    else
      value.problem("has a port of vectors; expected their directions in \"profile\"");
  }
  if (!formulas) return std::nullopt;
  condition.formulas = std::move(*formulas);
  return condition;
}

// Numbers for cells, at formulas that depend on the place alone.
std::optional<VectorXd> numbers_at(const CellForm& form, const std::vector<Index>& cells,
                                   const WrittenFormulas& formulas, const Vocabulary& words,
                                   Findings& findings) {
  const SymbolTable constants = words.symbols({});
  SymbolTable sample = constants;
  add_place(sample, form.positions, cells.front());
  if (!check(formulas, sample, findings)) return std::nullopt;
  const ExprVector all = integrated(form, cells, formulas, constants);
  for (const Expr& number : all)
    if (!number.is_constant() || !std::isfinite(number.value())) {
      findings.problem(formulas.formulas.front().pointer,
                       "is not a finite number at each cell; expected a formula of the place");
      return std::nullopt;
    }
  return values(all);
}

}  // namespace

std::optional<std::vector<RegionCondition>> read_boundary(const JsonReader& boundary,
                                                          const CellComplex& complex, Index degree,
                                                          const std::vector<std::string>& efforts,
                                                          bool is_of_heat) {
  const auto entries = boundary.entries();
  if (!entries) return std::nullopt;
  std::vector<std::string> names;
  for (const CellComplex::Region& region : complex.regions()) names.push_back(region.name);
  const CellForm form = form_on_boundary(complex, degree, VectorXd::Ones(complex.count(degree)));
  std::vector<RegionCondition> conditions;
  std::set<Index> claimed;
  bool right = true;
  for (const auto& [name, value] : *entries) {
    const CellComplex::Region* region = complex.region(name);
    if (!region) {
      value.problem("there is no region \"" + name + "\"" + did_you_mean(name, names));
      right = false;
      continue;
    }
    auto condition = read_condition(name, value, form, efforts);
    right = right && condition;
    if (!condition) continue;
    if (is_of_heat && condition->kind == Kind::impedance) {
      value.problem("has an impedance, and this is heat; expected a temperature, a flow or a port");
      right = false;
    }
    condition->cells = complex.cells_of(degree, region->facets);
    if (condition->has_effort_cells())
      std::erase_if(condition->cells, [&](Index cell) { return !claimed.insert(cell).second; });
    conditions.push_back(std::move(*condition));
  }
  for (RegionCondition& condition : conditions) {
    if (!condition.has_effort_cells())
      std::erase_if(condition.cells, [&](Index cell) { return claimed.contains(cell); });
    if (condition.cells.empty()) {
      boundary.findings().problem(condition.pointer,
                                  "has no cells that are not in other regions; expected some");
      right = false;
    }
  }
  return right ? std::optional(conditions) : std::nullopt;
}

std::vector<Index> effort_cells(const std::vector<RegionCondition>& conditions) {
  std::vector<Index> cells;
  for (const RegionCondition& condition : conditions)
    if (condition.has_effort_cells())
      cells.insert(cells.end(), condition.cells.begin(), condition.cells.end());
  return cells;
}

bool add_boundary(const std::vector<RegionCondition>& conditions, const StokesDirac& structure,
                  const Vocabulary& words, StokesDiracSystem::Setting& setting,
                  Findings& findings) {
  const CellComplex& complex = *structure.complex();
  const Index degree = structure.degree(), flows = std::ssize(structure.flow_cells());
  const auto column_of = [&](const std::vector<Index>& cells, Index cell) {
    return std::lower_bound(cells.begin(), cells.end(), cell) - cells.begin();
  };
  bool right = true;
  for (const RegionCondition& condition : conditions) {
    const bool of_efforts = condition.has_effort_cells();
    std::vector<Index> columns;
    for (const Index cell : condition.cells)
      columns.push_back(of_efforts ? flows + column_of(structure.effort_cells(), cell)
                                   : column_of(structure.flow_cells(), cell));
    const VectorXd duals =
        complex.boundary_dual_measures(degree, complex.region(condition.region)->facets);
    CellForm form =
        form_on_boundary(complex, degree, of_efforts ? complex.measures(degree) : duals);
    if (condition.kind == Kind::effort || condition.kind == Kind::flow) {
      const auto input = [form, condition, words](const Expr& t) {
        return integrated(form, condition.cells, condition.formulas, words.symbols({.t = t}));
      };
      const Graph graph;
      SymbolTable sample = words.symbols({.t = graph.variable("t")});
      add_place(sample, form.positions, condition.cells.front());
      if (!check(condition.formulas, sample, findings))
        right = false;
      else
        setting.supplies.push_back({condition.region, columns, input});
      continue;
    }
    if (condition.kind == Kind::impedance) {
      form.is_vector = false;
      form.sizes = complex.measures(degree).cwiseQuotient(duals);  // u = -|⋆_bσ|/(|σ| Z) y
      const auto impedances =
          numbers_at(form, condition.cells, condition.formulas, words, findings);
      if (impedances && !(impedances->minCoeff() > 0.0))
        findings.problem(
            condition.formulas.formulas.front().pointer,
            "has the value " + number_text(impedances->minCoeff()) + "; expected more than 0");
      else if (impedances)
        setting.absorptions.push_back({condition.region, columns, impedances->cwiseInverse()});
      right = right && impedances && impedances->minCoeff() > 0.0;
      continue;
    }
    const auto profile = numbers_at(form, condition.cells, condition.formulas, words, findings);
    right = right && profile;
    if (profile) setting.ports.push_back({condition.region, columns, *profile});
  }
  return right;
}

}  // namespace courant
