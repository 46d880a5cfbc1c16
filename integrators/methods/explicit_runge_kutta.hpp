// Explicit Runge–Kutta methods, as baselines.
#pragma once

#include "courant/integrators/step/integrator.hpp"
#include "courant/integrators/step/programmed.hpp"
#include "courant/integrators/step/vector_field.hpp"

namespace courant {

// Explicit methods on ẋ = E(x) v(x, t) in the ambient space of the manifold; what geometric
// methods are compared with. They keep neither M_f nor the manifold: how far they leave them is
// part of the comparison.
class ExplicitRungeKutta final : public Integrator, public Programmed {
 public:
  enum class Kind {
    midpoint,        // "rk2", order 2: the explicit midpoint rule
    classical,       // "rk4", order 4
    dormand_prince,  // "dopri5", order 5, at constant steps
    fehlberg,        // "rkf78", order 8, at constant steps: NASA TR R-287 (1968), table X
  };
  ExplicitRungeKutta(std::shared_ptr<const VectorField> field, Kind kind);

  std::string name() const override;
  int order() const override;
  bool is_symmetric() const override { return false; }
  std::optional<bool> is_symplectic() const override { return false; }
  bool is_native() const override { return field_->is_native(); }
  StepProgram program() const override;

 private:
  class Differential;

  std::unique_ptr<Stepper> do_stepper() const override;
  std::shared_ptr<const StepDifferential> do_differential() const override;

  std::shared_ptr<const VectorField> field_;
  Kind kind_;
};

}  // namespace courant
