// Shooting: the equations of multiple shooting on a discrete flow.
#pragma once

#include <optional>
#include <vector>

#include "courant/core/expressions/function.hpp"
#include "courant/integrators/boundary/boundary_problem.hpp"
#include "courant/integrators/boundary/consistent_points.hpp"
#include "courant/integrators/methods/discrete_flow.hpp"

namespace courant {

// The motion of a BoundaryProblem in m segments, from nodes s_0, …, s_{m-1} ∈ M_f:
//
//   r_0(s_0, t_0, ν_0) = 0,   Bᵀ (Φ(s_{i-1}) - s_i) = 0 for i = 1, …, m-1,   r_T(Φ(s_{m-1}), t_n, ν_T) = 0
//
// and of a periodic one Bᵀ (Φ(s_{m-1}) - s_0) = 0, with an orthonormal basis B of the tangent space of M_f at the node.
// Unknowns are ξ_i, with which s_i moves to P(R(B ξ_i)), τ = log(h/h₀) if the time is free, and the multipliers.
//
// The matrix has the tangent maps of DiscreteFlow, exact to round-off; its column of τ is a difference of order 4,
// exact to some ten digits. Immutable.
class Shooting {
 public:
  // Throws std::invalid_argument as ConsistentPoints and DiscreteFlow do.
  explicit Shooting(const BoundaryProblem& problem);

  // What is sought.
  struct Motion {
    std::vector<State> nodes;
    double h = 0.0;
    VectorXd multipliers = {};  // ν_0, then ν_T
  };
  // That of the guess; nodes after a step that cannot be made are where it began, unless the problem places them. Throws
  // SolveError where the first step fails.
  Motion guess() const;

  using Bases = std::vector<MatrixXd>;
  Bases bases(const Motion& motion) const;
  Motion moved(const Motion& from, const Bases& bases, const VectorXd& change) const;
  // The left sides above. Throws what steps throw.
  VectorXd residual(const Motion& motion, const Bases& bases) const;
  struct Linear {
    VectorXd residual;
    MatrixXd matrix;
    // Of each row: 1 of those of jumps; of a condition the norm of its gradient by all that it may depend on, which,
    // other than its slopes along M_f, is not small because the condition follows from others.
    VectorXd sizes;
  };
  Linear linear(const Motion& motion, const Bases& bases) const;

  Index initial_count() const { return initial_.count(); }
  Index final_count() const { return final_.count(); }
  Index multiplier_count() const {
    return problem_.initial.multipliers + problem_.final.multipliers;
  }
  std::vector<std::string> names() const;  // of the conditions, those of the beginning first
  long segments() const { return std::ssize(steps_); }
  const ConsistentPoints& points() const { return points_; }
  const DiscreteFlow& flow() const { return flow_; }  // of all steps, of the size of the guess

  // The conditions at the ends of one motion from the first node without a break, and what it misses of closing.
  VectorXd of_run(const Motion& motion) const;
  // ∂r_0 or ∂r_T along the columns of V (conditions × k).
  MatrixXd initial_slopes(const State& at, const MatrixXd& V, const VectorXd& multipliers) const;
  MatrixXd final_slopes(const State& at, const MatrixXd& V, const VectorXd& multipliers) const;

 private:
  // The conditions at one end.
  class End {
   public:
    End(const EndConditions& conditions, const ImplicitSystem& system, std::string place);
    Index count() const { return conditions_.output_size(); }
    VectorXd values(const ConsistentPoints& points, const State& at, const VectorXd& nu) const;
    // By the columns of V, and by the multipliers.
    struct Slopes {
      MatrixXd along, by_multipliers;
      VectorXd sizes;  // of the gradients
    };
    Slopes slopes(const ConsistentPoints& points, const State& at, const MatrixXd& V,
                  const VectorXd& nu) const;
    const std::vector<std::string>& names() const { return names_; }

   private:
    Function conditions_;  // x, v, z, t, ν, with Jacobian by all but t
    bool has_rates_ = false;
    std::vector<std::string> names_;
  };

  void place(Motion& motion, std::size_t node) const;
  State end_of(const Motion& motion, std::size_t segment) const;
  State begin_of(const Motion& motion, std::size_t segment) const;
  VectorXd joined(const Motion& motion, const Bases& bases, const std::vector<State>& ends) const;
  VectorXd nu_initial(const Motion& motion) const {
    return motion.multipliers.head(problem_.initial.multipliers);
  }
  VectorXd nu_final(const Motion& motion) const {
    return motion.multipliers.tail(problem_.final.multipliers);
  }

  BoundaryProblem problem_;
  DiscreteFlow flow_;
  ConsistentPoints points_;
  End initial_, final_;
  std::vector<long> steps_;  // of each segment
};

}  // namespace courant
