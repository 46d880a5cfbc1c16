// DiscreteDiracStructure: a Dirac structure seen through a discretization map.
#pragma once

#include "courant/integrators/maps/discretization_map.hpp"
#include "courant/structures/dirac_structure.hpp"

namespace courant {

// D_d = {((x₀, x₁), α_x) : (R_d⁻¹(x₀, x₁), α_x) ∈ D}, x = τ_M(R_d⁻¹(x₀, x₁))   (Definition 5.1)
//
// in (M × M)^{R_d} ⊕ T*M, the pairs of points with a covector at their base point x: no Dirac
// structure itself, but over each x the image of one, D_x, under (v, α) ↦ (R_d(x, v), α). With a
// time step v = R_d⁻¹(x₀, x₁)/h, which is the form that methods take (equation (3)).
//
//   pairing  ⟪((x₀, x₁), α), ((y₀, y₁), β)⟫ = ⟨α, w⟩ + ⟨β, v⟩,  R_d⁻¹ of the pairs (x, v), (x, w)
//
// is zero on D_d over each x (isotropy). Points: N; α: Ñ, at x. Immutable.
class DiscreteDiracStructure {
 public:
  // Both on the same manifold; throws std::invalid_argument otherwise.
  DiscreteDiracStructure(std::shared_ptr<const DiracStructure> structure,
                         std::shared_ptr<const DiscretizationMap> map);

  const std::shared_ptr<const DiracStructure>& structure() const { return structure_; }
  const std::shared_ptr<const DiscretizationMap>& map() const { return map_; }

  // The residual of D at (x, v/h), (x, v) = R_d⁻¹(x₀, x₁), size equation_count() of D; u: port
  // variables of D. On expressions throws std::logic_error if the map has no closed inverse.
  ExprVector membership(const ExprVector& x0, const ExprVector& x1, const ExprVector& alpha,
                        const ExprVector& u, const Expr& h = 1.0) const;

  // The base point x = τ_M(R_d⁻¹(x₀, x₁)).
  VectorXd base_point(const VectorXd& x0, const VectorXd& x1) const;
  // Euclidean distance of (v/h, α) from D_x in the basis of DiracStructure::fibre: 0 on D_d.
  double distance(const VectorXd& x0, const VectorXd& x1, const VectorXd& alpha,
                  double h = 1.0) const;
  // Throws std::domain_error if the two are not over one base point (1e-9).
  double pairing(const VectorXd& x0, const VectorXd& x1, const VectorXd& alpha, const VectorXd& y0,
                 const VectorXd& y1, const VectorXd& beta) const;

  // Elements over x that span it: for each vector (v, α) of a basis of D_x, the points R_d(x, s v)
  // and s α.
  struct Element {
    VectorXd x0, x1, alpha;
  };
  std::vector<Element> elements(const VectorXd& x, double s) const;

 private:
  std::shared_ptr<const DiracStructure> structure_;
  std::shared_ptr<const DiscretizationMap> map_;
};

}  // namespace courant
