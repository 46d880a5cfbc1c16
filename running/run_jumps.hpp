// RunJumps: steps of a run on which its state jumps.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "courant/integrators/step/integrator.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/running/event_watch.hpp"
#include "courant/running/observer_elsewhere.hpp"
#include "courant/running/restart.hpp"

namespace courant {

// Jumps at corners, as impulses make them, and where events set something. A step over jumps has the way before them,
// between them and behind them as its parts, and ends at its time. What jumps is said in warnings, the first times.
class RunJumps {
 public:
  // `first_reset`: as of Observer. All of them outlive this object.
  RunJumps(const Experiment& experiment, std::size_t first_reset, ObserverElsewhere& elsewhere,
           std::vector<std::string>& warnings);

  bool are_set_by_events() const { return resets_.has_value(); }

  // The step after step k, from `before`, over the corners of the time that are in it; nothing where there are none, or
  // no consistent state behind one.
  std::optional<Step> over_corners(const State& before, long k, const Integrator& integrator);

  // Step k, `whole`, where events in it set something: up to the first of these, the state behind it, the way on from
  // there with all that comes then. Nothing where none does. `prepare` is called with each stepper on the way. Throws
  // std::domain_error where there is no state behind an event, or the times of one accumulate.
  std::optional<Step> over_resets(const Step& whole, long k, const Integrator& integrator,
                                  EventWatch& events, const std::function<void(Stepper&)>& prepare);

 private:
  std::optional<State> beyond(const State& before, double corner);
  std::optional<EventWatch::Reset> reset_in(const Step& part, long k, EventWatch& events);
  State behind(EventWatch::Reset reset, EventWatch& events, Stepper& way);
  void tell_of_jump(const std::string& where, const Restart& behind);

  const Experiment& experiment_;
  ObserverElsewhere& elsewhere_;
  std::vector<std::string>& warnings_;
  std::optional<EventResets> resets_;  // where events set something
  int jumps_ = 0;
};

}  // namespace courant
