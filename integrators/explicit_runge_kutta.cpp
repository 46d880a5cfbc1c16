#include "courant/integrators/explicit_runge_kutta.hpp"

#include <boost/numeric/odeint/algebra/vector_space_algebra.hpp>
#include <boost/numeric/odeint/external/eigen/eigen_resize.hpp>
#include <boost/numeric/odeint/stepper/explicit_generic_rk.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <stdexcept>

#include "courant/core/message.hpp"
#include "courant/integrators/discretize_first.hpp"

namespace courant {
namespace {

namespace odeint = boost::numeric::odeint;
using Algebra = odeint::vector_space_algebra;
template <int stages, int order>
using Generic =
    odeint::explicit_generic_rk<stages, order, VectorXd, double, VectorXd, double, Algebra>;

// The explicit midpoint rule by its tableau: c = (0, ½), a₂₁ = ½, b = (0, 1).
class Midpoint : public Generic<2, 2> {
 public:
  Midpoint()
      : Generic<2, 2>(coef_a_type(boost::array<double, 1>{{0.5}}), {{0.0, 1.0}}, {{0.0, 0.5}}) {}
};

template <class Method>
class Trajectory final : public Stepper {
 public:
  Trajectory(std::shared_ptr<const VectorField> field, const State& initial, double h,
             std::string name)
      : Stepper(initial),
        field_(std::move(field)),
        evaluate_(*field_),
        name_(std::move(name)),
        origin_(initial.t),
        h_(h) {
    const Manifold& M = *field_->system().manifold();
    if (state_.v.size() != M.tangent_dimension()) state_.v = VectorXd::Zero(M.tangent_dimension());
    if (state_.z.size() != field_->system().auxiliary_size())
      state_.z = VectorXd::Zero(field_->system().auxiliary_size());
  }

 private:
  void do_step() override {
    next_ = state_.x;
    const auto rate = [this](const VectorXd& x, VectorXd& dx, double t) { evaluate_(x, dx, t); };
    try {
      method_.do_step(rate, next_, state_.t, h_);
    } catch (const std::domain_error& error) {
      fail(SolveError::Reason::singular, without_place(error.what()));
    }
    if (!next_.allFinite()) fail(SolveError::Reason::left_domain, "the next state is not finite.");
    state_.x = next_;
    state_.v = evaluate_.v();
    state_.z = evaluate_.z();
    state_.t = origin_ + static_cast<double>(statistics_.steps + 1) * h_;
  }

  [[noreturn]] void fail(SolveError::Reason reason, const std::string& message) const {
    throw SolveError(reason, state_.t, statistics_.steps + 1, {},
                     name_ + ": step " + std::to_string(statistics_.steps + 1) + ": " + message);
  }

  std::shared_ptr<const VectorField> field_;
  VectorField::Evaluation evaluate_;
  std::string name_;
  Method method_;
  double origin_, h_;
  VectorXd next_;
};

}  // namespace

ExplicitRungeKutta::ExplicitRungeKutta(std::shared_ptr<const VectorField> field, Kind kind)
    : field_(std::move(field)), kind_(kind) {
  if (!field_)
    throw std::invalid_argument("ExplicitRungeKutta::ExplicitRungeKutta: field is null.");
}

std::string ExplicitRungeKutta::name() const {
  switch (kind_) {
    case Kind::midpoint:
      return "rk2";
    case Kind::classical:
      return "rk4";
    case Kind::dormand_prince:
      break;
  }
  return "dopri5";
}

int ExplicitRungeKutta::order() const {
  switch (kind_) {
    case Kind::midpoint:
      return 2;
    case Kind::classical:
      return 4;
    case Kind::dormand_prince:
      break;
  }
  return 5;
}

std::unique_ptr<Stepper> ExplicitRungeKutta::start(const State& initial, double h) const {
  check_start("ExplicitRungeKutta", field_->system(), initial, h);
  switch (kind_) {
    case Kind::midpoint:
      return std::make_unique<Trajectory<Midpoint>>(field_, initial, h, name());
    case Kind::classical:
      return std::make_unique<
          Trajectory<odeint::runge_kutta4<VectorXd, double, VectorXd, double, Algebra>>>(
          field_, initial, h, name());
    case Kind::dormand_prince:
      break;
  }
  return std::make_unique<
      Trajectory<odeint::runge_kutta_dopri5<VectorXd, double, VectorXd, double, Algebra>>>(
      field_, initial, h, name());
}

}  // namespace courant
