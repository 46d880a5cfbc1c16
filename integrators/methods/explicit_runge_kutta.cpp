#include "courant/integrators/methods/explicit_runge_kutta.hpp"

#include <optional>
#include <stdexcept>
#include <vector>

#include "courant/core/words/message.hpp"
#include "courant/integrators/step/step_program.hpp"
#include "courant/integrators/step/vector_field_differential.hpp"

namespace courant {
namespace {

using Row = std::vector<std::optional<double>>;

// The 13 stages of Fehlberg's method of order 7(8), of which the weights are those of order 8.
StepProgram::Explicit fehlberg_tableau() {
  return {.times = {0.0, 2.0 / 27.0, 1.0 / 9.0, 1.0 / 6.0, 5.0 / 12.0, 1.0 / 2.0, 5.0 / 6.0,
                    1.0 / 6.0, 2.0 / 3.0, 1.0 / 3.0, 1.0, 0.0, 1.0},
          .rows = {{2.0 / 27.0},
                   {1.0 / 36.0, 1.0 / 12.0},
                   {1.0 / 24.0, 0.0, 1.0 / 8.0},
                   {5.0 / 12.0, 0.0, -25.0 / 16.0, 25.0 / 16.0},
                   {1.0 / 20.0, 0.0, 0.0, 1.0 / 4.0, 1.0 / 5.0},
                   {-25.0 / 108.0, 0.0, 0.0, 125.0 / 108.0, -65.0 / 27.0, 125.0 / 54.0},
                   {31.0 / 300.0, 0.0, 0.0, 0.0, 61.0 / 225.0, -2.0 / 9.0, 13.0 / 900.0},
                   {2.0, 0.0, 0.0, -53.0 / 6.0, 704.0 / 45.0, -107.0 / 9.0, 67.0 / 90.0, 3.0},
                   {-91.0 / 108.0, 0.0, 0.0, 23.0 / 108.0, -976.0 / 135.0, 311.0 / 54.0,
                    -19.0 / 60.0, 17.0 / 6.0, -1.0 / 12.0},
                   {2383.0 / 4100.0, 0.0, 0.0, -341.0 / 164.0, 4496.0 / 1025.0, -301.0 / 82.0,
                    2133.0 / 4100.0, 45.0 / 82.0, 45.0 / 164.0, 18.0 / 41.0},
                   {3.0 / 205.0, 0.0, 0.0, 0.0, 0.0, -6.0 / 41.0, -3.0 / 205.0, -3.0 / 41.0,
                    3.0 / 41.0, 6.0 / 41.0, 0.0},
                   {-1777.0 / 4100.0, 0.0, 0.0, -341.0 / 164.0, 4496.0 / 1025.0, -289.0 / 82.0,
                    2193.0 / 4100.0, 51.0 / 82.0, 33.0 / 164.0, 12.0 / 41.0, 0.0, 1.0},
                   {0.0, 0.0, 0.0, 0.0, 0.0, 34.0 / 105.0, 9.0 / 35.0, 9.0 / 35.0, 9.0 / 280.0,
                    9.0 / 280.0, 0.0, 41.0 / 840.0, 41.0 / 840.0}}};
}

StepProgram::Explicit tableau_of(ExplicitRungeKutta::Kind kind, const VectorFieldFormulas& field) {
  using Kind = ExplicitRungeKutta::Kind;
  StepProgram::Explicit tableau;
  switch (kind) {
    case Kind::midpoint:
      tableau = {.times = {0.0, 0.5}, .rows = {{0.5}, {0.0, 1.0}}};
      break;
    case Kind::classical:
      tableau = {
          .times = {0.0, 0.5, 0.5, 1.0},
          .rows = {
              {0.5}, {0.0, 0.5}, {0.0, 0.0, 1.0}, {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0}}};
      break;
    case Kind::dormand_prince:
      tableau = {.times = {0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0},
                 .rows = {{1.0 / 5.0},
                          {3.0 / 40.0, 9.0 / 40.0},
                          {44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0},
                          {19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0},
                          {9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0,
                           -5103.0 / 18656.0},
                          {35.0 / 384.0, std::nullopt, 500.0 / 1113.0, 125.0 / 192.0,
                           -2187.0 / 6784.0, 11.0 / 84.0}},
                 .keeps_rate = true};
      break;
    case Kind::fehlberg:
      tableau = fehlberg_tableau();
      break;
  }
  tableau.field = &field;
  return tableau;
}

class Trajectory final : public Stepper {
 public:
  Trajectory(std::shared_ptr<const VectorField> field, const std::string& name,
             StepProgram::Explicit tableau)
      : Stepper(name, field->system()),
        field_(std::move(field)),
        evaluate_(*field_),
        tableau_(std::move(tableau)),
        rates_(tableau_.times.size()) {}

 private:
  // The method may keep the rate at the end of its last step for the next one.
  void do_prepare(State& state, double) override {
    knows_rate_ = false;
    evaluate_.start(state);
  }

  bool do_keeps_to_manifold() const override { return false; }

  void do_step(const State& before, double h, State& after) override {
    const auto evaluate = [&](const VectorXd& x, double t, VectorXd& rate) {
      rate.resize(x.size());
      evaluate_(x, rate, t);
      stage_.t = t;
      stage_.x = x;
    };
    try {
      if (!knows_rate_) evaluate(before.x, before.t, rates_[0]);
      for (std::size_t i = 1; i < rates_.size(); ++i) {
        combine(before.x, h, tableau_.rows[i - 1], x_);
        evaluate(x_, before.t + tableau_.times[i] * h, rates_[i]);
      }
      combine(before.x, h, tableau_.rows.back(), after.x);
      knows_rate_ = tableau_.keeps_rate;
      if (knows_rate_) evaluate(after.x, before.t + h, rates_[0]);
    } catch (const std::domain_error& error) {
      throw SolveError(SolveError::Reason::singular, method(), before.t, h,
                       "cannot be made: " + without_place(error.what()));
    }
    after.v = stage_.v = evaluate_.v();
    after.z = stage_.z = evaluate_.z();
  }

  // sum = x + h Σ row_j K_j, one term after the other.
  void combine(const VectorXd& x, double h, const Row& row, VectorXd& sum) const {
    sum = x;
    for (std::size_t j = 0; j < row.size(); ++j)
      if (row[j]) sum += (h * *row[j]) * rates_[j];
  }

  void do_keep(const State&, const State&) override {
    evaluate_.keep();
    kept_stage_.swap(stage_);
  }
  void do_stage(Step& step) const override { step.stage = kept_stage_; }
  void do_discard() override {
    knows_rate_ = false;
    evaluate_.discard();
  }
  void do_forget() override {
    knows_rate_ = false;
    evaluate_.forget();
  }
  std::unique_ptr<Stepper> do_fresh() const override {
    return std::make_unique<Trajectory>(field_, method(), tableau_);
  }

  std::shared_ptr<const VectorField> field_;
  VectorField::Evaluation evaluate_;
  StepProgram::Explicit tableau_;
  std::vector<VectorXd> rates_;  // K_i
  bool knows_rate_ = false;      // whether K_0 is that of the next step already
  VectorXd x_;                   // where a stage is evaluated
  State stage_, kept_stage_;     // of the step that is made, and of the last that stands
};

}  // namespace

ExplicitRungeKutta::ExplicitRungeKutta(std::shared_ptr<const VectorField> field, Kind kind)
    : Integrator(field ? field->system() : nullptr), field_(std::move(field)), kind_(kind) {}

std::string ExplicitRungeKutta::name() const {
  switch (kind_) {
    case Kind::midpoint:
      return "rk2";
    case Kind::classical:
      return "rk4";
    case Kind::dormand_prince:
      return "dopri5";
    case Kind::fehlberg:
      break;
  }
  return "rkf78";
}

int ExplicitRungeKutta::order() const {
  switch (kind_) {
    case Kind::midpoint:
      return 2;
    case Kind::classical:
      return 4;
    case Kind::dormand_prince:
      return 5;
    case Kind::fehlberg:
      break;
  }
  return 8;
}

StepProgram ExplicitRungeKutta::program() const {
  const SpaceFormulas space(*system()->manifold());
  if (space.has_basis() || space.has_equations())
    throw std::invalid_argument(name() + " leaves " + system()->manifold()->name() +
                                ", where its steps are known as formulas to no program; expected a "
                                "system on Rⁿ or a torus");
  StepProgram program{.method = name()};
  program.explicit_steps = tableau_of(kind_, field_->formulas());
  return program;
}

// The stages are evaluated again, with their differentials:
//   K_i = DX(x_i) (V + h Σ_{j<i} a_ij K_j),   TΦ_h V = V + h Σ b_j K_j
class ExplicitRungeKutta::Differential final : public StepDifferential {
 public:
  explicit Differential(const ExplicitRungeKutta& method)
      : method_(method), differential_(method.field_->formulas()) {}

 private:
  MatrixXd do_images(const Step& step, const MatrixXd& V) const override {
    const StepProgram::Explicit tableau = tableau_of(method_.kind_, method_.field_->formulas());
    VectorField::Evaluation evaluate(*method_.field_);
    evaluate.start(step.before);
    std::vector<VectorXd> rates;
    std::vector<MatrixXd> images;
    const auto combined = [&](const auto& start, const auto& terms, std::size_t row) {
      auto sum = start;
      for (std::size_t j = 0; j < tableau.rows[row].size(); ++j)
        if (tableau.rows[row][j]) sum += step.h * *tableau.rows[row][j] * terms[j];
      return sum;
    };
    for (std::size_t i = 0; i < tableau.times.size(); ++i) {
      const VectorXd x = i == 0 ? step.before.x : combined(step.before.x, rates, i - 1);
      const double t = step.before.t + tableau.times[i] * step.h;
      VectorXd rate(x.size());
      evaluate(x, rate, t);
      rates.push_back(rate);
      images.push_back(differential_({x, t, evaluate.unknowns(), evaluate.basis()},
                                     i == 0 ? V : combined(V, images, i - 1))
                           .rate);
    }
    return combined(V, images, tableau.times.size() - 1);
  }

  // By the images of a basis.
  MatrixXd do_pull_back(const Step& step, const MatrixXd& Lambda) const override {
    const Manifold& M = *method_.system()->manifold();
    const MatrixXd basis = (M.frame(step.before.x) * M.tangent_basis(step.before.x)).matrix();
    return pull_back_by(basis, do_images(step, basis), Lambda);
  }

  const ExplicitRungeKutta method_;  // its functions are shared, not copied
  VectorFieldDifferential differential_;
};

std::shared_ptr<const StepDifferential> ExplicitRungeKutta::do_differential() const {
  return std::make_shared<Differential>(*this);
}

std::unique_ptr<Stepper> ExplicitRungeKutta::do_stepper() const {
  return std::make_unique<Trajectory>(field_, name(), tableau_of(kind_, field_->formulas()));
}

}  // namespace courant
