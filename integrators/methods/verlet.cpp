#include "courant/integrators/methods/verlet.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/integrators/certificate/local_formulation.hpp"
#include "courant/integrators/maps/adjoint.hpp"
#include "courant/integrators/step/moving_basis.hpp"
#include "courant/integrators/step/predictor.hpp"
#include "courant/integrators/step/round_off_projection.hpp"
#include "courant/integrators/step/step_names.hpp"
#include "courant/integrators/step/step_parts.hpp"
#include "courant/integrators/step/step_program.hpp"
#include "courant/integrators/step/step_solver.hpp"

namespace courant {
namespace {

// h and the parts of a step in which halves are known.
constexpr double kHalf = 0.5;
constexpr double kWhole[] = {1.0};

// Numbers one after the other, as parts of a state.
class Reader {
 public:
  explicit Reader(const double* numbers) : at_(numbers) {}
  void take(VectorXd& to, Index count) {
    to.resize(count);
    std::copy_n(at_, count, to.data());
    at_ += count;
  }
  void take_stage(State& state, Index N, Index n, Index m) {
    take(state.x, N);
    take(state.v, n);
    take(state.z, m);
  }

 private:
  const double* at_;
};

// A step from `before` to `after` by two halves, of which `numbers` tells x̄, v, z, x_m and x̄, v, z.
void tell_halves(const double* numbers, Step& step, bool tells_parts) {
  const Index N = step.before.x.size(), n = step.before.v.size(), m = step.before.z.size();
  Reader reader(numbers);
  Step first{.h = kHalf * step.h}, second = first;
  reader.take_stage(first.stage, N, n, m);
  reader.take(first.after.x, N);
  reader.take_stage(second.stage, N, n, m);
  first.stage.t = step.before.t;
  second.stage.t = step.before.t + step.h;
  step.stage = second.stage;
  step.parts.clear();
  if (!tells_parts) return;
  first.before = step.before;
  first.after.t = step.before.t + first.h;
  first.after.v = first.stage.v;
  first.after.z = first.stage.z;
  second.before = first.after;
  second.after = step.after;
  step.parts = {std::move(first), std::move(second)};
}

}  // namespace

// Steps of given parts of h, each one compiled function.
class Verlet::ExplicitTrajectory final : public Stepper {
 public:
  ExplicitTrajectory(const Verlet& method, const std::string& name, std::span<const double> parts)
      : Stepper(name, method.system()),
        method_(method),
        parts_(parts.begin(), parts.end()),
        n_(manifold().ambient_dimension()),
        count_(*method.handed_on_),
        points_(n_ + count_, std::ssize(parts_) + 1),
        kept_(points_),
        handed_on_(count_),
        ended_(method.ending_.output_size()),
        told_(method.stages_.output_size()) {}

 private:
  void do_prepare(State& state, double) override {
    const double* in[] = {state.x.data(), &state.t};
    method_.beginning_.value(in, handed_on_.data());
  }

  bool do_take_over(const Stepper& other) override {
    const auto* before = dynamic_cast<const ExplicitTrajectory*>(&other);
    if (before == nullptr) return false;
    handed_on_ = before->handed_on_;
    return true;
  }

  void do_step(const State& before, double h, State& after) override {
    points_.col(0) << before.x, handed_on_;
    double share = 0.0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const double* from = points_.col(static_cast<Index>(i)).data();
      const double part = parts_[i] * h, t = before.t + share * h;
      const double* in[] = {from, from + n_, &part, &t};
      method_.advance_.value(in, points_.col(static_cast<Index>(i) + 1).data());
      share += parts_[i];
      if (i + 1 < parts_.size()) continue;
      const double* of_ending[] = {from, from + n_, from + 2 * n_ + count_, &part, &t};
      method_.ending_.value(of_ending, ended_.data());
    }
    after.x = points_.col(points_.cols() - 1).head(n_);
    Reader reader(ended_.data());
    reader.take(after.v, before.v.size());
    reader.take(after.z, before.z.size());
  }

  void do_keep(const State&, const State&) override {
    kept_.swap(points_);
    handed_on_ = kept_.col(kept_.cols() - 1).tail(count_);
  }

  void do_stage(Step& step) const override {
    std::vector<Step> parts;
    double share = 0.0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const double* from = kept_.col(static_cast<Index>(i)).data();
      Step part{.h = parts_[i] * step.h,
                .before = {.t = step.before.t + share * step.h,
                           .x = kept_.col(static_cast<Index>(i)).head(n_),
                           .v = step.before.v,
                           .z = step.before.z}};
      share += parts_[i];
      part.after = step.after;
      part.after.t = step.before.t + share * step.h;
      part.after.x = kept_.col(static_cast<Index>(i) + 1).head(n_);
      const double* in[] = {from, from + n_, from + 2 * n_ + count_, &part.h, &part.before.t};
      method_.stages_.value(in, told_.data());
      tell_halves(told_.data(), part, tells_parts());
      if (!parts.empty()) parts.back().after.v = part.before.v = parts.back().stage.v;
      parts.push_back(std::move(part));
    }
    step.stage = parts.back().stage;
    step.parts.clear();
    if (tells_parts()) step.parts = parts_.size() == 1 ? parts.front().parts : std::move(parts);
  }

  void do_forget() override {}
  std::unique_ptr<Stepper> do_fresh() const override {
    return std::make_unique<ExplicitTrajectory>(method_, method(), parts_);
  }

  const Verlet method_;  // its functions are shared, not copied
  const std::vector<double> parts_;
  const Index n_, count_;
  MatrixXd points_,
      kept_;  // (x, r) before each part and at the end: of the step that is made, and of the last one
  VectorXd handed_on_, ended_;
  mutable VectorXd told_;  // workspace
};

// Both halves in one solve.
class Verlet::Trajectory final : public Stepper {
 public:
  explicit Trajectory(const Verlet& method)
      : Stepper(method.name(), method.system()),
        method_(method),
        n_(manifold().dimension()),
        tangents_(method.codimension_ > 0 ? 3 * n_ : 2 * n_),
        solver_(method.equations_, {tangents_, method.equations_.size() - tangents_}, method.name(),
                method.whole_, {.displacements = 2 * n_, .h = 3}),
        predictor_({tangents_, method.equations_.size() - tangents_}, solver_.predicted()),
        projection_(method.constraint_),
        basis_(manifold(), method.basis_),
        next_(method.advance_.output_size()),
        kept_(next_) {
    if (method.codimension_ > 0)
      start_.emplace(method.consistent_, std::vector<Index>{n_, method.consistent_.size() - n_},
                     method.name());
  }

 private:
  // Onto M_f, where (v, z) are found.
  void do_prepare(State& state, double h) override {
    move_basis(state.x);
    if (!start_) return;
    VectorXd& y = start_->unknown();
    const auto begin = [&] {
      y.setZero();
      basis_.coordinates_of(state.v, y.segment(n_, n_));
      y.segment(method_.tangents_ * n_, state.z.size()) = state.z;
    };
    begin();
    const VectorXd x = state.x;
    const double size = largest(x);
    const double scales[] = {size, auxiliary_scale(largest(state.z), size)};
    // What belongs to x as it is; where there is none, x moves, and what belongs to it.
    Newton at_x(method_.jets_, {y.size() - n_}, {});
    const Inputs jets(y.data() + n_, {x.data(), basis_.data(), &state.t});
    const Inputs in(y.data(), {x.data(), basis_.data(), &state.t});
    if (at_x.solve(jets, scales + 1).status != Newton::Status::converged || !y.allFinite())
      start_->solve(in, scales, begin, {state.t, h}, statistics_);
    VectorXd found(method_.start_.output_size());
    method_.start_.value(in.data(), found.data());
    Reader(found.data()).take_stage(state, x.size(), state.v.size(), state.z.size());
    move_basis(state.x);
  }

  bool do_take_over(const Stepper& other) override {
    const auto* before = dynamic_cast<const Trajectory*>(&other);
    if (before == nullptr) return false;
    if (!basis_.take_over(before->basis_)) predictor_.forget();
    return true;
  }

  void do_step(const State& before, double h, State& after) override {
    VectorXd& y = solver_.unknown();
    const auto begin = [&] {
      const Index m = before.z.size();
      y.setZero();
      basis_.coordinates_of(before.v, y.segment(n_, n_));
      if (start_) {
        y.segment(2 * n_, n_) = y.segment(n_, n_);
        y.segment((method_.tangents_ + 1) * n_, m) = before.z;
      }
      y.segment(n_, n_) *= h;
      y.head(n_) = kHalf * y.segment(n_, n_);
      y.tail(2 * m) << before.z, before.z;
    };
    if (predictor_.is_empty())
      begin();
    else
      predictor_.predict(y);
    // A start at zero has the size of its first step.
    const double given = largest(before.x);
    const double size = given > 0.0 ? given : std::fabs(h) * largest(before.v);
    const double scales[] = {size, auxiliary_scale(largest(before.z), size)};
    const Inputs in(y.data(), {before.x.data(), basis_.data(), &h, &before.t});
    solver_.solve_connected(in, scales, begin, {before.t, h}, statistics_);
    method_.advance_.value(in.data(), next_.data());
    Reader(next_.data()).take_stage(after, before.x.size(), before.v.size(), before.z.size());
    projection_.apply(after.x);
  }

  void do_keep(const State&, const State& after) override {
    if (!solver_.is_determined()) predictor_.limit_degree(Predictor::kUndetermined);
    predictor_.record(solver_.unknown());
    solver_.keep();
    kept_.swap(next_);
    move_basis(after.x);
  }

  void do_stage(Step& step) const override {
    tell_halves(kept_.data() + step.before.x.size() + step.before.v.size() + step.before.z.size(),
                step, tells_parts());
  }

  void do_change_step() override { predictor_.forget(); }
  void do_forget() override {
    solver_.forget();
    predictor_.forget();
    basis_.forget();
  }
  Motion do_motion() const override { return solver_.motion(manifold()); }
  void do_expect(const Motion& motion) override { solver_.expect(motion); }
  std::unique_ptr<Stepper> do_fresh() const override {
    return std::make_unique<Trajectory>(method_);
  }

  void move_basis(const VectorXd& x) {
    if (!basis_.move_to(x)) predictor_.forget();
  }

  const Verlet method_;  // its functions are shared, not copied
  Index n_;
  Index
      tangents_;  // so many of the unknowns are displacements, or the velocity at the end, which tells momenta
  StepSolver solver_;
  std::optional<StepSolver> start_;
  Predictor predictor_;
  RoundOffProjection projection_;
  MovingBasis basis_;  // at the state
  VectorXd next_, kept_;
};

// The formulas of a step that is solved for.
struct Verlet::Trace {
  explicit Trace(const Verlet& method) {
    const ImplicitSystem& S = *method.system();
    const DiscretizationMap& map = *method.map_;
    const Adjoint adjoint(method.map_);
    const Manifold& M = *S.manifold();
    const Index n = M.dimension(), m = S.auxiliary_size();
    step.name = method.name();
    const Graph& graph = step.graph;
    const ExprVector x0 = graph.variables("x0", M.ambient_dimension());
    const LinearMap<Expr> basis = basis_variables(graph, M);
    const ExprVector h = graph.variables("h", 1), t = graph.variables("t", 1);
    const ExprVector w = graph.variables("w", n);
    const ExprVector z_first = graph.variables("lambda", m), z_second = graph.variables("mu", m);
    const bool is_free = method.codimension_ == 0;
    const LocalFormulation local(
        graph, S, x0, basis, t[0],
        is_free ? std::vector<int>(static_cast<std::size_t>(S.equation_count()), 0)
                : method.ladder_->differentiations);

    const Expr rate = 2.0 / h[0], at_end = t[0] + h[0];
    const auto time = [&](double part) {
      return part == 0.0 ? t[0] : Expr(t[0] + Expr(part) * h[0]);
    };
    const auto first = map.from_start(x0, basis * w);
    const ExprVector& x1 = local.x;
    const auto second = adjoint.inverse(first.end, x1);
    const ExprVector v_first = first.v * rate, v_second = second.v * rate;
    const auto equations = [&](const ExprVector& x, const ExprVector& v, const ExprVector& z,
                               const Expr& instant) {
      return reduced_equations(S, basis, S.residual(x, v, z, instant));
    };
    const ExprVector F_first = equations(first.x, v_first, z_first, time(kHalf * map.stage_time()));
    const ExprVector F_second =
        equations(second.x, v_second, z_second, time(kHalf + kHalf * adjoint.stage_time()));
    const std::vector<Index> kept = equations_of_motion(S, basis, F_first, F_second, w, method);

    const StepNames names(S);
    std::vector<ExprVector> unknowns = {w, local.xi[0]};
    std::vector<std::string> called = names.tangent("half Δ", 0);
    append(called, names.tangent("Δ", 0));
    ExprVector all = joined(ExprVector(F_first(kept)), ExprVector(F_second(kept)));
    std::vector<std::string> equation_names;
    const std::vector<std::string> named = names.equations(F_first.size());
    for (const char* half : {"first half: ", "second half: "})
      for (const Index i : kept)
        equation_names.push_back(half + named[static_cast<std::size_t>(i)]);
    if (!is_free) {
      const ExprVector on_M_f = local.nonzero_equations();
      for (std::size_t k = 1; k < local.xi.size(); ++k)
        if (k == 1 || depends(on_M_f, local.xi[k])) {
          unknowns.push_back(local.xi[k]);
          append(called, names.tangent("", static_cast<Index>(k)));
        }
      tangents = std::ssize(unknowns) - 1;
      for (std::size_t k = 0; k < local.z.size(); ++k)
        if (k == 0 || depends(on_M_f, local.z[k])) {
          unknowns.push_back(local.z[k]);
          append(called, names.auxiliary(static_cast<Index>(k)));
        }
      consistent_inputs = {
          {"y", joined(std::vector<ExprVector>(unknowns.begin() + 1, unknowns.end()))},
          {"x0", x0},
          {"basis", basis_parameters(basis)},
          {"t", t}};
      consistent = on_M_f;
      found = joined(local.x, local.v, local.z[0]);
      const auto to_end = [&](const ExprVector& formula) {
        return substitute(formula, t, ExprVector::Constant(1, at_end));
      };
      all = joined(all, to_end(on_M_f));
      for (const std::string& name : names.equations(local))
        equation_names.push_back("at the end: " + name);
      ended = joined(x1, to_end(local.v), local.z[0]);
    } else {
      ended = joined(x1, v_second, z_second);
    }
    unknowns.push_back(z_first);
    unknowns.push_back(z_second);
    append(called, StepNames::each("first ", S.names().auxiliary));
    append(called, StepNames::each("second ", S.names().auxiliary));
    const ExprVector y = joined(unknowns);
    step.inputs = {{"y", y}, {"x0", x0}, {"basis", basis_parameters(basis)}, {"h", h}, {"t", t}};
    step.input_names = {std::move(called), S.names().coordinates, names.basis(), {"h"}, {"t"}};
    step.equations = all;
    step.equation_names = std::move(equation_names);
    step.elimination.never_zero = h;
    step.elimination.is_regular = true;  // the ladder is
    // Multipliers converge with the displacements, of which they may be round-off.
    step.elimination.coarseness.assign(static_cast<std::size_t>(y.size()), 1);
    std::fill_n(step.elimination.coarseness.begin(), (is_free ? 2 : 3) * n, 0);
    advanced = joined(first.x, v_first, z_first, first.end, second.x, v_second, z_second);
  }

  StepFormulas step;
  std::vector<Function::Input> consistent_inputs;
  ExprVector consistent, found;
  ExprVector ended, advanced;  // x₁, v, z; and what is known of the halves
  Index tangents = 0;          // so many of ξ, ξ', … are unknowns

 private:
  // The equations of a half that tell v or z. The others are constraints, on positions, at x₀ and x₁.
  static std::vector<Index> equations_of_motion(const ImplicitSystem& S,
                                                const LinearMap<Expr>& basis,
                                                const ExprVector& first, const ExprVector& second,
                                                const ExprVector& w, const Verlet& method);
};

std::vector<Index> Verlet::Trace::equations_of_motion(const ImplicitSystem& S,
                                                      const LinearMap<Expr>& basis,
                                                      const ExprVector& first,
                                                      const ExprVector& second, const ExprVector& w,
                                                      const Verlet& method) {
  std::vector<Index> kept(static_cast<std::size_t>(first.size()));
  std::iota(kept.begin(), kept.end(), Index{0});
  if (method.codimension_ == 0) return kept;
  const Graph graph = w[0].graph();
  const Manifold& M = *S.manifold();
  const ExprVector x = graph.variables("x", M.ambient_dimension()),
                   v = graph.variables("v", M.tangent_dimension()),
                   z = graph.variables("z", S.auxiliary_size());
  const Expr t = graph.variable("t");
  const std::vector<bool> moves =
      each_depends(reduced_equations(S, basis, S.residual(x, v, z, t)), joined(v, z));
  const std::vector<bool> first_moves = each_depends(first, w),
                          second_moves = each_depends(second, w);
  std::erase_if(kept, [&](Index i) { return !moves[static_cast<std::size_t>(i)]; });
  const Index constraints = first.size() - std::ssize(kept);
  bool is_of_positions = 2 * constraints == method.codimension_;
  for (std::size_t i = 0; i < moves.size(); ++i)
    is_of_positions &= moves[i] || (!first_moves[i] && !second_moves[i]);
  if (!is_of_positions)
    throw std::invalid_argument(
        "Verlet::Verlet: M_f has codimension " + std::to_string(method.codimension_) +
        ", and there are " + std::to_string(constraints) +
        " constraints on positions; expected half as many constraints as the codimension: "
        "independent ones, on positions alone.");
  return kept;
}

Verlet::Verlet(std::shared_ptr<const ImplicitSystem> system, const ConstraintLadder& ladder,
               std::shared_ptr<const DiscretizationMap> map, const Options& options)
    : Integrator(std::move(system)), map_(std::move(map)) {
  const ImplicitSystem& S = *this->system();
  const Manifold& M = *S.manifold();
  if (!map_ || *map_->manifold() != M || !map_->has_inverse())
    throw std::invalid_argument(
        "Verlet::Verlet: the map is missing, has no closed inverse, or is not on the manifold of "
        "the system.");
  if (ladder.verdict != Verdict::regular)
    throw std::invalid_argument("Verlet::Verlet: the ladder's verdict is " +
                                to_string(ladder.verdict) + "; expected regular. " + ladder.reason);
  check_ladder("Verlet::Verlet", S, ladder);
  ladder_ = std::make_shared<const ConstraintLadder>(ladder);
  codimension_ = M.dimension() - ladder.degrees_of_freedom;
  const Backend backend = options.backend.together();
  const Function::Options compiled = {.backend = backend};
  const auto steps =
      codimension_ > 0
          ? std::nullopt
          : ExplicitVerlet::of({this->system(), ladder, VectorFieldFormulas::Freedom::none}, map_);
  if (steps) {
    handed_on_ = std::ssize(steps->handed_on);
    beginning_ = Function("beginning", steps->beginning, compiled);
    advance_ = Function("step", steps->step, compiled);
    stages_ = Function("stages", steps->stages, compiled);
    ending_ = Function("ending", steps->ending, compiled);
    backend.compile();
    return;
  }
  const Trace trace(*this);
  tangents_ = trace.tangents;
  equations_ = trace.step.compile(backend);
  // Of multipliers the solution near the last ones is taken: for steps that go to zero their equations say nothing, so that
  // no curve leads there from the state.
  if (codimension_ == 0) whole_ = trace.step.followed(equations_);
  advance_ = Function("advance", trace.step.inputs, joined(trace.ended, trace.advanced), compiled);
  if (codimension_ > 0) {
    const ExprVector& y = trace.consistent_inputs[0].variables;
    const Index n = M.dimension();
    std::vector<Function::Input> of_jets = trace.consistent_inputs;
    of_jets[0].variables = y.tail(y.size() - n);
    jets_ = Function("jets", of_jets,
                     substitute(trace.consistent, ExprVector(y.head(n)), ExprVector::Zero(n)),
                     {.differentiate = {"y"}});
    consistent_ = Function("consistent", trace.consistent_inputs, trace.consistent,
                           {.differentiate = {"y"}, .varying = {"y"}, .backend = backend});
    start_ = Function("start", trace.consistent_inputs, trace.found, compiled);
  }
  basis_ = MovingBasis::projection(M, backend);
  constraint_ = RoundOffProjection::constraint(M, backend);
  backend.compile();
}

std::optional<bool> Verlet::is_symplectic() const {
  if (map_->is_symplectic().value_or(false) && system()->is_lagrangian().value_or(false))
    return true;
  return std::nullopt;
}

// Of an explicit step: x₀ ↦ x₁.
class Verlet::Differential final : public StepDifferential {
 public:
  explicit Differential(const ExplicitVerlet& of) {
    const auto& [x0, r, h, t] =
        std::tie(of.step.inputs[0], of.step.inputs[1], of.step.inputs[2], of.step.inputs[3]);
    const Index n = x0.variables.size();
    step_ =
        Function("differential", {x0, h, t},
                 substitute(ExprVector(of.step.outputs.head(n)), r.variables, of.beginning.outputs),
                 {.differentiate = {x0.name}});
  }

 private:
  MatrixXd do_images(const Step& step, const MatrixXd& V) const override {
    return jacobian(step) * V;
  }
  MatrixXd do_pull_back(const Step& step, const MatrixXd& Lambda) const override {
    return jacobian(step).transpose() * Lambda;
  }
  MatrixXd jacobian(const Step& step) const {
    return step_.jacobian(
        {step.before.x, VectorXd::Constant(1, step.h), VectorXd::Constant(1, step.before.t)});
  }

  Function step_;
};

std::shared_ptr<const StepDifferential> Verlet::do_differential() const {
  if (!is_explicit()) return nullptr;
  return std::make_shared<Differential>(explicit_steps());
}

ExplicitVerlet Verlet::explicit_steps() const {
  return *ExplicitVerlet::of({system(), *ladder_, VectorFieldFormulas::Freedom::none}, map_);
}

StepProgram Verlet::program() const {
  if (!is_explicit())
    throw std::invalid_argument("steps of " + name() +
                                " that have to be solved for are known as formulas to no program; "
                                "expected an energy T(p) + V(q) on T*Rⁿ, "
                                "or the discretization \"midpoint\"");
  const ExplicitVerlet steps = explicit_steps();
  StepProgram program{.method = name()};
  program.direct = StepProgram::Direct{steps.beginning, steps.step, steps.ending};
  return program;
}

std::vector<StepFormulas> Verlet::do_formulas() const { return {Trace(*this).step}; }

std::unique_ptr<Stepper> Verlet::composed(std::span<const double> parts,
                                          const std::string& name) const {
  if (!is_explicit()) return nullptr;
  return std::make_unique<ExplicitTrajectory>(*this, name, parts);
}

std::unique_ptr<Stepper> Verlet::do_stepper() const {
  if (is_explicit()) return composed(kWhole, name());
  return std::make_unique<Trajectory>(*this);
}

}  // namespace courant
