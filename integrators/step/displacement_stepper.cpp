#include "courant/integrators/step/displacement_stepper.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace courant {

DisplacementStepper::DisplacementStepper(std::string method,
                                         std::shared_ptr<const ImplicitSystem> system,
                                         const Formulas& formulas)
    : Stepper(std::move(method), std::move(system)),
      advance_(formulas.advance),
      projection_(formulas.constraint),
      m_(this->system().auxiliary_size()),
      contained_(formulas.contained),
      contains_all_(std::ssize(contained_) == manifold().ambient_dimension()),
      solver_(formulas.equations, {formulas.displacements, m_}, this->method(), formulas.whole,
              {.displacements = formulas.displacements, .h = formulas.h}),
      predictor_({formulas.displacements, m_}, solver_.predicted()),
      next_(advance_.output_size()),
      kept_(next_) {}

double DisplacementStepper::size_of(const VectorXd& x) const {
  if (contains_all_) return largest(x);
  double size = 0.0;
  for (const Index i : contained_) size = std::max(size, std::fabs(x[i]));
  return size > 0.0 ? size : largest(x);
}

void DisplacementStepper::make_step(const Inputs& in, const State& before, double h, State& after) {
  VectorXd& y = solver_.unknown();
  const auto begin = [&] {
    do_begin(before, h, y);
    y.tail(m_) = before.z;
  };
  if (predictor_.is_empty())
    begin();
  else
    predictor_.predict(y);
  const double size = size_of(before.x);
  const double scales[] = {size, auxiliary_scale(largest(before.z), size)};
  solver_.solve_connected(in, scales, begin, {before.t, h}, statistics_);

  advance_.value(in.data(), next_.data());
  const auto take = [](const double* numbers, Index count, VectorXd& to) {
    to.resize(count);
    copy_pairs(numbers, count, to.data());
  };
  take(next_.data(), before.x.size(), after.x);
  take(next_.data() + before.x.size(), before.v.size(), after.v);
  take(y.data() + (y.size() - m_), m_, after.z);
  projection_.apply(after.x);
}

void DisplacementStepper::do_keep(const State&, const State&) {
  if (!solver_.is_determined()) predictor_.limit_degree(Predictor::kUndetermined);
  predictor_.record(solver_.unknown());
  solver_.keep();
  kept_.swap(next_);
}

void DisplacementStepper::do_accompany(std::span<const Companion> companions) {
  for (const Companion& of : companions) {
    if (of.at_stage == 0.0) continue;
    const auto& other = dynamic_cast<const DisplacementStepper&>(*of.stepper);
    VectorXd times = VectorXd::Constant(solver_.unknown().size(), of.at_stage);
    times.head(times.size() - m_) *= of.ratio;
    predictor_.learn_from(other.predictor_, times);
  }
}

void DisplacementStepper::do_forget() {
  solver_.forget();
  predictor_.forget();
}

}  // namespace courant
