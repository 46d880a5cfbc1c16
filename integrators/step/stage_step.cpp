#include "courant/integrators/step/stage_step.hpp"

#include <stdexcept>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/integrators/certificate/local_formulation.hpp"
#include "courant/integrators/step/displacement_stepper.hpp"
#include "courant/integrators/step/step_names.hpp"
#include "courant/integrators/step/transported_frame.hpp"

namespace courant {

class StageStep::Trajectory final : public DisplacementStepper {
 public:
  explicit Trajectory(const StageStep& method)
      : DisplacementStepper(
            method.name_, method.system_,
            {.equations = method.equations_,
             .whole = method.whole_,
             .advance = method.advance_,
             .constraint = method.constraint_,
             .displacements = method.tangent_blocks_ * method.system_->manifold()->dimension(),
             .contained = method.contained_,
             .h = 3}),
        method_(method),
        n_(manifold().dimension()),
        blocks_(method.tangent_blocks_),
        basis_(manifold(), method.basis_) {}

 private:
  void do_prepare(State& state, double) override { move_basis(state.x); }

  bool do_take_over(const Stepper& other) override {
    const auto* before = dynamic_cast<const Trajectory*>(&other);
    if (before == nullptr) return false;
    if (!basis_.take_over(before->basis_)) forget_steps();
    return true;
  }

  void do_step(const State& before, double h, State& after) override {
    make_step(Inputs(unknown(), {before.x.data(), basis_.data(), &h, &before.t}), before, h, after);
  }

  // The displacement of the velocity that is known, half of it where the middle point is sought.
  void do_begin(const State& before, double h, VectorXd& y) override {
    basis_.coordinates_of(before.v, y.segment((blocks_ - 1) * n_, n_));
    y.segment((blocks_ - 1) * n_, n_) *= h;
    if (blocks_ == 2) y.head(n_) = 0.5 * y.segment(n_, n_);
  }

  void do_keep(const State& before, const State& after) override {
    DisplacementStepper::do_keep(before, after);
    move_basis(after.x);
  }

  void do_stage(Step& step) const override {
    step.stage.t = step.before.t + method_.map_->stage_time() * step.h;
    step.stage.v = step.after.v;
    step.stage.z = step.after.z;
    if (method_.map_->has_inverse()) {
      step.stage.x.resize(step.after.x.size());
      const double* in[] = {step.before.x.data(), step.after.x.data()};
      method_.stage_.value(in, step.stage.x.data());
    } else {
      step.stage.x = kept().segment(step.after.x.size() + step.after.v.size(), step.after.x.size());
    }
    step.effort = kept().tail(method_.efforts_);
  }

  void do_forget() override {
    basis_.forget();
    DisplacementStepper::do_forget();
  }
  std::unique_ptr<Stepper> do_fresh() const override {
    return std::make_unique<Trajectory>(method_);
  }

  void move_basis(const VectorXd& x) {
    if (!basis_.move_to(x)) forget_steps();
  }

  const StageStep method_;  // its functions are shared, not copied
  Index n_, blocks_;
  TransportedFrame basis_;  // at the state
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
    const LinearMap<Expr> basis = basis_variables(graph, M);
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
        {"y", y}, {"x0", x0}, {"basis", basis_parameters(basis)}, {"h", h}, {"t", t}};
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
  contained_ = trace.formulas.contained(1);
  equations_ = trace.formulas.compile(backend);
  whole_ = trace.formulas.followed(equations_);
  advance_ = Function("advance", trace.formulas.inputs, trace.advanced, {.backend = backend});
  const Manifold& M = *system_->manifold();
  if (map_->has_inverse()) {
    const ExprVector& x0 = trace.formulas.inputs[1].variables;
    const ExprVector end = trace.formulas.graph.variables("x1", M.ambient_dimension());
    stage_ = Function("stage", {{"x0", x0}, {"x1", end}}, map_->inverse(x0, end).x);
  }
  basis_ = TransportedFrame::projection(M, backend);
  constraint_ = RoundOffProjection::constraint(M, backend);
  backend.compile();
}

StepFormulas StageStep::formulas() const { return Trace(*this).formulas; }

StepProgram StageStep::program() const {
  const Manifold& M = *system_->manifold();
  Trace trace(*this);
  const ExprVector x0 = trace.formulas.inputs[1].variables;
  const ExprVector x1 = trace.formulas.graph.variables("x1", M.ambient_dimension());
  const bool has_inverse = map_->has_inverse();
  StepProgram program{.method = name_};
  program.solve = {.formulas = trace.formulas,
                   .space = SpaceFormulas(M),
                   .is_affine = trace.formulas.is_affine(),
                   .tangent_blocks = trace.tangent_blocks,
                   .displacements = trace.tangent_blocks * M.dimension(),
                   .auxiliaries = system_->auxiliary_size(),
                   .advanced = trace.advanced,
                   .effort = trace.effort,
                   .stage_inputs = {{"x0", x0}, {"x1", x1}},
                   .stage = has_inverse ? map_->inverse(x0, x1).x : ExprVector(0),
                   .stage_time = map_->stage_time(),
                   .stage_is_advanced = !has_inverse};
  return program;
}

std::unique_ptr<Stepper> StageStep::stepper() const { return std::make_unique<Trajectory>(*this); }

}  // namespace courant
