// Integrability of Dirac structures: dω, the Schouten bracket, Courant's condition.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "courant/structures/dirac_structure.hpp"
#include "courant/structures/matrix_field.hpp"

namespace courant {

// An alternating tensor with three indices, T_ijk, each below size().
class AlternatingTensor {
 public:
  explicit AlternatingTensor(Index size)
      : slices_(static_cast<std::size_t>(size), MatrixXd::Zero(size, size)) {}

  Index size() const { return static_cast<Index>(slices_.size()); }
  double operator()(Index i, Index j, Index k) const {
    return slices_[static_cast<std::size_t>(i)](j, k);
  }
  // The values of T at a permutation of (i, j, k) follow from the one at it.
  void set(Index i, Index j, Index k, double value);
  double max_abs() const;

 private:
  std::vector<MatrixXd> slices_;
};

// (dω)_ijk = ∂_i ω_jk + ∂_j ω_ki + ∂_k ω_ij at x, the components along tangent_basis(x): exact
// derivatives in the chart of the retraction at x. ω as in Presymplectic.
AlternatingTensor exterior_derivative(const Manifold& manifold, const MatrixField& form,
                                      const VectorXd& x);

// [Λ, M]^ijk = Σ_l Λ^il ∂_l M^jk + M^il ∂_l Λ^jk + cyclic permutations of ijk, likewise along the
// tangent_basis(x). ½[Λ, Λ]^ijk = {x^i, {x^j, x^k}} + cyclic: zero if and only if Λ is Poisson.
AlternatingTensor schouten_bracket(const Manifold& manifold, const MatrixField& first,
                                   const MatrixField& second, const VectorXd& x);

// How far D is from integrable at a point (Remark 2.6).
struct Integrability {
  // |⟨L_{X₁}α₂, X₃⟩ + ⟨L_{X₂}α₃, X₁⟩ + ⟨L_{X₃}α₁, X₂⟩| at its largest on an orthonormal basis
  // of D_x, and the largest sum of the sizes of its terms.
  double defect = 0.0;
  double scale = 0.0;
  // Why it has no value: D_x is not Dirac, or its rank is not constant at x. Empty: it has one.
  std::string undefined = {};
  VectorXd x = {};

  bool integrable() const { return undefined.empty() && defect <= 1e-9 * scale + 1e-13; }
};

// T(s₁, s₂, s₃) = ⟨L_{X₁}α₂, X₃⟩ + cyclic for sections s_i = (X_i, α_i) of D is a tensor where D is
// isotropic: it depends on the values at x only. They are extended to sections along the chart of
// the retraction at x, with exact first derivatives, A z = 0 ⟹ dz = -A⁺ dA z.
//
// Basis: the orthonormal basis of D_x that fibre(x) has, up to rotation. n⁴ operations. For n > 24
// `integrability` takes T on 24 random orthonormal elements of D_x, fixed once and for all: a
// tensor that is not zero vanishes there with probability 0.
AlternatingTensor courant_tensor(const DiracStructure& structure, const VectorXd& x);
Integrability integrability(const DiracStructure& structure, const VectorXd& x);
// The worst of several points, undefined ones last: at those where it has a value, and the number
// of them.
struct IntegrabilitySurvey {
  Integrability worst;
  std::size_t points = 0, undefined = 0;
  bool integrable() const { return points > undefined && worst.integrable(); }
};
IntegrabilitySurvey integrability(const DiracStructure& structure,
                                  std::span<const VectorXd> points);

}  // namespace courant
