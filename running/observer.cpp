#include "courant/running/observer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/numbers/uncertain.hpp"
#include "courant/core/words/message.hpp"

namespace courant {

Observer::Observer(const Experiment& experiment, const ConstraintLadder& ladder, Backend backend)
    : Observer(ObservedQuantities(experiment, ladder), backend) {}

Observer::Observer(const ObservedQuantities& of, Backend backend)
    : names_(of.names),
      coordinate_count_(of.coordinate_count),
      first_constraint_(of.first_constraint),
      written_count_(of.written_count),
      first_event_(of.first_event),
      first_reset_(of.first_reset),
      stage_places_(of.stage_places),
      deviating_(of.deviating),
      asked_defects_(of.defects),
      defect_places_(of.defect_places),
      defects_(VectorXd::Zero(std::ssize(of.defects))),
      first_sensitivity_(of.first_sensitivity),
      sensitivity_count_(of.sensitivity_count),
      H_(of.H),
      balance_(of.balance),
      is_field_(of.is_field) {
  const Backend together = backend.together();
  const Function::Options compiled = {.differentiate = {}, .backend = together};
  forms_ = Function("closed forms", {of.time}, of.forms, compiled);
  form_ = VectorXd::Zero(of.forms.size());
  quantities_ = Function("observe", of.inputs, of.quantities, compiled);
  together.compile();
  if (H_) energy_ = Energy{of.quantities[*H_ - static_cast<Index>(coordinate_count_)], of.inputs};
  // Evaluated once a step; to compile it, and the account, takes seconds where ports are many.
  at_stage_ = Function("observe stages", of.stage_inputs, of.staged);
  stage_ = VectorXd::Zero(of.staged.size());  // of a state by itself there is no stage
  if (of.account) account_.emplace(StepEnergies(of.account));
  energies_ = VectorXd::Zero(of.inputs.back().variables.size());
  if (of.field) {
    field_ = std::make_unique<VectorField>(*of.field, backend);
    evaluate_field_.emplace(*field_);
  }
  row_ = VectorXd::Zero(static_cast<Index>(names_.size()));
}

const double* const* Observer::arguments(const State& state) {
  arguments_ = {state.x.data(), state.v.data(), state.z.data(),
                &state.t,       nullptr,        energies_.data()};
  if (evaluate_field_) {
    // From the values at the last state; where these are far, as after a diode began to conduct, from those that the step
    // ended with.
    if (!is_field_ || !evaluate_from_last(state)) (*evaluate_field_)(state, rate_);
    arguments_[4] = evaluate_field_->left_out().data();
  }
  if (is_field_) {
    arguments_[1] = evaluate_field_->v().data();
    arguments_[2] = evaluate_field_->z().data();
  }
  return arguments_.data();
}

bool Observer::evaluate_from_last(const State& state) {
  try {
    (*evaluate_field_)(state.x, rate_, state.t);
    return true;
  } catch (const std::domain_error&) {
    return false;
  }
}

EnergySizes Observer::energy_sizes(const State& state) {
  if (energy_) H_of_ = Function("H", energy_->inputs, ExprVector::Constant(1, energy_->H));
  energy_.reset();
  if (H_of_.output_size() == 0) return {};
  // Coordinates are rounded by about so many of the least part of the largest of them, in each step.
  constexpr double roundings = 4.0 * std::numeric_limits<double>::epsilon();
  // Next to such errors those of the evaluation itself are nothing.
  constexpr double large_error = 1e-8;
  constexpr Index rounded_groups = 3;  // x, v, z
  const double* const* in = arguments(state);
  const auto error_of_H = [&](double error, bool next_to_largest) {
    std::vector<std::vector<Uncertain>> groups(static_cast<std::size_t>(H_of_.input_count()));
    std::vector<const Uncertain*> pointers;
    for (Index g = 0; g < H_of_.input_count(); ++g) {
      std::vector<Uncertain>& group = groups[static_cast<std::size_t>(g)];
      const Index size = in[g] == nullptr ? 0 : H_of_.input_size(g);
      const Eigen::Map<const VectorXd> numbers(in[g], size);
      const double largest = size == 0 ? 0.0 : numbers.lpNorm<Eigen::Infinity>();
      for (const double number : numbers)
        group.emplace_back(number, g < rounded_groups
                                       ? error * (next_to_largest ? largest : std::fabs(number))
                                       : 0.0);
      pointers.push_back(group.data());
    }
    Uncertain H;
    H_of_.taylor_with_jacobian(pointers.data(), 0, &H);
    return std::isfinite(H.error) ? H.error : 0.0;
  };
  return {.terms = error_of_H(large_error, false) / large_error,
          .round_off = error_of_H(roundings, true)};
}

const VectorXd& Observer::row(const State& state) {
  measure(state);
  return compare(state.t);
}

void Observer::measure(const State& state) {
  const Index N = state.x.size();
  row_.head(N) = state.x;
  const double* const* in = arguments(state);
  quantities_.value(in, row_.data() + N);
  for (Index i = 0; i < defects_.size(); ++i)
    row_[defect_places_[static_cast<std::size_t>(i)]] = defects_[i];
  if (sensitivities_)
    row_.segment(first_sensitivity_, sensitivity_count_) = sensitivities_->values();
  for (Index i = 0; i < stage_.size(); ++i)
    row_[stage_places_[static_cast<std::size_t>(i)]] = stage_[i];
}

const VectorXd& Observer::compare(double t) {
  if (balance_) row_[*balance_] = account_->balance();
  if (form_.size() == 0) return row_;
  const double* time[] = {&t};
  forms_.value(time, form_.data());
  const Index first = row_.size() - form_.size();
  for (Index i = 0; i < form_.size(); ++i)
    row_[first + i] = std::fabs(row_[deviating_[static_cast<std::size_t>(i)]] - form_[i]);
  return row_;
}

void Observer::observe_stage(const State& at, const VectorXd& effort) {
  const double* in[] = {at.x.data(), at.v.data(), at.z.data(), &at.t, effort.data()};
  at_stage_.value(in, stage_.data());
}

const VectorXd& Observer::begin(const State& state) {
  if (stage_.size() > 0) {
    const Step none{.after = state, .stage = state};
    observe_stage(state, account_ ? account_->energies().effort(none) : VectorXd());
  }
  energies_.setZero();
  if (map_) {
    map_->begin(state.x);
    take_defects();
  }
  if (sensitivities_) sensitivities_->begin(state);
  measure(state);
  if (account_) account_->open(row_[*H_]);
  return compare(state.t);
}

const VectorXd& Observer::advance(const Step& step) {
  if (account_) {
    account_->enter(step);
    take_energies();
  }
  if (map_) {
    try {
      map_->advance(step);
      take_defects();
    } catch (const std::domain_error& error) {
      throw std::domain_error(
          "The step to t = " + number_text(step.after.t) +
          " has no tangent map, which the defects are of: " + without_place(error.what()));
    }
  }
  if (sensitivities_) sensitivities_->advance(step);
  if (stage_.size() > 0)
    observe_stage(step.stage, account_ ? account_->energies().effort(step) : VectorXd());
  measure(step.after);
  if (account_) account_->settle(row_[*H_]);
  return compare(step.after.t);
}

void Observer::take_energies() {
  const PowerAccount::Memory& memory = account_->memory();
  if (energies_.size() > 0)
    energies_ << account_->supplied(), account_->dissipated(), memory.supplied, memory.dissipated;
}

void Observer::take_defects() {
  constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
  const auto [symplecticity, volume] = map_->defects();
  for (Index i = 0; i < defects_.size(); ++i) {
    const bool is_volume = asked_defects_[static_cast<std::size_t>(i)] == Defect::volume;
    defects_[i] = (is_volume ? volume : symplecticity).value_or(undefined);
  }
}

Observer::Memory Observer::memory() const {
  Memory memory;
  if (account_) memory.power_account = account_->memory();
  if (map_) memory.tangent_map = map_->memory();
  if (sensitivities_) memory.sensitivities = sensitivities_->memory();
  return memory;
}

void Observer::recall(const Memory& memory) {
  if (account_ && memory.power_account) {
    account_->recall(*memory.power_account);
    take_energies();
  }
  if (map_ && memory.tangent_map) map_->recall(*memory.tangent_map);
  if (sensitivities_ && memory.sensitivities) sensitivities_->recall(*memory.sensitivities);
}

void Observer::restart(const State& state) {
  if (!evaluate_field_) return;
  evaluate_field_->forget();
  evaluate_field_->start(state);
}

}  // namespace courant
