#include "courant/running/first_guess.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "courant/core/words/message.hpp"
#include "courant/running/solved_unknowns.hpp"
#include "courant/running/undefined_formula.hpp"

namespace courant {
namespace {

// Unknowns that were given nothing are tried at 0; where these divide, or are under a root, elsewhere.
void place_unknowns(const Experiment& experiment, InitialGuess& guess) {
  constexpr Index most = 200;
  const ImplicitSystem& system = *experiment.model.system;
  const Index m = system.auxiliary_size();
  if (m == 0 || m > most) return;
  const VectorXd v =
      guess.v.size() > 0 ? guess.v : VectorXd::Zero(system.manifold()->tangent_dimension());
  const VectorXd z = guess.z.size() > 0 ? guess.z : system.auxiliary_guess(guess.x, guess.v);
  std::vector<Index> open;
  // Unknowns without names cannot be given.
  const Flags& given = experiment.initial.z.given;
  for (Index i = 0; i < m; ++i)
    if (i >= given.size() || !given[i]) open.push_back(i);
  const auto defined =
      defined_unknowns(system, {.t = guess.t, .x = guess.x, .v = v, .z = z}, std::move(open));
  if (defined && *defined != z) guess.z = *defined;
}

void check_finite(const Experiment& experiment, const InitialGuess& guess) {
  const ImplicitSystem& system = *experiment.model.system;
  const VectorXd v =
      guess.v.size() > 0 ? guess.v : VectorXd::Zero(system.manifold()->tangent_dimension());
  const VectorXd z = guess.z.size() > 0 ? guess.z : system.auxiliary_guess(guess.x, guess.v);
  const VectorXd residual = system.residual(guess.x, v, z, guess.t);
  for (Index i = 0; i < residual.size(); ++i)
    if (!std::isfinite(residual[i])) {
      const std::string where = "at the initial values" + with_zeros(experiment);
      const std::string why =
          undefined_formula(experiment, {.t = guess.t, .x = guess.x, .v = v, .z = z}, where);
      throw ExperimentError("/initial", !why.empty() ? why
                                                     : equation_in_words(system, i) + " is " +
                                                           number_text(residual[i]) + ' ' + where +
                                                           "; expected a finite number");
    }
}

}  // namespace

std::string with_zeros(const Experiment& experiment) {
  return experiment.initial.x.given.all() ? "" : " (with 0 for what is not given)";
}

const Manifold& manifold_near_start(const Experiment& experiment) {
  const Manifold& M = *experiment.model.system->manifold();
  try {
    M.project(experiment.initial.x.values);
    return M;
  } catch (const std::domain_error& error) {
    throw ExperimentError("/initial", "no point of " + M.name() + " is near the initial values" +
                                          with_zeros(experiment) + ": " +
                                          without_place(error.what()));
  }
}

InitialGuess first_guess(const Experiment& experiment, const LinearMap<double>& coframe) {
  const InitialValues& initial = experiment.initial;
  InitialGuess guess{.t = experiment.start(), .x = initial.x.values};
  if (initial.velocity.given.any()) guess.v = coframe * initial.velocity.values;
  if (initial.z.given.any()) guess.z = initial.z.values;
  place_unknowns(experiment, guess);
  check_finite(experiment, guess);
  return guess;
}

}  // namespace courant
