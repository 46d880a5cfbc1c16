#include "courant/structures/closed_port_hamiltonian.hpp"

#include "courant/structures/matrix_at.hpp"

namespace courant {

namespace {

using ManifoldPointer = std::shared_ptr<const Manifold>;

}  // namespace

ClosedPortHamiltonian::ClosedPortHamiltonian(ManifoldPointer manifold, MatrixField interconnection,
                                             Index m, MatrixField input)
    : DiracStructure("ClosedPortHamiltonian", manifold, m, tangent_size(manifold) + m),
      interconnection_(std::move(interconnection)),
      input_(std::move(input)) {}

ExprVector ClosedPortHamiltonian::do_membership(const ExprVector& x, const ExprVector& v,
                                                const ExprVector& alpha,
                                                const ExprVector& u) const {
  const Index n = manifold()->tangent_dimension();
  return restricted_residual(matrix_at(interconnection_, x, n, n, name(), "J"),
                             matrix_at(input_, x, n, port_size(), name(), "B"), v, alpha, u);
}

}  // namespace courant
