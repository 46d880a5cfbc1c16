// StokesDirac: the Dirac structure of two conservation laws on a cell complex.
#pragma once

#include <memory>
#include <vector>

#include "courant/structures/dirac_representations.hpp"
#include "courant/structures/dirac_structure.hpp"
#include "courant/structures/stokes_dirac/cell_complex.hpp"
#include "courant/structures/stokes_dirac/cell_form.hpp"

namespace courant {

// For a complex K of dimension n and a degree k, 0 ≤ k < n: an (n-k)-form p on the dual complex, so one number for
// each k-cell, and a (k+1)-form q on K, with efforts e_p, a k-form on K, and e_q, an (n-k-1)-form on the dual complex:
//
//   dp/dt = d_kᵀ e_q + u       on k-cells, where u is what enters through the dual cell's part of the boundary
//   dq/dt = -d_k e_p           on (k+1)-cells
//
// The structure of van der Schaft & Maschke (2002), dα/dt + d e = 0 for both forms, as Seslija, Scherpen & van der
// Schaft (2014) discretise it. On some k-cells of the boundary, Γ, the effort e_p is the input instead: they have no p.
// With the inputs u_b and outputs y_b of all k-cells of the boundary,
//
//   D = {v = J α + B u_b, y_b = Bᵀα},   J = (0 d_Iᵀ; -d_I 0),   B = (t 0; 0 -d_Γ)
//
// where d_I and d_Γ are the columns of d_k off Γ and on it, and t injects the boundary: the columns come in the order
// of flow_cells(), whose inputs are u and outputs e_p, then effort_cells() = Γ, whose inputs are e_p and outputs
// -d_Γᵀ e_q, what goes in there. All entries are ±1: there is no metric in D.
//
// M = R^(N_p + N_q + N_b): states p and q, then the coordinates of the ports, with effort u_b and flow -y_b, as in
// Composed. D is the graph of the constant bivector (J B; -Bᵀ 0), integrable. Immutable.
class StokesDirac final : public DiracStructure {
 public:
  // Throws std::invalid_argument if the complex is null, k is out of range, or an effort cell is not on the boundary
  // or there twice.
  StokesDirac(std::shared_ptr<const CellComplex> complex, Index degree,
              std::vector<Index> effort_cells = {});

  const std::shared_ptr<const CellComplex>& complex() const { return complex_; }
  Index degree() const { return degree_; }  // k
  // The k-cells that p has numbers of, increasing, and how many numbers p and q have.
  const std::vector<Index>& p_cells() const { return p_cells_; }
  Index p_count() const { return static_cast<Index>(p_cells_.size()); }
  Index q_count() const { return complex_->count(degree_ + 1); }
  Index state_count() const { return p_count() + q_count(); }
  // The k-cells of the boundary with an input flow and those with an input effort, increasing.
  const std::vector<Index>& flow_cells() const { return flow_cells_; }
  const std::vector<Index>& effort_cells() const { return effort_cells_; }
  Index boundary_count() const { return B_.cols(); }  // N_b

  // p and q as forms: p over the duals of its cells, q over its cells; q begins where p ends. A scalar is what belongs to
  // points and what belongs to cells of dimension n.
  CellForm p_form() const;
  CellForm q_form() const;

  // J, N × N, and B, N × N_b, with N = state_count().
  const SparseMatrixXd& J() const { return J_; }
  const SparseMatrixXd& B() const { return B_; }

  // Of flows v and efforts α in the order of M.
  KernelRepresentation<SparseMatrixXd> kernel_representation() const;
  HybridRepresentation<SparseMatrixXd> hybrid_representation() const;

  Index tangent_blocks() const override { return 1; }

 private:
  struct Parts;
  StokesDirac(Parts parts);
  ExprVector do_membership(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                           const ExprVector& u) const override;

  std::shared_ptr<const CellComplex> complex_;
  Index degree_;
  std::vector<Index> p_cells_, flow_cells_, effort_cells_;
  SparseMatrixXd J_, B_, bivector_;
};

// A x for a sparse A.
ExprVector sparse_product(const SparseMatrixXd& A, const ExprVector& x);

}  // namespace courant
