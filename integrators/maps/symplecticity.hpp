// How far a discretization map of a cotangent bundle is from being symplectic.
#pragma once

#include <memory>

#include "courant/core/expressions/function.hpp"
#include "courant/integrators/maps/discretization_map.hpp"
#include "courant/manifolds/cotangent_bundle.hpp"

namespace courant {

// Measures (R_d)*Ω₁₂ - d_Tω_Q for R_d: T(T*Q) → T*Q × T*Q, Ω₁₂ = pr₂*ω_Q - pr₁*ω_Q
// (Corollary 4.12), on pairs of tangent vectors of T(T*Q).
//
// Through the embedding ι(q, p) = (q, P) ∈ R^{2N}, P = C(q)ᵀ p, which pulls dq ∧ dP back to ω_Q,
// and its tangent map, which pulls dq ∧ dṖ + dq̇ ∧ dP back to d_Tω_Q: no frame, no torsion, only
// exact derivatives of the maps. Traced once, then evaluated anywhere.
class Symplecticity {
 public:
  // Throws std::invalid_argument if the manifold of `map` is not a CotangentBundle.
  explicit Symplecticity(const DiscretizationMap& map);

  // |((R_d)*Ω₁₂ - d_Tω_Q)(a, b)| / (1 + |d_Tω_Q(a, b)|) at (x, v), for random unit a, b.
  double defect(const VectorXd& x, const VectorXd& v, std::mt19937& generator) const;
  // |(Ω₁₂ - (R_d⁻¹)*d_Tω_Q)(a, b)| / (1 + |Ω₁₂(a, b)|) at (x₀, x₁), likewise; only if the map
  // has_inverse().
  double inverse_defect(const VectorXd& x0, const VectorXd& x1, std::mt19937& generator) const;

 private:
  // Both two-forms on two directions: of T(T*Q) and of T*Q × T*Q.
  double measure(const Function& forms, const VectorXd& first, const VectorXd& second,
                 const VectorXd& second_base, std::mt19937& generator) const;

  std::shared_ptr<const CotangentBundle> phase_space_;
  Function forward_;  // the two values, by the point, charts around it and two directions
  Function inverse_;
};

}  // namespace courant
