#include "courant/running/run_in_memory.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "courant/running/run_keeper.hpp"

namespace courant {
namespace {

class MemoryKeeper final : public RunKeeper {
 public:
  MemoryKeeper(const Experiment& experiment, bool has_curve, RunInMemory& run)
      : experiment_(experiment), has_curve_(has_curve), run_(run) {}

  void open(const RunOpening& opening) override {
    run_.rows.names = opening.columns;
    std::vector<std::string> columns = {"t"};
    columns.insert(columns.end(), opening.event_columns.begin(), opening.event_columns.end());
    for (const std::string& event : opening.events) run_.events[event].names = columns;
    ladder_ = opening.ladder;
    integrator_ = opening.integrator;
  }
  void append(double t, const std::optional<double>& tau,
              const Eigen::Ref<const VectorXd>& values) override {
    run_.rows.values.push_back(t);
    if (tau) run_.rows.values.push_back(*tau);
    run_.rows.values.insert(run_.rows.values.end(), values.begin(), values.end());
  }
  void append_event(const std::string& name, double t,
                    const Eigen::Ref<const VectorXd>& values) override {
    std::vector<double>& rows = run_.events.at(name).values;
    rows.push_back(t);
    rows.insert(rows.end(), values.begin(), values.end());
  }
  void see(const RunMoment& moment) override {
    if (!has_curve_) return;
    const TimeSpan* const time = experiment_.time ? &*experiment_.time : nullptr;
    State state = moment.step.after;
    state.t = moment.t;
    pieces_.push_back({.state = std::move(state),
                       .h = time ? time->step : 0.0,
                       .is_in_t = !time || !time->is_transformed()});
  }
  void close() override {
    if (has_curve_ && integrator_ && !pieces_.empty())
      run_.curve = std::make_shared<RunCurve>(experiment_, std::move(ladder_), integrator_,
                                              std::move(pieces_));
  }
  void tell(const RunSummary&) override {}

 private:
  const Experiment& experiment_;
  const bool has_curve_;
  RunInMemory& run_;
  ConstraintLadder ladder_;
  std::shared_ptr<const Integrator> integrator_;
  std::vector<RunCurve::Piece> pieces_;
};

}  // namespace

std::vector<double> RunTable::column(const std::string& name) const {
  const auto found = std::ranges::find(names, name);
  if (found == names.end())
    throw std::invalid_argument("RunTable::column: there is no column \"" + name + "\".");
  std::vector<double> column;
  column.reserve(rows());
  for (auto i = static_cast<std::size_t>(found - names.begin()); i < values.size();
       i += names.size())
    column.push_back(values[i]);
  return column;
}

RunInMemory run_in_memory(const Experiment& experiment, const RunInMemoryOptions& options) {
  RunInMemory result;
  if (const auto place = place_of_resets(experiment.events); place && options.has_curve)
    throw ExperimentError(
        *place,
        "jumps, and the curve of a run is one of steps without; expected rows, or "
        "events that set nothing");
  MemoryKeeper keeper(experiment, options.has_curve, result);
  result.outcome = run(experiment, keeper, options.run);
  return result;
}

}  // namespace courant
