// The structures that matrix fields describe: few lines each, one translation unit for all.
#include <stdexcept>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/words/message.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/product.hpp"
#include "courant/structures/closed_port_hamiltonian.hpp"
#include "courant/structures/distribution.hpp"
#include "courant/structures/lie_group.hpp"
#include "courant/structures/lie_poisson.hpp"
#include "courant/structures/open_port_hamiltonian.hpp"
#include "courant/structures/poisson.hpp"
#include "courant/structures/presymplectic.hpp"
#include "courant/structures/restricted_bivector.hpp"
#include "courant/structures/restricted_two_form.hpp"

namespace courant {
namespace {

using ManifoldPointer = std::shared_ptr<const Manifold>;

Index tangent_size(const ManifoldPointer& manifold) {
  return manifold ? manifold->tangent_dimension() : 0;
}

// A(x), of the size that it has to be.
ExprMatrix at(const MatrixField& field, const ExprVector& x, Index rows, Index columns,
              const std::string& name, const char* matrix) {
  ExprMatrix value = field(x);
  if (value.rows() == rows && value.cols() == columns) return value;
  throw std::invalid_argument(name + "::membership: " + matrix + " is " +
                              size_text(value.rows(), value.cols()) + "; expected " +
                              size_text(rows, columns) + ".");
}

// v = Λ α + X λ, Xᵀα = 0, as a residual.
ExprVector restricted(const ExprMatrix& lambda, const ExprMatrix& X, const ExprVector& v,
                      const ExprVector& alpha, const ExprVector& u) {
  return joined(v - lambda * alpha - X * u, X.transpose().eval() * alpha);
}

}  // namespace

Poisson::Poisson(ManifoldPointer manifold, Bivector bivector)
    : DiracStructure("Poisson", manifold, 0, tangent_size(manifold)),
      bivector_(std::move(bivector)) {}

ExprVector Poisson::do_membership(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                                  const ExprVector&) const {
  const Index n = manifold()->tangent_dimension();
  return v - at(bivector_, x, n, n, name(), "the bivector") * alpha;
}

Presymplectic::Presymplectic(ManifoldPointer manifold, MatrixField form)
    : DiracStructure("Presymplectic", manifold, 0, tangent_size(manifold)),
      form_(std::move(form)) {}

ExprVector Presymplectic::do_membership(const ExprVector& x, const ExprVector& v,
                                        const ExprVector& alpha, const ExprVector&) const {
  const Index n = manifold()->tangent_dimension();
  const ExprMatrix omega = at(form_, x, n, n, name(), "the form").transpose();
  const ExprMatrix projector = manifold()->tangent_projector(x);
  return alpha - projector.transpose().eval() * (omega * (projector * v));
}

Distribution::Distribution(std::string name, ManifoldPointer manifold, Index count,
                           MatrixField columns, By by)
    : DiracStructure(std::move(name), manifold, count, tangent_size(manifold) + count),
      columns_(std::move(columns)),
      by_(by) {}

Distribution Distribution::annihilated_by(ManifoldPointer manifold, Index m,
                                          MatrixField one_forms) {
  return {"Distribution", std::move(manifold), m, std::move(one_forms), By::one_forms};
}

Distribution Distribution::spanned_by(ManifoldPointer manifold, Index k, MatrixField fields) {
  return {"Distribution", std::move(manifold), k, std::move(fields), By::fields};
}

ExprVector Distribution::do_membership(const ExprVector& x, const ExprVector& v,
                                       const ExprVector& alpha, const ExprVector& u) const {
  const ExprMatrix A =
      at(columns_, x, manifold()->tangent_dimension(), port_size(), name(),
         by_ == By::fields ? "the matrix of the fields" : "the matrix of the one-forms");
  const ExprMatrix projector = manifold()->tangent_projector(x);
  const ExprMatrix transposed = A.transpose();
  if (by_ == By::fields) return joined(v - projector * (A * u), transposed * alpha);
  return joined(alpha - projector.transpose().eval() * (A * u), transposed * v);
}

RestrictedTwoForm::RestrictedTwoForm(ManifoldPointer manifold, MatrixField form, Index m,
                                     MatrixField one_forms)
    : DiracStructure("RestrictedTwoForm", manifold, m, tangent_size(manifold) + m),
      form_(std::move(form)),
      one_forms_(std::move(one_forms)) {}

ExprVector RestrictedTwoForm::do_membership(const ExprVector& x, const ExprVector& v,
                                            const ExprVector& alpha, const ExprVector& u) const {
  const Index n = manifold()->tangent_dimension();
  const ExprMatrix omega = at(form_, x, n, n, name(), "the form").transpose();
  const ExprMatrix mu = at(one_forms_, x, n, port_size(), name(), "the matrix of the one-forms");
  const ExprMatrix projector = manifold()->tangent_projector(x);
  const ExprVector covector = omega * (projector * v) + mu * u;
  return joined(alpha - projector.transpose().eval() * covector, mu.transpose().eval() * v);
}

RestrictedBivector::RestrictedBivector(ManifoldPointer manifold, MatrixField bivector, Index k,
                                       MatrixField fields)
    : DiracStructure("RestrictedBivector", manifold, k, tangent_size(manifold) + k),
      bivector_(std::move(bivector)),
      fields_(std::move(fields)) {}

ExprVector RestrictedBivector::do_membership(const ExprVector& x, const ExprVector& v,
                                             const ExprVector& alpha, const ExprVector& u) const {
  const Index n = manifold()->tangent_dimension();
  return restricted(at(bivector_, x, n, n, name(), "the bivector"),
                    at(fields_, x, n, port_size(), name(), "the matrix of the fields"), v, alpha,
                    u);
}

OpenPortHamiltonian::OpenPortHamiltonian(ManifoldPointer manifold, MatrixField interconnection,
                                         Index m, MatrixField input)
    : DiracStructure("OpenPortHamiltonian", manifold, m, tangent_size(manifold)),
      interconnection_(std::move(interconnection)),
      input_(std::move(input)) {}

ExprVector OpenPortHamiltonian::output(const ExprVector& x, const ExprVector& alpha) const {
  const Index n = manifold()->tangent_dimension();
  return at(input_, x, n, port_size(), name(), "B").transpose().eval() * alpha;
}

ExprVector OpenPortHamiltonian::do_membership(const ExprVector& x, const ExprVector& v,
                                              const ExprVector& alpha, const ExprVector& u) const {
  const Index n = manifold()->tangent_dimension();
  return v - at(interconnection_, x, n, n, name(), "J") * alpha -
         at(input_, x, n, port_size(), name(), "B") * u;
}

ClosedPortHamiltonian::ClosedPortHamiltonian(ManifoldPointer manifold, MatrixField interconnection,
                                             Index m, MatrixField input)
    : DiracStructure("ClosedPortHamiltonian", manifold, m, tangent_size(manifold) + m),
      interconnection_(std::move(interconnection)),
      input_(std::move(input)) {}

ExprVector ClosedPortHamiltonian::do_membership(const ExprVector& x, const ExprVector& v,
                                                const ExprVector& alpha,
                                                const ExprVector& u) const {
  const Index n = manifold()->tangent_dimension();
  return restricted(at(interconnection_, x, n, n, name(), "J"),
                    at(input_, x, n, port_size(), name(), "B"), v, alpha, u);
}

LiePoisson::LiePoisson(const LieAlgebra& algebra, Sign sign)
    : LiePoisson(algebra, std::make_shared<Euclidean>(algebra.dimension()), sign) {}

LiePoisson::LiePoisson(const LieAlgebra& algebra, ManifoldPointer manifold, Sign sign)
    : DiracStructure("LiePoisson(" + algebra.name() + ")", manifold, 0, algebra.dimension()),
      algebra_(algebra),
      acting_(algebra),
      sign_(sign) {
  const Index n = algebra.dimension();
  if (manifold->dimension() != n || manifold->ambient_dimension() != n)
    throw std::invalid_argument(name() + "::LiePoisson: manifold is " + manifold->name() +
                                "; expected an open subset of R^" + std::to_string(n) + ".");
}

namespace {

LieAlgebra whole(const LieAlgebra& g, const std::vector<MatrixXd>& rho) {
  return rho.empty() ? g : LieAlgebra::semidirect(g, rho);
}
ManifoldPointer with_attitude(Index size, const ManifoldPointer& group) {
  const auto flat = std::make_shared<Euclidean>(size);
  if (!group) return flat;
  return std::make_shared<Product>(std::vector<ManifoldPointer>{flat, group});
}

}  // namespace

LiePoisson::LiePoisson(const LieAlgebra& g, std::vector<MatrixXd> rho, Sign sign,
                       ManifoldPointer group)
    : DiracStructure(
          "LiePoisson(" + whole(g, rho).name() + (group ? ", " + group->name() : "") + ")",
          with_attitude(whole(g, rho).dimension(), group), 0,
          whole(g, rho).dimension() + (group ? group->tangent_dimension() : 0)),
      algebra_(whole(g, rho)),
      acting_(g),
      representation_(std::move(rho)),
      sign_(sign),
      group_(std::move(group)) {
  if (!group_) return;
  if (sign == Sign::plus)
    throw std::invalid_argument(name() +
                                "::LiePoisson: there is a group, and the sign is plus; expected "
                                "minus, of left-invariant systems.");
  if (!is_group_of(group_, acting_))
    throw std::domain_error(name() + "::LiePoisson: " + acting_.name() +
                            " is not the Lie algebra of " + group_->name() +
                            "; expected the brackets of its left-invariant fields.");
}

ExprMatrix LiePoisson::bivector(const ExprVector& mu) const {
  const Index n = algebra_.dimension();
  const double sign = sign_ == Sign::minus ? -1.0 : 1.0;
  const Index g = group_ ? acting_.dimension() : 0;
  ExprMatrix result = ExprMatrix::Zero(n + g, n + g);
  for (Index i = 0; i < g; ++i) {
    result(i, n + i) = -1.0;
    result(n + i, i) = 1.0;
  }
  for (Index k = 0; k < n; ++k)
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < n; ++j)
        if (const double c = algebra_.constants()[static_cast<std::size_t>(k)](i, j); c != 0.0)
          result(i, j) += sign * c * mu[k];
  return result;
}

ExprVector LiePoisson::do_membership(const ExprVector& mu, const ExprVector& v,
                                     const ExprVector& alpha, const ExprVector&) const {
  return v - bivector(mu) * alpha;
}

}  // namespace courant
