#include "courant/structures/dirac_structure.hpp"

#include <stdexcept>

#include "courant/core/expressions/derivative.hpp"
#include "courant/structures/blocks.hpp"

namespace courant {

DiracStructure::DiracStructure(std::string name, std::shared_ptr<const Manifold> manifold,
                               Index port_size, Index equation_count,
                               std::vector<std::string> port_names)
    : name_(std::move(name)),
      manifold_(std::move(manifold)),
      port_size_(port_size),
      equation_count_(equation_count),
      port_names_(std::move(port_names)) {
  if (!manifold_) throw std::invalid_argument(name_ + "::DiracStructure: manifold is null.");
  if (port_names_.empty())
    for (Index i = 0; i < port_size_; ++i) port_names_.push_back("u[" + std::to_string(i) + "]");
  if (static_cast<Index>(port_names_.size()) != port_size_)
    throw std::invalid_argument(
        name_ + "::DiracStructure: port_names has " + std::to_string(port_names_.size()) +
        " entries, expected port_size = " + std::to_string(port_size_) + ".");
}

ExprVector DiracStructure::membership(const ExprVector& x, const ExprVector& v,
                                      const ExprVector& alpha, const ExprVector& u) const {
  const auto check = [this](const char* argument, Index size, Index expected) {
    if (size != expected)
      throw std::invalid_argument(name_ + "::membership: " + argument + " has " +
                                  std::to_string(size) + " entries, expected " +
                                  std::to_string(expected) + ".");
  };
  check("x", x.size(), manifold_->ambient_dimension());
  check("v", v.size(), manifold_->tangent_dimension());
  check("alpha", alpha.size(), manifold_->tangent_dimension());
  check("u", u.size(), port_size_);
  ExprVector result = do_membership(x, v, alpha, u);
  check("the residual", result.size(), equation_count_);
  return result;
}

DiracStructure::Matrices DiracStructure::matrices(const VectorXd& x) const {
  const Index n = manifold_->tangent_dimension(), m = port_size_;
  Graph graph;
  const ExprVector z = graph.variables("z", 2 * n + m);
  const ExprVector residual = membership(constants(x), z.head(n), z.segment(n, n), z.tail(m));
  const ExprMatrix derivative = jacobian(residual, z).dense();
  const ExprVector entries =
      substitute(ExprVector(Eigen::Map<const ExprVector>(derivative.data(), derivative.size())), z,
                 ExprVector::Zero(z.size()));
  MatrixXd A(derivative.rows(), derivative.cols());
  A.reshaped() = values(entries);
  if (manifold_->dimension() == n) return {A.leftCols(n), A.middleCols(n, n), A.rightCols(m)};
  const MatrixXd basis = manifold_->tangent_basis(x);
  const MatrixXd covectors = manifold_->tangent_projector(x).transpose() * basis;
  // What a tangent vector or covector says across the tangent space is rounding noise.
  A = with_blocks_in_basis(A, basis, tangent_blocks(), basis.cols());
  return {A.leftCols(n) * basis, A.middleCols(n, n) * covectors, A.rightCols(m)};
}

PairedSubspace DiracStructure::fibre(const VectorXd& x) const {
  const auto [F, E, P] = matrices(x);
  return PairedSubspace::kernel(F, E, P, rounding);
}

}  // namespace courant
