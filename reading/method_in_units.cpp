#include "courant/reading/method_in_units.hpp"

#include <cmath>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/certificate/ladder_in_units.hpp"
#include "courant/integrators/methods/integrator_in_units.hpp"
#include "courant/integrators/step/kinetic_metric.hpp"

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

}  // namespace

PreparedMethod prepared_in_units(const std::function<PreparedMethod(const MethodSetting&)>& prepare,
                                 const MethodSetting& at) {
  const auto units =
      at.own || at.extension || at.ladder.point.x.size() == 0 || !may_be_far_apart(at)
          ? std::nullopt
          : needed_units(at.system, at.ladder.point);
  if (!units) return prepare(at);
  const auto system = std::make_shared<const SystemInUnits>(at.system, *units);
  const State initial = units->measure(at.initial);
  const ConstraintLadder ladder = ConstraintAlgorithm().run(
      system, {.t = initial.t, .x = initial.x, .v = initial.v, .z = initial.z});
  if (!are_alike(ladder, at.ladder)) return prepare(at);
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

}  // namespace courant
