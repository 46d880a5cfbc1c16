#include "courant/integrators/stage_step.hpp"

#include <stdexcept>

#include "courant/core/expr_vectors.hpp"
#include "courant/integrators/ladder/local_formulation.hpp"
#include "courant/integrators/moving_basis.hpp"
#include "courant/integrators/predictor.hpp"
#include "courant/integrators/round_off_projection.hpp"
#include "courant/integrators/step_names.hpp"
#include "courant/integrators/step_solver.hpp"

namespace courant {

class StageStep::Trajectory final : public Stepper {
 public:
  explicit Trajectory(const StageStep& method)
      : Stepper(method.name_, method.system_),
        method_(method),
        projection_(method.constraint_),
        n_(manifold().dimension()),
        m_(system().auxiliary_size()),
        blocks_(method.tangent_blocks_),
        solver_(method.equations_, {blocks_ * n_, m_}, method.name_, method.whole_,
                {.displacements = blocks_ * n_, .h = 3}),
        predictor_({blocks_ * n_, m_}, solver_.predicted()),
        basis_(manifold(), method.basis_),
        next_(method.advance_.output_size()),
        kept_(next_) {}

 private:
  void do_prepare(State& state, double) override { move_basis(state.x); }

  void do_step(const State& before, double h, State& after) override {
    VectorXd& y = solver_.unknown();
    const auto begin = [&] { begin_from(before, h, y); };
    if (predictor_.is_empty())
      begin();
    else
      predictor_.predict(y);
    const double* in[] = {y.data(), before.x.data(), basis_.data(), &h, &before.t};
    const double size = largest(before.x);
    const double scales[] = {size, auxiliary_scale(largest(before.z), size)};
    solver_.solve_connected(in, scales, begin, {before.t, h}, statistics_);

    method_.advance_.value(in, next_.data());
    const Index N = before.x.size(), tangent = before.v.size();
    after.x = next_.head(N);
    after.v = next_.segment(N, tangent);
    after.z = y.tail(m_);
    projection_.apply(after.x);
  }

  // The displacement of the velocity that is known, half of it where the middle point is sought.
  void begin_from(const State& before, double h, VectorXd& y) const {
    y.segment((blocks_ - 1) * n_, n_).noalias() = basis_.matrix().transpose() * before.v;
    y.segment((blocks_ - 1) * n_, n_) *= h;
    if (blocks_ == 2) y.head(n_) = 0.5 * y.segment(n_, n_);
    y.tail(m_) = before.z;
  }

  void do_keep(const State&, const State& after) override {
    if (!solver_.is_determined()) predictor_.limit_degree(Predictor::kUndetermined);
    predictor_.record(solver_.unknown());
    solver_.keep();
    move_basis(after.x);
    kept_.swap(next_);
  }

  void do_stage(Step& step) const override {
    step.stage = step.after;
    step.stage.t = step.before.t + method_.map_->stage_time() * step.h;
    if (method_.map_->has_inverse()) {
      const double* in[] = {step.before.x.data(), step.after.x.data()};
      method_.stage_.value(in, step.stage.x.data());
    } else {
      step.stage.x = kept_.segment(step.after.x.size() + step.after.v.size(), step.after.x.size());
    }
    step.effort = kept_.tail(method_.efforts_);
  }

  void do_change_step() override { predictor_.forget(); }
  void do_forget() override {
    basis_.forget();
    solver_.forget();
    predictor_.forget();
  }
  Motion do_motion() const override { return solver_.motion(manifold()); }
  void do_expect(const Motion& motion) override { solver_.expect(motion); }
  std::unique_ptr<Stepper> do_fresh() const override {
    return std::make_unique<Trajectory>(method_);
  }

  void move_basis(const VectorXd& x) {
    if (!basis_.move_to(x)) predictor_.forget();
  }

  const StageStep method_;  // its functions are shared, not copied
  RoundOffProjection projection_;
  Index n_, m_, blocks_;
  StepSolver solver_;
  Predictor predictor_;
  MovingBasis basis_;     // at the state
  VectorXd next_, kept_;  // what advance_ gives for the step that is made, and the last that stands
};

// The formulas of a step.
struct StageStep::Trace {
  explicit Trace(const StageStep& method) {
    const ImplicitSystem& S = *method.system_;
    const DiscretizationMap& map = *method.map_;
    const Manifold& M = *S.manifold();
    const Index n = M.dimension();
    formulas.name = method.name_;
    const Graph& graph = formulas.graph;
    const ExprVector x0 = graph.variables("x0", M.ambient_dimension());
    const ExprMatrix basis = basis_variables(graph, M);
    const ExprVector h = graph.variables("h", 1);
    const ExprVector t = graph.variables("t", 1);
    const ExprVector z = graph.variables("z", S.auxiliary_size());
    const Expr stage_time = t[0] + Expr(map.stage_time()) * h[0];
    const Expr rate = 1.0 / h[0];

    const StepNames names(S);
    std::vector<std::string> unknowns = names.tangent("Δ", 0);
    const auto reduced = [&](const ExprVector& x, const ExprVector& velocity,
                             const ExprVector& end) {
      Equations all = method.method_({.x = x,
                                      .v = velocity,
                                      .z = z,
                                      .t = stage_time,
                                      .h = h[0],
                                      .end = end,
                                      .end_time = t[0] + h[0]});
      effort = std::move(all.effort);
      return reduced_equations(S, basis, all.residual);
    };
    ExprVector y, x1, v, stage(0);
    if (map.has_start()) {
      const ExprVector xi = graph.variables("xi", n);
      const auto middle = map.from_start(x0, basis * xi);
      x1 = middle.end;
      if (!map.has_inverse()) stage = middle.x;
      v = middle.v * rate;
      formulas.equations = reduced(middle.x, v, x1);
      formulas.equation_names = names.equations(formulas.equations.size());
      y.resize(n + z.size());
      y << xi, z;
    } else {
      const ExprVector xi = graph.variables("xi", n);
      const ExprVector eta = graph.variables("eta", n);
      const ExprVector x = M.chart(x0, basis, xi);
      const ExprVector displacement = M.tangent_projector(x) * (basis * eta).eval();
      const auto ends = map.forward(x, displacement);
      x1 = ends.second;
      stage = x;
      v = displacement * rate;
      const ExprVector at_start = M.coframe(x0) * (ends.first - x0).eval();
      const ExprVector equations = reduced(x, v, x1);
      formulas.equations.resize(n + equations.size());
      formulas.equations << basis.transpose() * at_start, equations;
      formulas.equation_names = names.tangent("start of ", 0);
      append(formulas.equation_names, names.equations(equations.size()));
      append(unknowns, names.tangent("h ", 1));
      y.resize(2 * n + z.size());
      y << xi, eta, z;
      tangent_blocks = 2;
    }
    append(unknowns, S.names().auxiliary);
    formulas.inputs = {
        {"y", y}, {"x0", x0}, {"basis", basis_parameters(M, basis)}, {"h", h}, {"t", t}};
    formulas.input_names = {
        std::move(unknowns), S.names().coordinates, names.basis(), {"h"}, {"t"}};
    // z converges with the displacements.
    formulas.elimination.never_zero = h;
    formulas.elimination.coarseness.assign(static_cast<std::size_t>(y.size()), 0);
    std::fill_n(formulas.elimination.coarseness.rbegin(), z.size(), 1);
    advanced = joined(x1, v, stage, effort);
  }

  StepFormulas formulas;
  ExprVector advanced;  // x₁, v, x̄ unless the map has an inverse, and the effort
  ExprVector effort = ExprVector(0);
  Index tangent_blocks = 1;
};

StageStep::StageStep(std::string name, std::shared_ptr<const ImplicitSystem> system,
                     std::shared_ptr<const DiscretizationMap> map, Method method,
                     const Backend& with)
    : name_(std::move(name)),
      system_(std::move(system)),
      map_(std::move(map)),
      method_(std::move(method)) {
  if (!map_ || *map_->manifold() != *system_->manifold())
    throw std::invalid_argument(
        name_ + ": the map is missing, or it is not on the manifold of the system.");
  const Trace trace(*this);
  const Backend backend = with.together();
  tangent_blocks_ = trace.tangent_blocks;
  efforts_ = trace.effort.size();
  equations_ = trace.formulas.compile(backend);
  if (!trace.formulas.is_affine())
    whole_ = equations_.is_reduced() ? trace.formulas.whole() : equations_.left();
  advance_ = Function("advance", trace.formulas.inputs, trace.advanced, {.backend = backend});
  const Manifold& M = *system_->manifold();
  if (map_->has_inverse()) {
    const ExprVector& x0 = trace.formulas.inputs[1].variables;
    const ExprVector end = trace.formulas.graph.variables("x1", M.ambient_dimension());
    stage_ = Function("stage", {{"x0", x0}, {"x1", end}}, map_->inverse(x0, end).x);
  }
  basis_ = MovingBasis::projection(M, backend);
  constraint_ = RoundOffProjection::constraint(M, backend);
  backend.compile();
}

StepFormulas StageStep::formulas() const { return Trace(*this).formulas; }

std::unique_ptr<Stepper> StageStep::stepper() const { return std::make_unique<Trajectory>(*this); }

}  // namespace courant
