#include "courant/running/ladder_json.hpp"

#include <cmath>

#include "courant/integrators/ladder/constraint_classes.hpp"
#include "courant/integrators/ladder/constraint_formulas.hpp"

namespace courant {
namespace {

Json known(Index value) { return value < 0 ? Json() : Json(value); }

// The name of an equation; where nobody gave it one, what it is the equation of.
std::string equation_name(Index equation, const ImplicitSystem& system) {
  const std::string& name = system.names().equations[static_cast<std::size_t>(equation)];
  if (!name.starts_with("equation[")) return name;
  const std::vector<std::string> velocities = velocity_names(system);
  return system.tangent_blocks() > 0 && equation < static_cast<Index>(velocities.size())
             ? "equation of " + velocities[static_cast<std::size_t>(equation)]
             : "equation " + std::to_string(equation + 1);
}

Json terms(const Combination& combination, const ImplicitSystem& system) {
  Json list = Json::array();
  for (const Combination::Term& term : combination.terms)
    list.push_back({{"equation", equation_name(term.equation, system)},
                    {"derivative", term.derivative},
                    {"coefficient", term.coefficient}});
  return list;
}

// The components of a vector that are not round-off, by name.
Json components(const VectorXd& vector, const std::vector<std::string>& names) {
  Json object = Json::object();
  const double largest = vector.size() == 0 ? 0.0 : vector.lpNorm<Eigen::Infinity>();
  for (Index i = 0; i < vector.size(); ++i)
    if (std::abs(vector[i]) > 1e-10 * largest)
      object[names[static_cast<std::size_t>(i)]] = vector[i];
  return object;
}

// What elimination by hand would find.
void add_formulas(Json& json, const ConstraintFormulas& formulas,
                  const std::vector<std::string>& velocities) {
  json["formulas"] = Json::array();
  for (const auto& [level, formula] : formulas.constraints)
    json["formulas"].push_back({{"level", level}, {"formula", formula}});
  json["steps"] = Json::array();
  for (const ConstraintFormulas::Step& step : formulas.steps)
    json["steps"].push_back({{"level", step.level},
                             {"kind", to_string(step.kind)},
                             {"constraint", step.constraint},
                             {"derivative", step.derivative},
                             {"result", step.result}});
  json["velocities"] = Json::object();
  for (const auto& [component, level, formula] : formulas.velocities)
    json["velocities"][velocities[static_cast<std::size_t>(component)]] = {{"level", level},
                                                                           {"formula", formula}};
}

void add_classes(Json& json, const ConstraintLadder& ladder, const ImplicitSystem& system) {
  const auto found = constraint_classes(system, ladder);
  if (!found) return;
  json["degrees_of_freedom_up_to_gauge"] = found->degrees_of_freedom_up_to_gauge;
  json["classes"] = {{"primary", found->primary}, {"secondary", found->secondary}};
  if (found->brackets) {
    json["classes"]["first_class"] = found->brackets->first_class;
    json["classes"]["second_class"] = found->brackets->second_class;
    json["classes"]["primary_first_class"] = found->brackets->primary_first_class;
  }
  json["classes"]["ambiguous"] = found->is_ambiguous();
}

// What is known at the end of a ladder that has one.
void describe(Json& json, const ConstraintLadder& ladder, const ImplicitSystem& system) {
  const ConstraintFormulas formulas = constraint_formulas(system, ladder);
  const std::vector<std::string> velocities = velocity_names(system);
  const auto& coordinates = system.names().coordinates;
  const std::vector<std::string>& covectors =
      velocities.size() == coordinates.size() ? coordinates : velocities;
  json["constraints"] = Json::array();
  for (const PointConstraint& constraint : ladder.constraints)
    json["constraints"].push_back({{"level", constraint.level},
                                   {"gradient", components(constraint.gradient, covectors)},
                                   {"from", terms(constraint.origin, system)}});
  add_formulas(json, formulas, velocities);
  json["unknowns"] = Json::object();
  for (Index i = 0; i < system.auxiliary_size(); ++i)
    json["unknowns"][system.names().auxiliary[static_cast<std::size_t>(i)]] = {
        {"value", ladder.point.z[i]},
        {"determined", static_cast<bool>(ladder.determined[static_cast<std::size_t>(i)])}};
  for (const auto& [unknown, formula] : formulas.values)
    json["unknowns"][system.names().auxiliary[static_cast<std::size_t>(unknown)]]["formula"] =
        formula;
  json["gauge_directions"] = Json::array();
  for (Index c = 0; c < ladder.gauge_directions.cols(); ++c)
    json["gauge_directions"].push_back(components(ladder.gauge_directions.col(c), velocities));
  // Components of the velocity that gauge freedom leaves as they are.
  json["determined_velocities"] = Json::array();
  for (std::size_t i = 0; i < ladder.determined_velocities.size(); ++i)
    if (ladder.determined_velocities[i]) json["determined_velocities"].push_back(velocities[i]);
  json["differentiations"] = Json::object();
  for (std::size_t i = 0; i < ladder.differentiations.size(); ++i)
    if (ladder.differentiations[i] > 0)
      json["differentiations"][system.names().equations[i]] = ladder.differentiations[i];
  // Dependences among the equations themselves; those of derivatives follow from them or say that a
  // constraint is kept.
  json["redundant"] = Json::array();
  for (const Combination& combination : ladder.redundancies) {
    bool algebraic = true;
    for (const auto& term : combination.terms) algebraic = algebraic && term.derivative == 0;
    if (algebraic) json["redundant"].push_back(terms(combination, system));
  }
}

// Verdict, levels and point.
Json levels_json(const ConstraintLadder& ladder, const ImplicitSystem& system) {
  Json json{{"verdict", to_string(ladder.verdict)},
            {"index", known(ladder.index)},
            {"gauge_dimension", ladder.gauge_dimension},
            {"degrees_of_freedom", known(ladder.degrees_of_freedom)},
            {"dimension", system.manifold()->dimension()},
            {"levels", Json::array()},
            {"consistent_point", Json::object()},
            {"moved", ladder.moved},
            {"moves", Json::array()},
            {"ambiguous", ladder.is_ambiguous()},
            {"doubts", ladder.doubts},
            {"reason", ladder.reason}};
  for (const LadderLevel& level : ladder.levels) {
    const auto found = [&](const Json& value) { return level.is_empty ? Json() : value; };
    // Of the decision with the smallest gap.
    const RankDecision* weakest = &level.all;
    for (const RankDecision* other : {&level.without_tangent, &level.without_point})
      if (other->gap < weakest->gap) weakest = other;
    json["levels"].push_back({{"k", level.k},
                              {"dim_S", found(level.dim_S)},
                              {"dim_M", found(level.dim_M)},
                              {"fibre", found(level.fibre())},
                              {"gap", found(level.gap())},
                              {"smallest_counted", found(weakest->above)},
                              {"largest_neglected", found(weakest->below)},
                              {"residual", level.residual}});
  }
  const auto& names = system.names().coordinates;
  for (Index i = 0; i < ladder.point.x.size(); ++i)
    json["consistent_point"][names[static_cast<std::size_t>(i)]] = ladder.point.x[i];
  for (const Movement& move : ladder.moves)
    json["moves"].push_back({{"name", move.name}, {"from", move.from}, {"to", move.to}});
  return json;
}

}  // namespace

Json ladder_json(const ConstraintLadder& ladder, const ImplicitSystem& system) {
  Json json = levels_json(ladder, system);
  if (ladder.index >= 0) {
    add_classes(json, ladder, system);
    describe(json, ladder, system);
  } else if (ladder.verdict == Verdict::inconsistent) {
    add_formulas(json, constraint_formulas(system, ladder), velocity_names(system));
  }
  return json;
}

Json discrete_ladder_json(const ConstraintLadder& ladder, const ImplicitSystem& system) {
  return levels_json(ladder, system);
}

Json up_to_level(Json ladder, Index level) {
  const Json& index = ladder.at("index");
  const auto beyond = [&](const Json& entry, const char* key) {
    return entry.at(key).get<Index>() > level;
  };
  const auto cut = [&](const char* list, const char* key) {
    if (!ladder.contains(list)) return;
    Json kept = Json::array();
    for (const Json& entry : ladder.at(list))
      if (!beyond(entry, key)) kept.push_back(entry);
    ladder[list] = kept;
  };
  const bool is_complete =
      !index.is_null() ? level > index.get<Index>()
                       : ladder.at("levels").empty() || !beyond(ladder.at("levels").back(), "k");
  if (is_complete) return ladder;
  cut("levels", "k");
  for (const char* list : {"constraints", "formulas", "steps"}) cut(list, "level");
  if (ladder.contains("velocities")) {
    Json kept = Json::object();
    for (const auto& [name, velocity] : ladder.at("velocities").items())
      if (!beyond(velocity, "level")) kept[name] = velocity;
    ladder["velocities"] = kept;
  }
  // What is known at the end only.
  for (const char* key : {"unknowns", "gauge_directions", "determined_velocities", "redundant",
                          "differentiations", "classes", "degrees_of_freedom_up_to_gauge"})
    ladder.erase(key);
  ladder["verdict"] = "not-reached";
  ladder["index"] = nullptr;
  ladder["degrees_of_freedom"] = nullptr;
  ladder["gauge_dimension"] = 0;
  ladder["reason"] = "Stopped at level " + std::to_string(level) + ", as asked.";
  return ladder;
}

}  // namespace courant
