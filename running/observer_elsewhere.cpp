#include "courant/running/observer_elsewhere.hpp"

namespace courant {

Observer& ObserverElsewhere::at(const State& state) {
  if (!own_) {
    own_.emplace(experiment_, ladder_, Backend::interpreter);
    if (const TangentMap* map = of_.tangent_map()) own_->follow(*map);
    if (const RunSensitivities* sensitivities = of_.sensitivities()) own_->follow(*sensitivities);
  }
  own_->restart(state);
  return *own_;
}

const VectorXd& ObserverElsewhere::row_within(const Step& part) {
  Observer& observer = at(part.after);
  observer.recall(before_);
  return observer.advance(part);
}

}  // namespace courant
