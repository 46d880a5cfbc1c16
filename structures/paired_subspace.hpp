// PairedSubspace: a subspace of V ⊕ V*.
#pragma once

#include <iosfwd>

#include "courant/core/linear/rank_decision.hpp"

namespace courant {

using Eigen::MatrixXd;

// ≪(v₁, α₁), (v₂, α₂)≫ = ⟨α₁, v₂⟩ + ⟨α₂, v₁⟩, the pairing of V ⊕ V* (Section 2.1).
double pairing(const Eigen::Ref<const VectorXd>& v1, const Eigen::Ref<const VectorXd>& alpha1,
               const Eigen::Ref<const VectorXd>& v2, const Eigen::Ref<const VectorXd>& alpha2);

// A subspace U ⊂ V ⊕ V*, dim V = n, with the orthogonal complement of the pairing:
//
//   U^⊥ = {(v, α) : ≪(v, α), (u, β)≫ = 0 for all (u, β) ∈ U}
//   U isotropic: U ⊂ U^⊥,   U coisotropic: U^⊥ ⊂ U
//
// A vector v and a covector α are columns of n numbers in dual bases, a pair (v, α) is a column of
// 2n.
//
// Laws: dim U + dim U^⊥ = 2n;  U^⊥⊥ = U;  (U ∩ W)^⊥ = U^⊥ + W^⊥;  U isotropic ⟺ U^⊥ coisotropic.
//
// Bases are orthonormal and distances are measured in the standard scalar product of R^{2n}, which
// serves numerics only: change units if the numbers in V and in V* are of very different size. The
// dimension rests on a rank decision, which is kept.
//
// Immutable. A Dirac structure, U = U^⊥, is a LinearDirac.
class PairedSubspace {
 public:
  // {(Xλ, Yλ) : λ}, X and Y of size n × k; columns may be dependent.
  static PairedSubspace image(const Eigen::Ref<const MatrixXd>& X,
                              const Eigen::Ref<const MatrixXd>& Y, const RankOptions& options = {});

  // {(v, α) : Fv + Eα + Pu = 0 for some u}, F and E of size r × n, P of size r × m (ports or
  // multipliers; m = 0 if left out); rows may be dependent.
  static PairedSubspace kernel(const Eigen::Ref<const MatrixXd>& F,
                               const Eigen::Ref<const MatrixXd>& E,
                               const Eigen::Ref<const MatrixXd>& P,
                               const RankOptions& options = {});
  static PairedSubspace kernel(const Eigen::Ref<const MatrixXd>& F,
                               const Eigen::Ref<const MatrixXd>& E,
                               const RankOptions& options = {});

  Index space_dimension() const { return n_; }                // n
  Index dimension() const { return dimension_; }              // dim U
  const RankDecision& decision() const { return decision_; }  // how dim U was decided

  // An orthonormal basis (2n × dim U), its components in V and in V*, and one of the Euclidean
  // complement: U = {z : Cᵀz = 0}.
  MatrixXd basis() const { return frame_.leftCols(dimension_); }
  MatrixXd vectors() const { return frame_.topLeftCorner(n_, dimension_); }
  MatrixXd covectors() const { return frame_.bottomLeftCorner(n_, dimension_); }
  MatrixXd complement() const { return frame_.rightCols(2 * n_ - dimension_); }

  // For ranks of blocks of the bases, whose entries are at most 1: good to 1e-13, which leaves room
  // for some operations one after the other, or to the error of the data that U was made of.
  RankOptions block_options() const { return {.data_error = data_error_, .magnitude = 1.0}; }

  PairedSubspace orthogonal() const;  // U^⊥

  // max |≪z, w≫| over unit vectors z, w of U, and of U^⊥: 0 if U is isotropic, coisotropic; at
  // most 1.
  double isotropy_defect() const;
  double coisotropy_defect() const;
  bool is_isotropic(double tolerance = 1e-9) const { return isotropy_defect() <= tolerance; }
  bool is_coisotropic(double tolerance = 1e-9) const { return coisotropy_defect() <= tolerance; }
  bool is_dirac(double tolerance = 1e-9) const {
    return is_isotropic(tolerance) && is_coisotropic(tolerance);
  }

  // Euclidean distance of (v, α) from U.
  double distance(const Eigen::Ref<const VectorXd>& v,
                  const Eigen::Ref<const VectorXd>& alpha) const;

  // Orthonormal bases (columns) of the projections of U, and of its intersections with V and V*. If
  // U is Dirac, the covector kernel is the annihilator of the vector range, and the other way
  // round.
  MatrixXd vector_range() const;     // F_U    = {v : (v, α) ∈ U for some α}
  MatrixXd covector_range() const;   // F_U^(*) = {α : (v, α) ∈ U for some v}
  MatrixXd vector_kernel() const;    // {v : (v, 0) ∈ U}, of a graph of ω the kernel of ω
  MatrixXd covector_kernel() const;  // {α : (0, α) ∈ U}, of a graph of Λ the Casimir covectors

 private:
  PairedSubspace(Index n, MatrixXd frame, RankDecision decision, Index dimension,
                 double data_error);

  Index n_;
  MatrixXd frame_;  // [basis complement], an orthogonal matrix
  RankDecision decision_;
  Index dimension_;
  double data_error_;
};

// U ∩ W and U + W, of subspaces of one V ⊕ V*.
PairedSubspace intersection(const PairedSubspace& U, const PairedSubspace& W);
PairedSubspace sum(const PairedSubspace& U, const PairedSubspace& W);

// The sine of the largest angle between U and W: 0 if and only if they are equal; 1 if their
// dimensions differ.
double distance(const PairedSubspace& U, const PairedSubspace& W);

// What it is (dimension, isotropic, coisotropic) and a basis, one line (v | α) for each vector.
std::ostream& operator<<(std::ostream& out, const PairedSubspace& U);

}  // namespace courant
