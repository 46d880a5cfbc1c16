#include "courant/python/step_inputs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "courant/integrators/methods/integrator_adaptor.hpp"
#include "courant/integrators/step/step_parts.hpp"
#include "courant/reading/findings.hpp"

namespace courant::python {
namespace {

constexpr int kMostTurns = 100;
// A turn that changes u by less, next to its greatest entry, is the last: some roundings of a step.
constexpr double kSettled = 1e-13;
// Functions in single precision do not come closer than their rounding: changes that become no smaller in so many turns,
// and are below this next to u, a hundred roundings of 6e-8, are that. So are those of a sum near zero, which are as great
// as u itself, but move the state by some roundings only.
constexpr int kIdleTurns = 4;
constexpr double kNoise = 6e-6;
constexpr double kNoiseOfState = 1e-14;
// The stage of a method of order 2 is in the middle of its step, up to roundings of the time: steps of several stages,
// of which only the last is known, would be of order 1 with a function in them.
constexpr double kOffMiddle = 1e-6;

class IntegratorWithInputs final : public IntegratorAdaptor {
 public:
  IntegratorWithInputs(const std::shared_ptr<const Integrator>& method, const StepInputs& inputs)
      : IntegratorAdaptor("IntegratorWithInputs", method->system(), method->system(), method) {
    const std::vector<std::string>& coordinates = system()->names().coordinates;
    for (const std::string& name : inputs.names) {
      const auto found = std::find(coordinates.begin(), coordinates.end(), name);
      if (found == coordinates.end())
        throw std::invalid_argument("the input " + name + " is no coordinate of the system");
      places_.push_back(found - coordinates.begin());
    }
    const py::gil_scoped_acquire locked;
    ask_ = held((*inputs.ask_of)(coordinates, system()->names().auxiliary));
  }

  std::optional<bool> is_symplectic() const override { return std::nullopt; }
  bool has_exact_energy() const override { return false; }

 private:
  class Trajectory;

  std::unique_ptr<Stepper> do_stepper() const override;
  // Formulas of the other method say nothing of the function.
  std::vector<StepFormulas> do_formulas() const override { return {}; }

  std::shared_ptr<py::object> ask_;
  std::vector<Index> places_;
};

class IntegratorWithInputs::Trajectory final : public Stepper {
 public:
  Trajectory(std::shared_ptr<const Integrator> method, std::shared_ptr<py::object> ask,
             std::vector<Index> places)
      : Stepper(method->name(), method->system()),
        method_of_steps_(std::move(method)),
        ask_(std::move(ask)),
        places_(std::move(places)),
        stepper_(method_of_steps_->stepper()) {}

 private:
  void do_prepare(State& state, double h) override { stepper_->prepare(state, h); }

  void do_step(const State& before, double h, State& after) override {
    const double end = after.t;
    State begin = before;
    VectorXd u(static_cast<Index>(places_.size()));
    for (Index k = 0; k < u.size(); ++k) u[k] = before.x[place(k)];
    const double size_before = u.lpNorm<Eigen::Infinity>();
    double least = std::numeric_limits<double>::infinity();
    int idle = 0;
    VectorXd reached;
    for (int turn = 0; turn < kMostTurns; ++turn) {
      for (Index k = 0; k < u.size(); ++k) begin.x[place(k)] = u[k];
      after = begin;
      {
        const CountedWork counted(statistics_, *stepper_);
        stepper_->step(after, h, end);
      }
      const State& stage = stepper_->last().stage;
      if (method_of_steps_->order() >= 2 &&
          std::fabs(stage.t - (before.t + 0.5 * h)) > kOffMiddle * std::fabs(h))
        throw ExperimentError(
            "/method",
            "makes steps of several stages, but a numeric function has one value in a step; "
            "expected "
            "\"discretize-first\" or \"constrain-first\" with the midpoint rule or another map "
            "whose stage is in the middle, without \"order\" and \"damping\", or \"rk2\"");
      const VectorXd next = asked(stage, before.t, h);
      const double difference = (next - u).lpNorm<Eigen::Infinity>();
      const double size = std::max(next.lpNorm<Eigen::Infinity>(), size_before);
      if (difference <= kSettled * size) return;
      idle = difference < 0.9 * least ? 0 : idle + 1;
      least = std::min(least, difference);
      VectorXd here = after.x;
      for (Index k = 0; k < u.size(); ++k) here[place(k)] = 0.0;
      if (idle >= kIdleTurns &&
          (difference <= kNoise * size || (here - reached).lpNorm<Eigen::Infinity>() <=
                                              kNoiseOfState * here.lpNorm<Eigen::Infinity>()))
        return;
      reached = std::move(here);
      u = next;
    }
    throw SolveError(SolveError::Reason::diverged, method(), before.t, h,
                     "has a numeric function in it whose values still change after " +
                         std::to_string(kMostTurns) +
                         " turns: it changes too much within a step for fixed point iteration. A "
                         "shorter step, or the function as formulas, does without.");
  }

  VectorXd asked(const State& stage, double t, double h) const {
    VectorXd answer;
    {
      const py::gil_scoped_acquire locked;
      answer = (*ask_)(stage.t, stage.x, stage.v, stage.z).cast<VectorXd>();
    }
    if (!answer.allFinite())
      throw SolveError(SolveError::Reason::singular, method(), t, h,
                       "has a numeric function in it that is not finite there.");
    return answer;
  }

  void do_keep(const State&, const State&) override { parts_.keep(stepper_->last(), 0); }
  void do_stage(Step& step) const override { parts_.tell(step); }
  void do_discard() override { do_forget(); }
  void do_forget() override { stepper_->forget(); }
  // The method itself asks.
  bool do_keeps_to_manifold() const override { return false; }
  std::unique_ptr<Stepper> do_fresh() const override {
    return std::make_unique<Trajectory>(method_of_steps_, ask_, places_);
  }

  Index place(Index k) const { return places_[static_cast<std::size_t>(k)]; }

  std::shared_ptr<const Integrator> method_of_steps_;
  std::shared_ptr<py::object> ask_;
  std::vector<Index> places_;
  std::unique_ptr<Stepper> stepper_;
  StepParts parts_;
};

std::unique_ptr<Stepper> IntegratorWithInputs::do_stepper() const {
  return std::make_unique<Trajectory>(wrapped(), ask_, places_);
}

}  // namespace

std::shared_ptr<const Integrator> with_inputs(const std::shared_ptr<const Integrator>& method,
                                              const StepInputs& inputs) {
  return std::make_shared<IntegratorWithInputs>(method, inputs);
}

void bind_step_inputs(py::module_& module) {
  py::class_<StepInputs>(module, "StepInputs")
      .def(py::init([](std::vector<std::string> names, py::object ask_of) {
        return StepInputs{std::move(names), held(std::move(ask_of))};
      }))
      .def_readonly("names", &StepInputs::names);
}

}  // namespace courant::python
