#include "courant/running/run_backend.hpp"

namespace courant {
namespace {

// Measured with lines of inductors and capacitors: code for 2,000 unknowns takes 15 s to compile, as long
// as some 20,000 steps of the interpreter.
constexpr Index kLargeSystem = 200;  // unknowns
constexpr long kManySteps = 20'000;

}  // namespace

Backend worthwhile(const Backend& asked, const Experiment& experiment) {
  const ImplicitSystem& system = *experiment.model.system;
  const bool is_large = system.manifold()->dimension() + system.auxiliary_size() > kLargeSystem;
  const bool is_short =
      experiment.time && !experiment.time->is_transformed() && experiment.time->steps < kManySteps;
  return asked == Backend::automatic && is_large && is_short ? Backend::interpreter : asked;
}

}  // namespace courant
