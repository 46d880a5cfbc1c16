// Lie algebras by their structure constants.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "courant/manifolds/matrix_algebra.hpp"

namespace courant {

// A real Lie algebra g of dimension n: [e_i, e_j] = Σ_k c^k_ij e_k.
//
// Laws, checked on construction: c^k_ij = -c^k_ji, and the Jacobi identity
// [e_i, [e_j, e_k]] + [e_j, [e_k, e_i]] + [e_k, [e_i, e_j]] = 0.
class LieAlgebra {
 public:
  // constants[k](i, j) = c^k_ij, n matrices n × n. Throws std::invalid_argument on wrong sizes,
  // std::domain_error if a law fails by more than 1e-12 of the largest constant. `basis` has the names of the e_i for
  // messages; by default e_0, e_1, …
  LieAlgebra(std::string name, std::vector<Eigen::MatrixXd> constants,
             const std::vector<std::string>& basis = {});

  // That of matrices, in their basis.
  explicit LieAlgebra(const MatrixAlgebra& matrices);

  // Rⁿ with the zero bracket.
  static LieAlgebra abelian(Eigen::Index n);
  // so(3) = R³ with [a, b] = a × b.
  static LieAlgebra so3();
  // so(n), the skew matrices with the commutator, n ≥ 0, in the basis E_ij = e_i e_jᵀ - e_j e_iᵀ,
  // i < j, ordered (0,1), (0,2), …, (1,2), …
  static LieAlgebra so(Eigen::Index n);
  // g ⋉ V for a representation of g on V = R^d, matrices ρ_i = ρ(e_i):
  // [(a, x), (b, y)] = ([a, b], ρ(a) y - ρ(b) x). Throws std::domain_error unless
  // ρ([a, b]) = ρ(a) ρ(b) - ρ(b) ρ(a).
  static LieAlgebra semidirect(const LieAlgebra& g, const std::vector<Eigen::MatrixXd>& rho);
  // se(3) = so(3) ⋉ R³, (ω, v).
  static LieAlgebra se3();

  const std::string& name() const { return name_; }
  Eigen::Index dimension() const { return static_cast<Eigen::Index>(constants_.size()); }
  const std::vector<Eigen::MatrixXd>& constants() const { return constants_; }
  // The matrices that it was made of, or null.
  const std::shared_ptr<const MatrixAlgebra>& matrices() const { return matrices_; }
  Eigen::VectorXd bracket(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const;

 private:
  std::string name_;
  std::vector<Eigen::MatrixXd> constants_;
  std::shared_ptr<const MatrixAlgebra> matrices_;
};

}  // namespace courant
