#include "courant/running/run_failure.hpp"

#include <cmath>
#include <stdexcept>

#include "courant/core/words/message.hpp"
#include "courant/running/undefined_formula.hpp"

namespace courant {

std::string failure_in_words(const SolveError& error, const Experiment& experiment,
                             const ConstraintLadder& ladder, const State& state) {
  const std::string what = error.what();
  const std::string why = undefined_ahead(experiment, ladder, state, experiment.time->step);
  if (why.empty()) {
    const ImplicitSystem& system = *experiment.model.system;
    const std::string corner = corner_in_words(what, system, ladder);
    const bool has_corners =
        experiment.time->division && !experiment.time->division->corners.empty();
    const bool is_cut_off = error.reason() == SolveError::Reason::disconnected && !has_corners;
    return what + (corner.empty() && is_cut_off ? condition_on_time_in_words(system) : corner);
  }
  // What it expected is not to be had; what it advises is.
  const std::size_t expected = what.rfind("; ");
  return (expected == std::string::npos ? what + " The cause: " : what.substr(0, expected) + ": ") +
         why + ".";
}

void require_finite(Observer& observer, const Experiment& experiment, const State& initial) {
  VectorXd row;
  try {
    row = observer.row(initial);
  } catch (const std::domain_error& error) {
    throw ExperimentError("/initial", without_place(error.what()));
  }
  for (Index i = 0; i < static_cast<Index>(observer.written_count()); ++i)
    if (!std::isfinite(row[i])) {
      const std::string where = "at the initial point";
      const std::string why = undefined_formula(experiment, initial, where);
      throw ExperimentError("/initial", !why.empty()
                                            ? why
                                            : observer.names()[static_cast<std::size_t>(i)] +
                                                  " is " + number_text(row[i]) + ' ' + where +
                                                  "; expected a finite number");
    }
}

}  // namespace courant
