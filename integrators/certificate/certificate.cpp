#include "courant/integrators/certificate/certificate.hpp"

#include <utility>

#include "courant/integrators/certificate/certificate_in_digits.hpp"
#include "courant/integrators/certificate/chart_equations.hpp"

namespace courant {

Certificate certificate(const std::shared_ptr<const ImplicitSystem>& system,
                        const InitialGuess& guess, const ConstraintAlgorithm::Options& options,
                        Decider decider) {
  const auto in_chart = std::make_shared<const ChartEquations>(system);
  const auto equations = equations_in_digits(in_chart, decider);
  if (equations && is_of_digits_alone(decider))
    return certificate_in_digits(*equations, guess, options, decider);
  ConstraintLadder by_bounds = ConstraintAlgorithm(options).run(in_chart, guess);
  return equations ? decided_together(std::move(by_bounds), *equations, guess, options) : by_bounds;
}

}  // namespace courant
