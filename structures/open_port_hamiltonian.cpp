#include "courant/structures/open_port_hamiltonian.hpp"

#include "courant/structures/matrix_at.hpp"

namespace courant {

namespace {

using ManifoldPointer = std::shared_ptr<const Manifold>;

}  // namespace

OpenPortHamiltonian::OpenPortHamiltonian(ManifoldPointer manifold, MatrixField interconnection,
                                         Index m, MatrixField input)
    : DiracStructure("OpenPortHamiltonian", manifold, m, tangent_size(manifold)),
      interconnection_(std::move(interconnection)),
      input_(std::move(input)) {}

ExprVector OpenPortHamiltonian::output(const ExprVector& x, const ExprVector& alpha) const {
  const Index n = manifold()->tangent_dimension();
  return matrix_at(input_, x, n, port_size(), name(), "B").transpose().eval() * alpha;
}

ExprVector OpenPortHamiltonian::do_membership(const ExprVector& x, const ExprVector& v,
                                              const ExprVector& alpha, const ExprVector& u) const {
  const Index n = manifold()->tangent_dimension();
  return v - matrix_at(interconnection_, x, n, n, name(), "J") * alpha -
         matrix_at(input_, x, n, port_size(), name(), "B") * u;
}

}  // namespace courant
