#include "courant/running/run_backend.hpp"

namespace courant {
namespace {

// Measured with 60 experiments of 50 to 24,000 steps: the compiler takes 0.3 s for the smallest and up to
// 23 s for a bicycle in space, 15 s for a line with 2,000 unknowns; the interpreter makes 20,000 steps of
// the first in a tenth of a second, and of the last two in 20 s.
constexpr long kManySteps = 20'000;

// What is compiled takes a part of a millisecond to write down and load.
constexpr long kSomeSteps = 1'000;

bool is_short(const Experiment& experiment, long alike) {
  if (!experiment.time || experiment.time->is_transformed()) return false;
  const long steps = experiment.time->steps;
  return steps < kSomeSteps || steps < (kManySteps + alike - 1) / alike;
}

}  // namespace

Backend worthwhile(const Backend& asked, const Experiment& experiment, long alike) {
  return asked == Backend::automatic && is_short(experiment, alike) ? Backend::interpreter : asked;
}

}  // namespace courant
