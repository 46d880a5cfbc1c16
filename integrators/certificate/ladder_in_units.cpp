#include "courant/integrators/certificate/ladder_in_units.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace courant {
namespace {

// What is 1 of the coordinate, velocity or unknown of this name.
double unit_of(const std::string& name, const ImplicitSystem& system, const Units& units) {
  const auto place = [&](const std::vector<std::string>& names, const std::string& sought) {
    const auto found = std::ranges::find(names, sought);
    return found == names.end() ? Index{-1} : static_cast<Index>(found - names.begin());
  };
  const ImplicitSystem::Names& names = system.names();
  if (const Index i = place(names.coordinates, name); i >= 0) return units.coordinates[i];
  if (const Index i = place(names.auxiliary, name); i >= 0) return units.auxiliary[i];
  if (name.ends_with('\''))
    if (const Index i = place(names.coordinates, name.substr(0, name.size() - 1)); i >= 0)
      return units.tangent[i] / units.time;
  // As velocities are called that are not those of a coordinate each.
  for (Index i = 0; i < units.tangent.size(); ++i)
    if (name == "v[" + std::to_string(i) + "]") return units.tangent[i] / units.time;
  return 1.0;
}

// What takes a state that was restored back to what was measured.
Units inverse(const Units& units) {
  return {.coordinates = units.coordinates.cwiseInverse(),
          .tangent = units.tangent.cwiseInverse(),
          .auxiliary = units.auxiliary.cwiseInverse(),
          .equations = units.equations.cwiseInverse(),
          .time = 1.0 / units.time};
}

void restore(Combination& combination, const Units& units) {
  for (Combination::Term& term : combination.terms)
    term.coefficient *=
        std::pow(units.time, static_cast<double>(term.derivative)) / units.equations[term.equation];
}

// With all numbers times these units.
ConstraintLadder in_units(ConstraintLadder ladder, const ImplicitSystem& system,
                          const Units& units) {
  if (ladder.point.x.size() > 0) ladder.point = units.restore(ladder.point);
  // (ξ_0, ξ_1, z_0, ξ_2, z_1, …), coefficients of powers of time.
  const Index n = system.manifold()->dimension(), m = units.auxiliary.size();
  const VectorXd chart =
      ladder.jet.size() >= n ? chart_units(units, *system.manifold(), ladder.point.x) : VectorXd();
  if (ladder.jet.size() >= n) ladder.jet.head(n).array() *= chart.array();
  double power = 1.0;
  for (Index place = n; place + n + m <= ladder.jet.size(); place += n + m) {
    ladder.jet.segment(place + n, m).array() *= units.auxiliary.array() * power;
    power /= units.time;
    ladder.jet.segment(place, n).array() *= chart.array() * power;
  }
  for (Movement& move : ladder.moves) {
    const double unit = unit_of(move.name, system, units);
    move.from *= unit;
    move.to *= unit;
  }
  for (PointConstraint& constraint : ladder.constraints) {
    constraint.gradient.array() /= units.tangent.array();
    constraint.gradient_error.array() /= units.tangent.array();
    restore(constraint.origin, units);
  }
  for (Combination& redundancy : ladder.redundancies) restore(redundancy, units);
  if (ladder.gauge_directions.rows() == units.tangent.size())
    ladder.gauge_directions = units.tangent.asDiagonal() * ladder.gauge_directions;
  return ladder;
}

}  // namespace

ConstraintLadder restored(ConstraintLadder measured, const SystemInUnits& system) {
  return in_units(std::move(measured), system, system.units());
}

ConstraintLadder measured(ConstraintLadder ladder, const SystemInUnits& system) {
  return in_units(std::move(ladder), system, inverse(system.units()));
}

bool are_alike(const ConstraintLadder& a, const ConstraintLadder& b) {
  return a.verdict == b.verdict && a.index == b.index &&
         std::ranges::equal(a.levels, b.levels, [](const LadderLevel& c, const LadderLevel& d) {
           return c.dim_S == d.dim_S && c.dim_M == d.dim_M;
         });
}

}  // namespace courant
