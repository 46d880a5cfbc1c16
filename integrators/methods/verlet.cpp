#include "courant/integrators/methods/verlet.hpp"

#include <stdexcept>
#include <tuple>
#include <utility>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/solve/equation_engine.hpp"
#include "courant/integrators/methods/explicit_verlet.hpp"
#include "courant/integrators/methods/explicit_verlet_steps.hpp"
#include "courant/integrators/methods/verlet_steps.hpp"
#include "courant/integrators/methods/verlet_trace.hpp"
#include "courant/integrators/step/step_program.hpp"

namespace courant {

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
  const Backend backend = options.backend.together();
  if (!has_constraints()) {
    if (const auto formulas = explicit_formulas())
      explicit_ = std::make_shared<const ExplicitVerletSteps>(*formulas, backend);
  } else if (!engine_of(backend) && VerletTrace::moves_by_sums(map_)) {
    const VerletTrace of_step = trace(VerletTrace::Unknowns::velocities);
    if (const auto formulas = ExplicitVerlet::of(of_step, M))
      explicit_ = std::make_shared<const ExplicitVerletSteps>(*formulas, of_step, M, backend);
  }
  if (!explicit_)
    solved_ = std::make_shared<const VerletSteps>(trace(VerletTrace::Unknowns::displacements), M,
                                                  backend);
  backend.compile();
}

bool Verlet::has_constraints() const {
  return ladder_->degrees_of_freedom < system()->manifold()->dimension();
}

bool Verlet::is_explicit() const { return explicit_ != nullptr && !has_constraints(); }

std::string Verlet::name() const { return has_constraints() ? "rattle" : "verlet"; }

bool Verlet::is_native() const { return explicit_ ? explicit_->is_native() : solved_->is_native(); }

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
  return std::make_shared<Differential>(*explicit_formulas());
}

std::optional<ExplicitVerlet> Verlet::explicit_formulas() const {
  return ExplicitVerlet::of({system(), *ladder_, VectorFieldFormulas::Freedom::none}, map_);
}

VerletTrace Verlet::trace(VerletTrace::Unknowns kind) const {
  return {*system(), *ladder_, map_, name(), kind};
}

StepProgram Verlet::program() const {
  if (!is_explicit())
    throw std::invalid_argument("steps of " + name() +
                                " that have to be solved for are known as formulas to no program; "
                                "expected an energy T(p) + V(q) on T*Rⁿ, "
                                "or the discretization \"midpoint\"");
  const ExplicitVerlet steps = *explicit_formulas();
  StepProgram program{.method = name()};
  program.direct = StepProgram::Direct{steps.beginning, steps.step, steps.ending};
  return program;
}

std::vector<StepFormulas> Verlet::do_formulas() const {
  if (!explicit_ || is_explicit()) return {trace(VerletTrace::Unknowns::displacements).step};
  StepFormulas formulas = trace(VerletTrace::Unknowns::velocities).step;
  // Multipliers are known as well as what they move, see MultiplierSolver, and may give it.
  formulas.elimination.coarseness.clear();
  return {formulas};
}

std::unique_ptr<Stepper> Verlet::composed(std::span<const double> parts,
                                          const std::string& name) const {
  if (!explicit_) return nullptr;
  return explicit_->stepper(name, system(), parts);
}

std::unique_ptr<Stepper> Verlet::do_stepper() const {
  constexpr double whole[] = {1.0};
  return explicit_ ? composed(whole, name()) : solved_->stepper(name(), system());
}

}  // namespace courant
