#include "courant/reading/method_in_units.hpp"

#include <cmath>
#include <utility>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/certificate/ladder_in_units.hpp"
#include "courant/integrators/methods/integrator_in_units.hpp"
#include "courant/integrators/step/kinetic_metric.hpp"
#include "courant/integrators/step/natural_units.hpp"

namespace courant {

namespace {

// Whether the masses of a kinetic energy, or the step, are so far from 1 that numbers may be far apart. Where there is
// no kinetic energy, the numbers of the start have to tell.
bool may_be_far_apart(const MethodSetting& at) {
  constexpr double far = 1e6, brief = 1e-9;
  const auto bundle = std::dynamic_pointer_cast<const CotangentBundle>(at.system->manifold());
  if (!bundle) return true;
  const auto metric =
      kinetic_metric(at.system, MomentumProjector::momenta_of(*bundle), at.ladder.point.x);
  if (!metric) return true;
  const VectorXd masses = values(metric->lower(constants(at.ladder.point.x))).diagonal();
  return masses.maxCoeff() > far || masses.minCoeff() < 1.0 / far || std::fabs(at.step) < brief ||
         std::fabs(at.step) > 1.0 / brief;
}

// The units of steps: those that are given, of the rest those that are needed; empty where both are none.
std::optional<Units> units_of_steps(const MethodSetting& at) {
  if (at.own || at.extension || at.ladder.point.x.size() == 0) return std::nullopt;
  auto needed = may_be_far_apart(at) ? needed_units(at.system, at.ladder.point) : std::nullopt;
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
