#include "courant/integrators/methods/reduced_map.hpp"

#include <stdexcept>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/solve/equation_system.hpp"
#include "courant/core/solve/gauss_newton.hpp"
#include "courant/integrators/step/displacement_stepper.hpp"
#include "courant/integrators/step/step_names.hpp"

namespace courant {

class ReducedMap::Trajectory final : public DisplacementStepper {
 public:
  explicit Trajectory(const ReducedMap& method)
      : DisplacementStepper(method.name(), method.system(),
                            {.equations = *method.equations_,
                             .whole = method.whole_,
                             .advance = method.advance_,
                             .constraint = method.constraint_,
                             .displacements = method.rate_.output_size(),
                             .contained = method.contained_,
                             .h = 2}),
        method_(method),
        rate_(method.rate_.output_size()) {}

 private:
  void do_step(const State& before, double h, State& after) override {
    make_step(Inputs(unknown(), {before.x.data(), &h, &before.t}), before, h, after);
  }

  void do_begin(const State& before, double h, VectorXd& y) override {
    const double* in[] = {before.x.data(), before.z.data(), &before.t};
    method_.rate_.value(in, rate_.data());
    y.head(rate_.size()) = h * rate_;
  }

  void do_stage(Step& step) const override {
    step.stage = step.after;
    step.stage.t = step.before.t + method_.map_->stage_time() * step.h;
    step.stage.x = kept().tail(step.after.x.size());
    step.effort = VectorXd();
  }

  std::unique_ptr<Stepper> do_fresh() const override {
    return std::make_unique<Trajectory>(method_);
  }

  const ReducedMap method_;  // its functions are shared, not copied
  VectorXd rate_;
};

// The formulas of a step.
struct ReducedMap::Trace {
  explicit Trace(const ReducedMap& method) {
    const DiracSystem& S = *method.reduced_;
    const LiePoisson& D = *method.structure_;
    const DiscretizationMap& map = *method.map_;
    const Index n = D.acting().dimension(), d = D.algebra().dimension() - n;
    const double sign = D.sign() == LiePoisson::Sign::minus ? 1.0 : -1.0;
    const Graph& graph = formulas.graph;
    const ExprVector x0 = graph.variables("x0", S.manifold()->ambient_dimension());
    const ExprVector w = graph.variables("w", n), change = graph.variables("change", n);
    const ExprVector z = graph.variables("z", S.auxiliary_size());
    const ExprVector h = graph.variables("h", 1), t = graph.variables("t", 1);
    const Expr rate = 1.0 / h[0], stage_time = t[0] + Expr(map.stage_time()) * h[0];
    const ExprVector a0 = x0.segment(n, d), g0 = x0.tail(x0.size() - n - d);

    const auto T = std::make_shared<CotangentBundle>(map.manifold());
    const auto lifted =
        CotangentLift(T, method.map_)
            .from_start(joined(constants(*map.manifold()->unit()), x0.head(n)), joined(w, change));
    const ExprVector velocity = T->horizontal(lifted.v);
    const ExprVector xi = velocity * rate;
    const ExprVector a = transported(method.action_, T->position(lifted.x), a0);
    ExprVector advected = ExprVector::Zero(d);
    for (Index i = 0; i < std::ssize(D.representation()); ++i)
      advected += constants(D.representation()[static_cast<std::size_t>(i)]).transpose() *
                  (xi[i] * a).eval();
    ExprVector x = joined(T->momentum(lifted.x), a),
               v = joined(T->vertical(lifted.v) * rate, advected);
    ExprVector x1 =
        joined(T->momentum(lifted.end), transported(method.action_, T->position(lifted.end), a0));
    if (D.group()) {
      const auto attitude = map.from_start(g0, w);
      x = joined(x, attitude.x);
      x1 = joined(x1, attitude.end);
      v = joined(v, xi);
    }
    const ExprVector residual = S.residual(x, v, z, stage_time);
    const ExprVector effort = S.effort(x, z, stage_time).head(n);
    const Index others = residual.size() - D.equation_count();
    formulas.name = method.name();
    formulas.equations =
        joined(velocity - (sign * h[0]) * effort, residual.head(n), residual.tail(others));

    const StepNames names(S);
    const auto& coordinates = S.names().coordinates;
    std::vector<std::string> unknowns = StepNames::numbered("h xi", n);
    append(unknowns, StepNames::each("Δ", {coordinates.begin(), coordinates.begin() + n}));
    append(unknowns, S.names().auxiliary);
    formulas.equation_names = StepNames::numbered("velocity", n);
    append(formulas.equation_names,
           StepNames::each("rate of ", {coordinates.begin(), coordinates.begin() + n}));
    const auto& equations = S.names().equations;
    append(formulas.equation_names, {equations.end() - others, equations.end()});
    formulas.inputs = {{"y", joined(w, change, z)}, {"x0", x0}, {"h", h}, {"t", t}};
    formulas.input_names = {std::move(unknowns), coordinates, {"h"}, {"t"}};
    // z converges with the displacements.
    formulas.elimination.never_zero = h;
    formulas.elimination.coarseness.assign(static_cast<std::size_t>(2 * n + z.size()), 0);
    std::fill_n(formulas.elimination.coarseness.rbegin(), z.size(), 1);
    advanced = joined(x1, v, x);

    const ExprVector at_rest = ExprVector::Zero(v.size());
    start_inputs = {{"x0", x0}, {"z", z}, {"t", t}};
    start = joined(sign * S.effort(x0, z, t[0]).head(n).eval(),
                   -S.residual(x0, at_rest, z, t[0]).head(n).eval());
  }

  // A(x)ᵀ a
  static ExprVector transported(const GroupAction& action, const ExprVector& x,
                                const ExprVector& a) {
    if (a.size() == 0) return a;
    return action(x).transpose() * a;
  }

  StepFormulas formulas;
  ExprVector advanced;
  std::vector<Function::Input> start_inputs;
  ExprVector start;  // v/h and dμ/dt at x₀
};

// At the y of the step, which is found again from what the step knows: Δμ and z are those of its ends.
class ReducedMap::Differential final : public StepDifferential {
 public:
  explicit Differential(const ReducedMap& method)
      : method_(method), n_(method.structure_->acting().dimension()) {
    const Trace trace(method);
    const auto& inputs = trace.formulas.inputs;
    equations_ =
        Function("differential", inputs, trace.formulas.equations, {.differentiate = {"y", "x0"}});
    advance_ = Function("advance", inputs,
                        trace.advanced.head(method.reduced_->manifold()->ambient_dimension()),
                        {.differentiate = {"y", "x0"}});
  }

 private:
  MatrixXd do_images(const Step& step, const MatrixXd& V) const override {
    const VectorXd h = VectorXd::Constant(1, step.h), t = VectorXd::Constant(1, step.before.t);
    VectorXd y(equations_.input_size(0));
    y << step.h * method_.rate_({step.before.x, step.after.z, t}).head(n_),
        step.after.x.head(n_) - step.before.x.head(n_), step.after.z;
    y = gauss_newton(
            [&](const VectorXd& at) {
              return equations_({at, step.before.x, h, t});
            },
            [&](const VectorXd& at) -> MatrixXd {
              return equations_.jacobian({at, step.before.x, h, t}).leftCols(at.size());
            },
            y)
            .y;
    const MatrixXd F = equations_.jacobian({y, step.before.x, h, t});
    const MatrixXd G = advance_.jacobian({y, step.before.x, h, t});
    const Index N = step.before.x.size();
    return G.rightCols(N) * V +
           G.leftCols(y.size()) *
               implicit_derivative("ReducedMap", F.leftCols(y.size()), F.rightCols(N) * V, 2 * n_);
  }

  // By the images of a basis.
  MatrixXd do_pull_back(const Step& step, const MatrixXd& Lambda) const override {
    const Manifold& M = *method_.reduced_->manifold();
    const MatrixXd basis = (M.frame(step.before.x) * M.tangent_basis(step.before.x)).matrix();
    return pull_back_by(basis, do_images(step, basis), Lambda);
  }

  const ReducedMap method_;  // its functions are shared, not copied
  Index n_;
  Function equations_, advance_;  // y; x₀, h, t ↦ each, with Jacobian by y and x₀
};

namespace {

// What throws is found before anything is traced.
std::shared_ptr<const LiePoisson> checked(const std::shared_ptr<const DiracSystem>& system,
                                          const std::shared_ptr<const DiscretizationMap>& map) {
  if (!system || !map)
    throw std::invalid_argument(
        "ReducedMap::ReducedMap: the system or the map is missing; expected both.");
  auto structure = std::dynamic_pointer_cast<const LiePoisson>(system->structure());
  if (!structure)
    throw std::invalid_argument("ReducedMap::ReducedMap: the structure is " +
                                system->structure()->name() +
                                "; expected the Lie-Poisson structure of an algebra.");
  if (!map->is_left_invariant() || !is_group_of(map->manifold(), structure->acting()))
    throw std::invalid_argument("ReducedMap::ReducedMap: " + map->name() +
                                " is not a left-invariant map on a group with the Lie algebra " +
                                structure->acting().name() + "; expected one.");
  if (structure->group() && *structure->group() != *map->manifold())
    throw std::invalid_argument("ReducedMap::ReducedMap: the map is on " + map->manifold()->name() +
                                ", the attitude on " + structure->group()->name() +
                                "; expected one and the same.");
  if (!map->has_start())
    throw std::invalid_argument("ReducedMap::ReducedMap: " + map->name() +
                                " has no closed formula for the pairs that begin at a point; "
                                "expected a map that has.");
  return structure;
}

}  // namespace

ReducedMap::ReducedMap(std::shared_ptr<const DiracSystem> system,
                       std::shared_ptr<const DiscretizationMap> map, const Options& options)
    : Integrator(system),
      reduced_(std::move(system)),
      structure_(checked(reduced_, map)),
      map_(std::move(map)),
      action_(group_action(*map_->manifold(), structure_->representation())) {
  if (!action_)
    throw std::invalid_argument("ReducedMap::ReducedMap: no action of " + map_->manifold()->name() +
                                " is known for the representation on the advected parameters; "
                                "expected one by polynomials, of degree 3 at most, in the points "
                                "of the group, as on vectors and on tensors.");
  const Trace trace(*this);
  const Backend backend = options.backend.together();
  contained_ = trace.formulas.contained(1);
  equations_ = std::make_shared<const EquationSystem>(trace.formulas.compile(backend));
  whole_ = trace.formulas.followed(*equations_);
  advance_ = Function("advance", trace.formulas.inputs, trace.advanced, {.backend = backend});
  rate_ = Function("rate", trace.start_inputs, trace.start, {.backend = backend});
  constraint_ = RoundOffProjection::constraint(*reduced_->manifold(), backend);
  backend.compile();
}

bool ReducedMap::is_native() const { return equations_->is_native(); }

std::unique_ptr<Stepper> ReducedMap::do_stepper() const {
  return std::make_unique<Trajectory>(*this);
}

std::shared_ptr<const StepDifferential> ReducedMap::do_differential() const {
  return std::make_shared<Differential>(*this);
}

std::vector<StepFormulas> ReducedMap::do_formulas() const { return {Trace(*this).formulas}; }

}  // namespace courant
