#include "courant/integrators/discretize_first.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "courant/core/message.hpp"
#include "courant/integrators/ladder/local_formulation.hpp"
#include "courant/integrators/moving_basis.hpp"
#include "courant/integrators/predictor.hpp"
#include "courant/integrators/round_off_projection.hpp"
#include "courant/integrators/step_solver.hpp"

namespace courant {

void check_start(const std::string& method, const ImplicitSystem& system, const State& initial,
                 double h) {
  if (!std::isfinite(h) || h == 0.0)
    throw std::invalid_argument(method + "::start: h is " + number_text(h) +
                                "; expected a finite number other than zero.");
  const Index expected = system.manifold()->ambient_dimension();
  if (initial.x.size() != expected)
    throw std::invalid_argument(method + "::start: x has " + std::to_string(initial.x.size()) +
                                " entries, expected " + std::to_string(expected) + ".");
  // A step keeps the distance from the manifold that it begins with, or blows it up.
  const double defect = system.manifold()->point_defect(initial.x);
  const double bound = 1e-6 * (1.0 + initial.x.squaredNorm());
  if (!(defect <= bound)) {
    std::ostringstream message;
    message << method << "::start: x is not on " << system.manifold()->name()
            << ", whose equations it violates by " << defect << "; expected at most " << bound
            << ". Project it first.";
    throw std::domain_error(message.str());
  }
}

class DiscretizeFirst::Trajectory final : public Stepper {
 public:
  Trajectory(const DiscretizeFirst& method, const State& initial, double h)
      : Stepper(initial),
        method_(method),
        manifold_(*method.system_->manifold()),
        projection_(method.constraint_),
        n_(manifold_.dimension()),
        m_(method.system_->auxiliary_size()),
        blocks_(method.tangent_blocks_),
        solver_(method.equations_, {blocks_ * n_, m_}, method.name()),
        predictor_({blocks_ * n_, m_}),
        basis_(manifold_, method.basis_, initial.x),
        origin_(initial.t),
        h_(h),
        start_(VectorXd::Zero(blocks_ * n_ + m_)),
        next_(method.advance_.output_size()) {
    if (state_.v.size() != manifold_.tangent_dimension())
      state_.v = VectorXd::Zero(manifold_.tangent_dimension());
    if (state_.z.size() != m_) state_.z = VectorXd::Zero(m_);
    start_.tail(m_) = state_.z;
  }

 private:
  void do_step() override {
    const Index tangent = manifold_.tangent_dimension();
    VectorXd& y = solver_.unknown();
    if (!basis_.move_to(state_.x)) predictor_.forget();
    if (predictor_.is_empty()) {
      // The displacement of the velocity that is known, half of it where the middle point is
      // sought.
      y.segment((blocks_ - 1) * n_, n_) = h_ * (basis_.matrix().transpose() * state_.v);
      if (blocks_ == 2) y.head(n_) = 0.5 * y.segment(n_, n_);
      y.tail(m_) = state_.z;
    } else {
      predictor_.predict(y);
    }
    const double* in[] = {y.data(), state_.x.data(), basis_.data(), &h_, &state_.t};
    const double size = largest(state_.x);
    const double scales[] = {size, auxiliary_scale(largest(state_.z), size)};
    solver_.solve(in, scales, start_, state_, statistics_);

    method_.advance_.value(in, next_.data());
    if (!next_.allFinite())
      throw SolveError(SolveError::Reason::left_domain, state_.t, statistics_.steps + 1, {},
                       method_.name() + ": step " + std::to_string(statistics_.steps + 1) +
                           " leads to a state that is not finite.");
    if (!solver_.is_determined()) predictor_.limit_degree(Predictor::kUndetermined);
    predictor_.record(y);
    start_.tail(m_) = y.tail(m_);
    state_.x = next_.head(state_.x.size());
    projection_.apply(state_.x);
    state_.v = next_.segment(state_.x.size(), tangent);
    state_.z = next_.tail(m_);
    state_.t = origin_ + static_cast<double>(statistics_.steps + 1) * h_;
  }

  const DiscretizeFirst method_;  // its functions are shared, not copied
  const Manifold& manifold_;
  RoundOffProjection projection_;
  Index n_, m_, blocks_;
  StepSolver solver_;
  Predictor predictor_;
  MovingBasis basis_;
  double origin_, h_;
  VectorXd start_;
  VectorXd next_;
};

DiscretizeFirst::DiscretizeFirst(std::shared_ptr<const ImplicitSystem> system,
                                 std::shared_ptr<const DiscretizationMap> map,
                                 const Options& options)
    : system_(std::move(system)), map_(std::move(map)) {
  if (!system_ || !map_ || *map_->manifold() != *system_->manifold())
    throw std::invalid_argument(
        "DiscretizeFirst::DiscretizeFirst: the system or the map is missing, or the map is not on "
        "the manifold of the system.");
  const Manifold& M = *system_->manifold();
  const Index n = M.dimension();
  Graph graph;
  const ExprVector x0 = graph.variables("x0", M.ambient_dimension());
  const ExprMatrix basis = basis_variables(graph, M);
  const ExprVector h = graph.variables("h", 1);
  const ExprVector t = graph.variables("t", 1);
  const ExprVector z = graph.variables("z", system_->auxiliary_size());
  const Expr stage_time = t[0] + Expr(map_->stage_time()) * h[0];

  const Expr rate = 1.0 / h[0];
  ExprVector y, residual, x1, v;
  if (map_->has_inverse()) {
    const ExprVector xi = graph.variables("xi", n);
    const auto middle = map_->from_start(x0, basis * xi);
    x1 = middle.end;
    v = middle.v * rate;
    residual = reduced_residual(*system_, basis, middle.x, v, z, stage_time);
    y.resize(n + z.size());
    y << xi, z;
  } else {
    const ExprVector xi = graph.variables("xi", n);
    const ExprVector eta = graph.variables("eta", n);
    const ExprVector x = M.chart(x0, basis, xi);
    const ExprVector displacement = M.tangent_projector(x) * (basis * eta).eval();
    const auto ends = map_->forward(x, displacement);
    x1 = ends.second;
    v = displacement * rate;
    const ExprVector at_start = M.coframe(x0) * (ends.first - x0).eval();
    const ExprVector equations = reduced_residual(*system_, basis, x, v, z, stage_time);
    residual.resize(n + equations.size());
    residual << basis.transpose() * at_start, equations;
    y.resize(2 * n + z.size());
    y << xi, eta, z;
    tangent_blocks_ = 2;
  }
  const std::vector<Function::Input> inputs = {
      {"y", y}, {"x0", x0}, {"basis", basis_parameters(M, basis)}, {"h", h}, {"t", t}};
  ExprVector advanced(x1.size() + v.size() + z.size());
  advanced << x1, v, z;
  equations_ = Function("discretize-first", inputs, residual,
                        {.differentiate = {"y"}, .backend = options.backend});
  advance_ = Function("advance", inputs, advanced, {.backend = options.backend});
  basis_ = MovingBasis::projection(M, options.backend);
  constraint_ = RoundOffProjection::constraint(M, options.backend);
}

std::unique_ptr<Stepper> DiscretizeFirst::start(const State& initial, double h) const {
  check_start("DiscretizeFirst", *system_, initial, h);
  return std::make_unique<Trajectory>(*this, initial, h);
}

}  // namespace courant
