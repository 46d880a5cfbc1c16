#include "courant/running/ladder_json.hpp"

#include <cmath>

#include "courant/integrators/ladder/constraint_formulas.hpp"

namespace courant {
namespace {

Json known(Index value) { return value < 0 ? Json() : Json(value); }

Json terms(const Combination& combination, const ImplicitSystem& system) {
  Json list = Json::array();
  for (const Combination::Term& term : combination.terms)
    list.push_back({{"equation", system.names().equations[static_cast<std::size_t>(term.equation)]},
                    {"derivative", term.derivative},
                    {"coefficient", term.coefficient}});
  return list;
}

// The components of a vector that are not round-off, by name.
Json components(const VectorXd& vector, const ImplicitSystem& system, const char* suffix) {
  Json object = Json::object();
  const auto& names = system.names().coordinates;
  const double largest = vector.size() == 0 ? 0.0 : vector.lpNorm<Eigen::Infinity>();
  const bool one_name_each = static_cast<std::size_t>(vector.size()) == names.size();
  for (Index i = 0; i < vector.size(); ++i) {
    if (std::abs(vector[i]) <= 1e-10 * largest) continue;
    const std::string name =
        one_name_each ? names[static_cast<std::size_t>(i)] : "v[" + std::to_string(i) + "]";
    object[name + (one_name_each ? suffix : "")] = vector[i];
  }
  return object;
}

// What is known at the end of a ladder that has one.
void describe(Json& json, const ConstraintLadder& ladder, const ImplicitSystem& system) {
  const ConstraintFormulas formulas = constraint_formulas(system, ladder);
  json["constraints"] = Json::array();
  for (const PointConstraint& constraint : ladder.constraints)
    json["constraints"].push_back({{"level", constraint.level},
                                   {"gradient", components(constraint.gradient, system, "")},
                                   {"from", terms(constraint.origin, system)}});
  json["formulas"] = Json::array();
  for (const auto& [level, formula] : formulas.constraints)
    json["formulas"].push_back({{"level", level}, {"formula", formula}});
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
    json["gauge_directions"].push_back(components(ladder.gauge_directions.col(c), system, "'"));
  // Components of the velocity that gauge freedom leaves as they are.
  json["determined_velocities"] = Json::array();
  const auto& names = system.names().coordinates;
  for (std::size_t i = 0; i < ladder.determined_velocities.size(); ++i)
    if (ladder.determined_velocities[i])
      json["determined_velocities"].push_back(ladder.determined_velocities.size() == names.size()
                                                  ? names[i] + "'"
                                                  : "v[" + std::to_string(i) + "]");
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

}  // namespace

Json ladder_json(const ConstraintLadder& ladder, const ImplicitSystem& system) {
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
  if (ladder.index >= 0) describe(json, ladder, system);
  return json;
}

}  // namespace courant
