#include "courant/integrators/explicit_runge_kutta.hpp"

#include <boost/numeric/odeint/algebra/vector_space_algebra.hpp>
#include <boost/numeric/odeint/external/eigen/eigen_resize.hpp>
#include <boost/numeric/odeint/stepper/explicit_generic_rk.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <stdexcept>

#include "courant/core/message.hpp"
#include "courant/integrators/vector_field_differential.hpp"

namespace courant {
namespace {

namespace odeint = boost::numeric::odeint;
using Algebra = odeint::vector_space_algebra;
template <int stages, int order>
using Generic =
    odeint::explicit_generic_rk<stages, order, VectorXd, double, VectorXd, double, Algebra>;

// The 13 stages of the method of order 8, as odeint has them.
StepProgram::Explicit fehlberg_tableau() {
  StepProgram::Explicit tableau;
  const odeint::rk78_coefficients_c<double> times;
  tableau.times.assign(times.begin(), times.end());
  const auto add_row = [&](const auto& row) { tableau.rows.emplace_back(row.begin(), row.end()); };
  add_row(odeint::rk78_coefficients_a1<double>());
  add_row(odeint::rk78_coefficients_a2<double>());
  add_row(odeint::rk78_coefficients_a3<double>());
  add_row(odeint::rk78_coefficients_a4<double>());
  add_row(odeint::rk78_coefficients_a5<double>());
  add_row(odeint::rk78_coefficients_a6<double>());
  add_row(odeint::rk78_coefficients_a7<double>());
  add_row(odeint::rk78_coefficients_a8<double>());
  add_row(odeint::rk78_coefficients_a9<double>());
  add_row(odeint::rk78_coefficients_a10<double>());
  add_row(odeint::rk78_coefficients_a11<double>());
  add_row(odeint::rk78_coefficients_a12<double>());
  add_row(odeint::rk78_coefficients_b<double>());
  return tableau;
}

// The explicit midpoint rule by its tableau: c = (0, ½), a₂₁ = ½, b = (0, 1).
class Midpoint : public Generic<2, 2> {
 public:
  Midpoint()
      : Generic<2, 2>(coef_a_type(boost::array<double, 1>{{0.5}}), {{0.0, 1.0}}, {{0.0, 0.5}}) {}
};

template <class Method>
class Trajectory final : public Stepper {
 public:
  Trajectory(std::shared_ptr<const VectorField> field, const std::string& name)
      : Stepper(name, field->system()), field_(std::move(field)), evaluate_(*field_) {}

 private:
  // The method may keep the rate at the end of its last step for the next one.
  void do_prepare(State& state, double) override {
    method_ = Method();
    evaluate_.start(state);
  }

  bool do_keeps_to_manifold() const override { return false; }

  void do_step(const State& before, double h, State& after) override {
    const auto rate = [&](const VectorXd& x, VectorXd& dx, double t) {
      evaluate_(x, dx, t);
      stage_.t = t;
      stage_.x = x;
    };
    after.x = before.x;
    try {
      method_.do_step(rate, after.x, before.t, h);
    } catch (const std::domain_error& error) {
      throw SolveError(SolveError::Reason::singular, method(), before.t, h,
                       "cannot be made: " + without_place(error.what()));
    }
    after.v = stage_.v = evaluate_.v();
    after.z = stage_.z = evaluate_.z();
  }

  void do_keep(const State&, const State&) override {
    evaluate_.keep();
    kept_stage_.swap(stage_);
  }
  void do_stage(Step& step) const override { step.stage = kept_stage_; }
  void do_discard() override {
    method_ = Method();
    evaluate_.discard();
  }
  void do_forget() override {
    method_ = Method();
    evaluate_.forget();
  }
  std::unique_ptr<Stepper> do_fresh() const override {
    return std::make_unique<Trajectory>(field_, method());
  }

  std::shared_ptr<const VectorField> field_;
  VectorField::Evaluation evaluate_;
  Method method_;
  State stage_, kept_stage_;  // of the step that is made, and of the last that stands
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

// What odeint's classes have in them.
StepProgram::Explicit ExplicitRungeKutta::tableau() const {
  StepProgram::Explicit tableau;
  switch (kind_) {
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
  tableau.field = &field_->formulas();
  return tableau;
}

StepProgram ExplicitRungeKutta::program() const {
  check_program_space(name(), *system()->manifold());
  StepProgram program{.method = name()};
  program.explicit_steps = tableau();
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
    const StepProgram::Explicit tableau = method_.tableau();
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

  const ExplicitRungeKutta method_;  // its functions are shared, not copied
  VectorFieldDifferential differential_;
};

std::shared_ptr<const StepDifferential> ExplicitRungeKutta::do_differential() const {
  return std::make_shared<Differential>(*this);
}

std::unique_ptr<Stepper> ExplicitRungeKutta::do_stepper() const {
  switch (kind_) {
    case Kind::midpoint:
      return std::make_unique<Trajectory<Midpoint>>(field_, name());
    case Kind::classical:
      return std::make_unique<
          Trajectory<odeint::runge_kutta4<VectorXd, double, VectorXd, double, Algebra>>>(field_,
                                                                                         name());
    case Kind::dormand_prince:
      return std::make_unique<
          Trajectory<odeint::runge_kutta_dopri5<VectorXd, double, VectorXd, double, Algebra>>>(
          field_, name());
    case Kind::fehlberg:
      break;
  }
  return std::make_unique<
      Trajectory<odeint::runge_kutta_fehlberg78<VectorXd, double, VectorXd, double, Algebra>>>(
      field_, name());
}

}  // namespace courant
