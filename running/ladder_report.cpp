#include "courant/running/ladder_report.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/structures/dirac_system.hpp"
#include "courant/structures/family_rank.hpp"
#include "courant/structures/joint.hpp"
#include "courant/structures/morse_family.hpp"

namespace courant {
namespace {

std::optional<Index> known(Index value) {
  return value < 0 ? std::nullopt : std::optional<Index>(value);
}

// The name of an equation; where nobody gave it one, what it is the equation of.
std::string equation_name(Index equation, const ImplicitSystem& system) {
  const std::string& name = system.names().equations[static_cast<std::size_t>(equation)];
  if (!name.starts_with("equation[")) return name;
  const std::vector<std::string> velocities = velocity_names(system);
  return system.tangent_blocks() > 0 && equation < static_cast<Index>(velocities.size())
             ? "equation of " + velocities[static_cast<std::size_t>(equation)]
             : "equation " + std::to_string(equation + 1);
}

LadderReport::Origin origin(const Combination& combination, const ImplicitSystem& system) {
  LadderReport::Origin terms;
  for (const Combination::Term& term : combination.terms)
    terms.push_back({equation_name(term.equation, system), term.derivative, term.coefficient});
  return terms;
}

// The components of a vector that are not round-off.
LadderReport::Values components(const VectorXd& vector, const std::vector<std::string>& names) {
  LadderReport::Values values;
  const double largest = vector.size() == 0 ? 0.0 : vector.lpNorm<Eigen::Infinity>();
  for (Index i = 0; i < vector.size(); ++i)
    if (std::abs(vector[i]) > 1e-10 * largest)
      values.emplace_back(names[static_cast<std::size_t>(i)], vector[i]);
  return values;
}

LadderReport::Elimination elimination(const ConstraintFormulas& formulas,
                                      const std::vector<std::string>& velocities) {
  LadderReport::Elimination found{.formulas = formulas.constraints, .steps = formulas.steps};
  auto in_order = formulas.velocities;
  std::ranges::sort(in_order, {}, &ConstraintFormulas::Velocity::component);
  for (const auto& [component, level, formula, on_M_f] : in_order)
    found.velocities.push_back(
        {velocities[static_cast<std::size_t>(component)], level, formula, on_M_f});
  return found;
}

std::optional<LadderReport::Classes> classes(const ConstraintLadder& ladder,
                                             const ImplicitSystem& system) {
  const auto found = constraint_classes(system, ladder);
  if (!found) return std::nullopt;
  return LadderReport::Classes{
      .primary = found->primary,
      .secondary = found->secondary,
      .brackets = found->brackets,
      .is_ambiguous = found->is_ambiguous(),
      .degrees_of_freedom_up_to_gauge = found->degrees_of_freedom_up_to_gauge};
}

std::vector<LadderReport::Constraint> constraints(const ConstraintLadder& ladder,
                                                  const ImplicitSystem& system) {
  const std::vector<std::string> velocities = velocity_names(system);
  const auto& coordinates = system.names().coordinates;
  const std::vector<std::string>& covectors =
      velocities.size() == coordinates.size() ? coordinates : velocities;
  std::vector<LadderReport::Constraint> found;
  for (const PointConstraint& constraint : ladder.constraints)
    found.push_back({constraint.level, components(constraint.gradient, covectors),
                     origin(constraint.origin, system)});
  return found;
}

// Nothing where there is no λ, or no point of 𝓛 at which the derivatives exist.
std::optional<LadderReport::Family> family(const ConstraintLadder& ladder,
                                           const ImplicitSystem& system) {
  const auto* dirac = dynamic_cast<const DiracSystem*>(&system);
  if (!dirac || !dynamic_cast<const MorseFamily*>(dirac->family().get())) return std::nullopt;
  const GeneratingFamily& E = *dirac->family();
  const Index k = E.parameter_size();
  const State& point = ladder.point;
  if (k == 0 || ladder.verdict == Verdict::inconsistent || !point.x.allFinite() ||
      point.z.size() < k || !point.z.head(k).allFinite())
    return std::nullopt;
  try {
    const RankDecision rank = family_rank(E, {point.x, point.z.head(k), point.t});
    return LadderReport::Family{.multipliers = k, .rank = rank.rank};
  } catch (const std::domain_error&) {
    return std::nullopt;
  }
}

// Counted from the last joint back: its conditions, and those of the joints after it, that combinations give by others.
std::vector<LadderReport::RedundantJoint> redundant_joints(
    const std::vector<const Combination*>& dependences, const ImplicitSystem& system) {
  const std::vector<std::string>& equations = system.names().equations;
  std::vector<LadderReport::RedundantJoint> joints;
  if (dependences.empty()) return joints;
  std::vector<Index> column(equations.size(), -1), first;  // of conditions, joint after joint
  Index count = 0;
  for (std::size_t i = 0; i < equations.size(); ++i) {
    const auto joint = joint_of_equation(equations[i]);
    if (!joint) continue;
    if (joints.empty() || joints.back().joint != *joint) {
      joints.push_back({.joint = *joint});
      first.push_back(count);
    }
    ++joints.back().of;
    column[i] = count++;
  }
  MatrixXd matrix = MatrixXd::Zero(std::ssize(dependences), count);
  for (Index row = 0; row < matrix.rows(); ++row)
    for (const Combination::Term& term : dependences[static_cast<std::size_t>(row)]->terms)
      if (const Index at = column[static_cast<std::size_t>(term.equation)]; at >= 0)
        matrix(row, at) += term.coefficient;
  Index later = 0;
  for (std::size_t j = joints.size(); j-- > 0;) {
    const MatrixXd part = matrix.rightCols(count - first[j]);
    const Index rank = part.cols() - kernel(part, {.data_error = 1e-9}).cols();
    joints[j].conditions = rank - later;
    later = rank;
  }
  std::erase_if(joints, [](const auto& joint) { return joint.conditions == 0; });
  return joints;
}

LadderReport::End end(const ConstraintLadder& ladder, const ImplicitSystem& system,
                      const ConstraintFormulas& formulas) {
  const std::vector<std::string> velocities = velocity_names(system);
  LadderReport::End found;
  for (Index i = 0; i < system.auxiliary_size(); ++i) {
    const auto place = static_cast<std::size_t>(i);
    found.unknowns.push_back({.name = system.names().auxiliary[place],
                              .value = ladder.point.z[i],
                              .is_determined = static_cast<bool>(ladder.determined[place])});
  }
  for (const auto& [unknown, formula] : formulas.values)
    found.unknowns[static_cast<std::size_t>(unknown)].formula = formula;
  for (Index c = 0; c < ladder.gauge_directions.cols(); ++c)
    found.gauge_directions.push_back(components(ladder.gauge_directions.col(c), velocities));
  for (std::size_t i = 0; i < ladder.determined_velocities.size(); ++i)
    if (ladder.determined_velocities[i]) found.determined_velocities.push_back(velocities[i]);
  for (std::size_t i = 0; i < ladder.differentiations.size(); ++i)
    if (ladder.differentiations[i] > 0)
      found.differentiations.emplace_back(system.names().equations[i], ladder.differentiations[i]);
  // Dependences of derivatives follow from those of equations or say that a constraint is kept. Where a
  // manifold lies in a space with more coordinates, its equations are as many as these.
  const Manifold& M = *system.manifold();
  const auto in_excess = static_cast<std::size_t>(M.tangent_dimension() - M.dimension());
  if (system.tangent_blocks() > 0 && ladder.redundancies.size() <= in_excess) return found;
  std::vector<const Combination*> dependences;
  for (const Combination& combination : ladder.redundancies)
    if (std::all_of(combination.terms.begin(), combination.terms.end(),
                    [](const Combination::Term& term) { return term.derivative == 0; })) {
      dependences.push_back(&combination);
      found.redundant.push_back(origin(combination, system));
    }
  found.redundant_joints = redundant_joints(dependences, system);
  return found;
}

}  // namespace

const LadderReport::Velocity* LadderReport::Elimination::velocity(const std::string& name) const {
  for (const Velocity& velocity : velocities)
    if (velocity.name == name) return &velocity;
  return nullptr;
}

LadderReport discrete_ladder_report(const ConstraintLadder& ladder, const ImplicitSystem& system) {
  LadderReport report{
      .verdict = ladder.verdict,
      .index = known(ladder.index),
      .gauge_dimension = ladder.gauge_dimension,
      .degrees_of_freedom = known(ladder.degrees_of_freedom),
      .dimension = system.manifold()->dimension(),
      .moved = ladder.moved,
      // Where nothing is consistent nothing has moved to be so.
      .moves = ladder.verdict == Verdict::inconsistent ? std::vector<Movement>() : ladder.moves,
      .is_ambiguous = ladder.is_ambiguous(),
      .doubts = ladder.doubts,
      .proof = ladder.proof,
      .reason = ladder.reason,
      .contradiction = ladder.contradiction};
  for (const LadderLevel& level : ladder.levels) {
    LadderReport::Level told{.k = level.k, .residual = level.residual};
    if (!level.is_empty) {
      const RankDecision* weakest = &level.all;
      for (const RankDecision* other : {&level.without_tangent, &level.without_point})
        if (other->gap < weakest->gap) weakest = other;
      told.dim_S = level.dim_S;
      told.dim_M = level.dim_M;
      told.fibre = level.fibre();
      told.gap = level.gap();
      told.smallest_counted = weakest->above;
      told.largest_neglected = weakest->below;
    }
    report.levels.push_back(told);
  }
  const auto& names = system.names().coordinates;
  for (Index i = 0; i < ladder.point.x.size(); ++i)
    report.consistent_point.emplace_back(names[static_cast<std::size_t>(i)], ladder.point.x[i]);
  return report;
}

std::vector<LadderReport::Dimensions> LadderReport::dimensions() const {
  std::vector<Dimensions> list;
  for (const Level& level : levels)
    if (const Dimensions pair(level.dim_S, level.dim_M); list.empty() || list.back() != pair)
      list.push_back(pair);
  return list;
}

LadderReport ladder_report(const ConstraintLadder& ladder, const ImplicitSystem& system) {
  return ladder_report(ladder, system, constraint_formulas(system, ladder));
}

LadderReport ladder_report(const ConstraintLadder& ladder, const ImplicitSystem& system,
                           const ConstraintFormulas& formulas) {
  LadderReport report = discrete_ladder_report(ladder, system);
  report.family = family(ladder, system);
  const bool has_end = ladder.index >= 0;
  if (!has_end && ladder.verdict != Verdict::inconsistent && ladder.verdict != Verdict::rank_change)
    return report;
  report.elimination = elimination(formulas, velocity_names(system));
  if (!has_end) return report;
  report.classes = classes(ladder, system);
  report.constraints = constraints(ladder, system);
  report.end = end(ladder, system, formulas);
  return report;
}

LadderReport up_to_level(LadderReport ladder, Index level) {
  const bool is_complete = ladder.index ? level > *ladder.index
                                        : ladder.levels.empty() || ladder.levels.back().k <= level;
  if (is_complete) return ladder;
  const auto beyond = [&](const auto& entry) { return entry.level > level; };
  std::erase_if(ladder.levels, [&](const LadderReport::Level& entry) { return entry.k > level; });
  if (ladder.constraints) std::erase_if(*ladder.constraints, beyond);
  if (ladder.elimination) {
    std::erase_if(ladder.elimination->formulas, beyond);
    std::erase_if(ladder.elimination->steps, beyond);
    std::erase_if(ladder.elimination->velocities, beyond);
  }
  ladder.end.reset();
  ladder.classes.reset();
  ladder.verdict = Verdict::not_reached;
  ladder.index.reset();
  ladder.degrees_of_freedom.reset();
  ladder.gauge_dimension = 0;
  ladder.contradiction.clear();
  ladder.reason = "Stopped at level " + std::to_string(level) + ", as asked.";
  return ladder;
}

}  // namespace courant
