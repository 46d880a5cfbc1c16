#include "courant/reading/method_in_units.hpp"

#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/certificate/ladder_in_units.hpp"
#include "courant/integrators/methods/integrator_in_units.hpp"

namespace courant {

PreparedMethod prepared_in_units(const std::function<PreparedMethod(const MethodSetting&)>& prepare,
                                 const MethodSetting& at) {
  const auto units = at.own ? std::nullopt : needed_units(at.system, at.ladder.point);
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
