// DiscreteFlow: the steps of a method as one map, with its tangent map and its adjoint.
#pragma once

#include <complex>
#include <functional>
#include <memory>

#include "courant/integrators/step/integrator.hpp"

namespace courant {

// A basis of T_xM, or of T_xM_f for given conormals, as ambient velocities (N × k). `conormals`: of M_f at x, rows of Ñ
// numbers (ConstraintLadder::conormals()); none: M_f is M.
MatrixXd consistent_directions(const Manifold& M, const MatrixXd& conormals, const VectorXd& x);

// Φ = Φ_h ∘ … ∘ Φ_h, n steps of a method: x₀ ↦ x_n, on M_f for a method on M_f.
//
//   push_forward   TΦ V for directions V at x₀ (N × k)
//   pull_back      Σ_j (T_{x₀}(Φ_h)^j)ᵀ dg_j(x_j), the gradient of g_0(x_0) + … + g_n(x_n)
//
// Both are the derivatives of the steps that are made, by StepDifferential: no difference quotients, no
// differential equation that is solved beside. Their error is the round-off of a linear solve a step. The
// adjoint makes each step twice and solves once for each, whatever the dimension is; it keeps the states at
// about √n checkpoints and the steps between two of them.
//
// Vectors and covectors are ambient (N numbers). Where there are constraints a direction has to lie in
// T_{x₀}M_f, spanned by consistent_directions(); a gradient is known by its pairings with these.
//
// Derivatives by parameters are those by coordinates that do not move: make the method for
// ParameterExtension::extended(), whose last p coordinates are the parameters.
//
//   const ParameterExtension with(system, {{"l", 1.2}});
//   const DiscreteFlow flow(method_for(with.extended()), 0.01, 100);
//   flow.push_forward(with.to_extended(start), V).directions     δx_n for each column (δx₀, δl) of V
//
// Immutable; any number of threads may ask at once.
class DiscreteFlow {
 public:
  // Throws std::invalid_argument if the method is null or does not know the differential of its steps, h is 0 or
  // steps < 0; as Integrator::differential does.
  DiscreteFlow(std::shared_ptr<const Integrator> method, double h, long steps);

  const Integrator& method() const { return *method_; }
  double h() const { return h_; }
  long steps() const { return steps_; }
  // Of the same method, whose differential is not traced again. Throws std::invalid_argument as the constructor does.
  DiscreteFlow over(double h, long steps) const;

  struct Image {
    State end;
    MatrixXd directions;  // N × k
  };
  // In what follows `start` is prepared by the method first. Throws what a step throws, and StepDifferential.
  Image push_forward(const State& start, const MatrixXd& V) const;

  // dg_j at x_j (N × m, a column a function), or an empty matrix for none; asked for from the last to the first.
  using Slopes = std::function<MatrixXd(long j, const State& at)>;
  struct Gradient {
    State end;
    MatrixXd covectors;  // N × m
  };
  Gradient pull_back(const State& start, const Slopes& slopes) const;

  // log of the growth of k-dimensional volumes, by time, in descending order: of orthonormal directions that are made
  // orthonormal again after each `every` steps (Benettin, Galgani, Giorgilli, Strelcyn, 1980). They tend to the
  // Lyapunov exponents as steps · h does to infinity, the error like its reciprocal. V: as many directions as exponents
  // are asked for. Throws std::invalid_argument unless there are steps and every > 0.
  VectorXd lyapunov_exponents(const State& start, const MatrixXd& V, long every = 1) const;

  // The eigenvalues of TΦ on the span of V, of an orbit that closes after the n steps: its Floquet multipliers, by
  // descending modulus. Throws std::domain_error if x_n is farther than `tolerance` from x₀, or TΦ leads out of the
  // span.
  Eigen::VectorXcd multipliers(const State& start, const MatrixXd& V,
                               double tolerance = 1e-8) const;

 private:
  DiscreteFlow(std::shared_ptr<const Integrator> method,
               std::shared_ptr<const StepDifferential> differential, double h, long steps);

  // The steps from the state after step `first` to that after step `last`, told one by one.
  void make(Stepper& stepper, State& state, double start, long first, long last,
            const std::function<void(const Step&)>& tell) const;

  std::shared_ptr<const Integrator> method_;
  std::shared_ptr<const StepDifferential> differential_;
  double h_;
  long steps_;
};

}  // namespace courant
