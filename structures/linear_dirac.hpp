// LinearDirac: a linear Dirac structure.
#pragma once

#include <iosfwd>
#include <random>
#include <string>

#include "courant/structures/dirac_representations.hpp"
#include "courant/structures/paired_subspace.hpp"

namespace courant {

// A linear Dirac structure on V (Definition 2.1): a subspace D ⊂ V ⊕ V* with
//
//   D = D^⊥,   that is, dim D = n = dim V and ≪z, w≫ = 0 for all z, w ∈ D.
//
// Laws, F_D and F_D^(*) the projections of D on V and V*:
//   V1  D ∩ V* = F_D°,  D ∩ V = (F_D^(*))°
//   V2  D is determined by (F_D, ω_D), and by (F_D^(*), Λ_D) (Proposition 2.3 and its dual)
//   V3  D = {(v, α) : F v + E α = 0} = {(Eᵀλ, Fᵀλ)}
//   V4  D is the graph of one orthogonal matrix O, v - α = O (v + α), in bases that are fixed
//
// Signs: α = ω♭(v) = ωᵀ v for a form with matrix ω_ij = ω(e_i, e_j), since ω♭(u)(v) = ω(u, v);
// v = ♯_Λ(α) = Λ α for a bivector Λ_ij = Λ(eⁱ, eʲ), since ⟨β, ♯_Λ(α)⟩ = Λ(β, α).
//
// Every constructor measures: a subspace that is not Dirac (defects above 1e-8), a matrix that
// should be skew and is not, or columns that should be independent and are not throw
// std::domain_error; wrong sizes std::invalid_argument. Sizes may be 0.
class LinearDirac : public PairedSubspace {
 public:
  explicit LinearDirac(const PairedSubspace& subspace);
  explicit LinearDirac(const KernelRepresentation<MatrixXd>& representation);
  explicit LinearDirac(const ImageRepresentation<MatrixXd>& representation);
  explicit LinearDirac(const ConstrainedRepresentation<MatrixXd>& representation);
  explicit LinearDirac(const HybridRepresentation<MatrixXd>& representation);
  explicit LinearDirac(const FormOnSubspace& pair);
  explicit LinearDirac(const BivectorOnSubspace& pair);

  // Example 2.2: F ⊕ F° for the span F of the columns, which may be dependent; the graphs {(v,
  // ω♭v)} and {(♯α, α)}.
  static LinearDirac annihilator_sum(const Eigen::Ref<const MatrixXd>& F);
  static LinearDirac graph_of_form(const Eigen::Ref<const MatrixXd>& omega);
  static LinearDirac graph_of_bivector(const Eigen::Ref<const MatrixXd>& lambda);

  // The graph of an orthogonal matrix O (n × n) in v + α and v - α: scattering or wave variables.
  static LinearDirac from_scattering(const Eigen::Ref<const MatrixXd>& O);

  // The Dirac structure nearest to a subspace that is one up to rounding (dimension n, defects of
  // at most 1e-4; else std::domain_error): for what must be Dirac by theory and lost digits on the
  // way.
  static LinearDirac nearest(const PairedSubspace& subspace);

  // Any D can come out: dim F_D is uniform in 0 … n, the rank of ω_D among the even numbers up to
  // that.
  static LinearDirac random(Index n, std::mt19937& generator);

  // (F_D, ω_D): ω_D(u, v) = α(v) for (u, α) ∈ D; and (F_D^(*), Λ_D): Λ_D(β, α) = β(v) for (v, α) ∈
  // D. Bases are orthonormal.
  FormOnSubspace form() const;
  BivectorOnSubspace bivector() const;
  MatrixXd scattering() const;  // O

  // D as the kernel and as the image of matrices, and with the constraints on v apart (dirac_representations.hpp).
  KernelRepresentation<MatrixXd> kernel_representation() const;
  ImageRepresentation<MatrixXd> image_representation() const;
  ConstrainedRepresentation<MatrixXd> constrained_representation() const;
  // As many v as possible depend on the other variables, or as many α, whichever is more (v in a
  // tie).
  HybridRepresentation<MatrixXd> hybrid_representation() const;

  // {(v, α + B♭v) : (v, α) ∈ D}: F_D stays, ω_D becomes ω_D + B on F_D. B is n × n, skew.
  LinearDirac gauge_transformed(const Eigen::Ref<const MatrixXd>& B) const;

  // "graph of a symplectic form", "F ⊕ F°", …: the most special of the kinds of Example 2.2 that D
  // is.
  std::string kind() const;
};

// Kind, dimensions, and D as equations, from the hybrid representation.
std::ostream& operator<<(std::ostream& out, const LinearDirac& D);

}  // namespace courant
