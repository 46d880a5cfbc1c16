#include "courant/reading/method_in_units.hpp"

#include <cmath>
#include <utility>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/certificate/ladder_in_units.hpp"
#include "courant/integrators/methods/integrator_in_units.hpp"
#include "courant/integrators/step/kinetic_units.hpp"
#include "courant/integrators/step/natural_units.hpp"

namespace courant {

namespace {

using Masses = std::optional<VectorXd>;  // of a kinetic energy

// Whether the masses, or the step, are so far from 1 that numbers may be far apart. Where there is no kinetic energy,
// the numbers of the start have to tell.
bool may_be_far_apart(const Masses& masses, double step) {
  constexpr double far = 1e6, brief = 1e-9;
  if (!masses) return true;
  return masses->maxCoeff() > far || masses->minCoeff() < 1.0 / far || std::fabs(step) < brief ||
         std::fabs(step) > 1.0 / brief;
}

// Units by the kinetic energy, where its sizes are so far apart that constraints on positions are not seen beside large
// momenta, or the other way round (docs/steps.md has measurements).
std::optional<Units> units_by_kinetic_energy(const MethodSetting& at, const Masses& masses) {
  constexpr double far = 4096.0;
  if (at.ladder.constraints.empty() || !masses) return std::nullopt;
  const State& point = at.ladder.point;
  const VectorXd sizes = kinetic_sizes(*at.system->manifold(), *masses, point.x, at.step);
  if (!(sizes.minCoeff() > 0.0 && spread(sizes) > far)) return std::nullopt;
  return kinetic_units(at.system, point, sizes, at.step);
}

// The units of steps: those that are given, of the rest those that the numbers of the start need. Where none are given,
// those of the kinetic energy come before. Empty where all are none.
std::optional<Units> units_of_steps(const MethodSetting& at) {
  if (at.own || at.extension || at.ladder.point.x.size() == 0) return std::nullopt;
  const Masses masses = kinetic_masses(at.system, at.ladder.point.x);
  if (!at.nominal)
    if (auto units = units_by_kinetic_energy(at, masses)) return units;
  auto needed =
      may_be_far_apart(masses, at.step) ? needed_units(at.system, at.ladder.point) : std::nullopt;
  if (!at.nominal) return needed;
  VectorXd unknowns = VectorXd::Zero(at.system->auxiliary_size());
  unknowns.head(at.nominal->unknowns.size()) = at.nominal->unknowns;
  return units_by_sizes(at.system, at.ladder.point, at.nominal->coordinates, unknowns,
                        std::move(needed));
}

}  // namespace

PreparedMethod prepared_in_units(const std::function<PreparedMethod(const MethodSetting&)>& prepare,
                                 const MethodSetting& at) {
  const auto units = units_of_steps(at);
  if (!units) return prepare(at);
  const auto system = std::make_shared<const SystemInUnits>(at.system, *units);
  const State initial = units->measure(at.initial);
  // Anew, since equations are chosen by the size of their entries. Where bounds say something else in these units the
  // ladder is the one that was decided.
  ConstraintLadder ladder = ConstraintAlgorithm().run(
      system, {.t = initial.t, .x = initial.x, .v = initial.v, .z = initial.z});
  if (!are_alike(ladder, at.ladder)) {
    if (!at.nominal) return prepare(at);
    ladder = measured(at.ladder, *system);
  }
  PreparedMethod method = prepare({.system = system,
                                   .ladder = ladder,
                                   .initial = initial,
                                   .step = at.step,
                                   .backend = at.backend,
                                   .vocabulary = at.vocabulary});
  method.integrator = std::make_shared<IntegratorInUnits>(system, method.integrator);
  method.initial = units->restore(method.initial);
  return method;
}

MethodChoice with_nominal_sizes(MethodChoice choice, NominalSizes sizes) {
  choice.prepare = [prepare = std::move(choice.prepare),
                    sizes = std::move(sizes)](const MethodSetting& at) {
    MethodSetting setting = at;
    setting.nominal = &sizes;
    if (!at.plain) return prepare(setting);
    MethodSetting plain = *at.plain;
    plain.nominal = &sizes;
    setting.plain = &plain;
    return prepare(setting);
  };
  return choice;
}

}  // namespace courant
