#include "courant/integrators/certificate/certificate.hpp"

#include "courant/integrators/certificate/certificate_in_digits.hpp"

namespace courant {

Certificate certificate(const std::shared_ptr<const ImplicitSystem>& system,
                        const InitialGuess& guess, const ConstraintAlgorithm::Options& options,
                        Decider decider) {
  if (const auto equations = equations_in_digits(system, decider))
    if (auto found = decided_in_digits(*equations, guess, options, decider))
      return *std::move(found);
  return ConstraintAlgorithm(options).run(system, guess);
}

}  // namespace courant
