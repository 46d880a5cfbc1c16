// Structures made of other structures: one translation unit for all.
#include <algorithm>
#include <stdexcept>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/structures/composed.hpp"
#include "courant/structures/gauge_transformed.hpp"
#include "courant/structures/product_structure.hpp"
#include "courant/structures/pullback.hpp"
#include "courant/structures/pushforward.hpp"

namespace courant {
namespace {

using ManifoldPointer = std::shared_ptr<const Manifold>;
using StructurePointer = std::shared_ptr<const DiracStructure>;
using StructurePointers = std::vector<StructurePointer>;

// For the first argument of a base in braces, which evaluate from left to right: what is null is
// refused before it is used.
const DiracStructure& not_null(const StructurePointer& structure, const std::string& where) {
  if (!structure) throw std::invalid_argument(where + ": a structure is null.");
  return *structure;
}

void require_size(const std::string& where, const std::string& what, Index size, Index expected) {
  if (size == expected) return;
  throw std::invalid_argument(where + ": " + what + " is " + std::to_string(size) + "; expected " +
                              std::to_string(expected) + ".");
}

Index sum(const StructurePointers& factors, Index (DiracStructure::*size)() const) {
  Index total = 0;
  for (const StructurePointer& factor : factors)
    total += (not_null(factor, "ProductStructure").*size)();
  return total;
}

std::shared_ptr<const Product> product_of(const StructurePointers& factors) {
  std::vector<ManifoldPointer> manifolds;
  for (const StructurePointer& factor : factors)
    manifolds.push_back(not_null(factor, "ProductStructure").manifold());
  return std::make_shared<Product>(manifolds);
}

}  // namespace

GaugeTransformed::GaugeTransformed(StructurePointer structure, MatrixField form)
    : DiracStructure{"GaugeTransformed(" + not_null(structure, "GaugeTransformed").name() + ")",
                     structure->manifold(), structure->port_size(), structure->equation_count(),
                     structure->port_names()},
      structure_(std::move(structure)),
      form_(std::move(form)) {}

ExprVector GaugeTransformed::do_membership(const ExprVector& x, const ExprVector& v,
                                           const ExprVector& alpha, const ExprVector& u) const {
  const ExprMatrix B = form_(x);
  const Index n = manifold()->tangent_dimension();
  require_size(name() + "::membership", "the number of rows of the form", B.rows(), n);
  require_size(name() + "::membership", "the number of columns of the form", B.cols(), n);
  const ExprMatrix projector = manifold()->tangent_projector(x);
  const ExprVector shift = projector.transpose().eval() * (B.transpose().eval() * (projector * v));
  return structure_->membership(x, v, alpha - shift, u);
}

ProductStructure::ProductStructure(StructurePointers factors)
    : ProductStructure(factors, product_of(factors)) {}

ProductStructure::ProductStructure(StructurePointers factors,
                                   std::shared_ptr<const Product> manifold)
    : DiracStructure("ProductStructure", manifold, sum(factors, &DiracStructure::port_size),
                     sum(factors, &DiracStructure::equation_count)),
      factors_(std::move(factors)),
      product_(std::move(manifold)) {
  const std::string where = "ProductStructure::ProductStructure";
  require_size(where, "the number of factors of the manifold",
               static_cast<Index>(product_->factors().size()), static_cast<Index>(factors_.size()));
  for (std::size_t i = 0; i < factors_.size(); ++i) {
    const Manifold &given = *product_->factors()[i], &own = *factors_[i]->manifold();
    require_size(where, "the ambient dimension of a factor", given.ambient_dimension(),
                 own.ambient_dimension());
    require_size(where, "the tangent dimension of a factor", given.tangent_dimension(),
                 own.tangent_dimension());
  }
}

bool ProductStructure::is_dirac() const {
  return std::ranges::all_of(factors_, [](const auto& factor) { return factor->is_dirac(); });
}

ExprVector ProductStructure::do_membership(const ExprVector& x, const ExprVector& v,
                                           const ExprVector& alpha, const ExprVector& u) const {
  ExprVector residual(equation_count());
  Index equation = 0, port = 0;
  for (std::size_t i = 0; i < factors_.size(); ++i) {
    const DiracStructure& factor = *factors_[i];
    residual.segment(equation, factor.equation_count()) =
        factor.membership(product_->point_part(x, i), product_->tangent_part(v, i),
                          product_->tangent_part(alpha, i), u.segment(port, factor.port_size()));
    equation += factor.equation_count();
    port += factor.port_size();
  }
  return residual;
}

Composed::Composed(StructurePointer A, ManifoldPointer M_A, StructurePointer B, ManifoldPointer M_B,
                   Index shared)
    : DiracStructure{"Composed(" + not_null(A, "Composed").name() + ", " +
                         not_null(B, "Composed").name() + ")",
                     std::make_shared<Product>(std::vector<ManifoldPointer>{M_A, M_B}),
                     A->port_size() + B->port_size() + 2 * shared,
                     A->equation_count() + B->equation_count()},
      A_(std::move(A)),
      B_(std::move(B)),
      M_A_(std::move(M_A)),
      M_B_(std::move(M_B)),
      shared_(shared) {
  const auto check = [&](const char* which, const Manifold& whole, const Manifold& part) {
    const std::string where = name() + "::Composed";
    const std::string at = std::string(" of the manifold of ") + which;
    require_size(where, "the ambient dimension" + at, whole.ambient_dimension(),
                 part.ambient_dimension() + shared);
    require_size(where, "the tangent dimension" + at, whole.tangent_dimension(),
                 part.tangent_dimension() + shared);
  };
  check("A", *A_->manifold(), *M_A_);
  check("B", *B_->manifold(), *M_B_);
}

ExprVector Composed::do_membership(const ExprVector& x, const ExprVector& v,
                                   const ExprVector& alpha, const ExprVector& u) const {
  const Index N = M_A_->ambient_dimension(), n = M_A_->tangent_dimension();
  const Index of_A = A_->port_size(), of_B = B_->port_size();
  const ExprVector f = u.segment(of_A + of_B, shared_), e = u.tail(shared_);
  const ExprVector origin = ExprVector::Zero(shared_);
  const auto after = [](const ExprVector& vector, Index count) {
    return ExprVector(vector.tail(vector.size() - count));
  };
  return joined(A_->membership(joined(x.head(N), origin), joined(v.head(n), f),
                               joined(alpha.head(n), e), u.head(of_A)),
                B_->membership(joined(after(x, N), origin), joined(after(v, n), -f),
                               joined(after(alpha, n), e), u.segment(of_A, of_B)));
}

SmoothMap::SmoothMap(ManifoldPointer source, ManifoldPointer target, Formula formula)
    : source_(std::move(source)), target_(std::move(target)), formula_(std::move(formula)) {
  if (!source_ || !target_) throw std::invalid_argument("SmoothMap: a manifold is null.");
}

ExprVector SmoothMap::operator()(const ExprVector& x) const {
  require_size("SmoothMap", "the size of x", x.size(), source_->ambient_dimension());
  ExprVector y = formula_(x);
  require_size("SmoothMap", "the size of the value", y.size(), target_->ambient_dimension());
  return y;
}

ExprMatrix SmoothMap::tangent(const ExprVector& x) const {
  Graph graph;
  const ExprVector point = graph.variables("x", x.size());
  const ExprMatrix derivative = jacobian((*this)(point), point).dense();
  const ExprMatrix local = target_->coframe((*this)(point)) * (derivative * source_->frame(point));
  const ExprVector entries =
      substitute(ExprVector(Eigen::Map<const ExprVector>(local.data(), local.size())), point, x);
  return Eigen::Map<const ExprMatrix>(entries.data(), local.rows(), local.cols());
}

Pullback::Pullback(SmoothMap phi, StructurePointer structure)
    : DiracStructure{"Pullback(" + not_null(structure, "Pullback").name() + ")", phi.source(),
                     structure->port_size() + phi.target()->tangent_dimension(),
                     structure->equation_count() + phi.source()->tangent_dimension()},
      phi_(std::move(phi)),
      structure_(std::move(structure)) {
  if (*phi_.target() != *structure_->manifold())
    throw std::invalid_argument(name() + "::Pullback: phi leads to " + phi_.target()->name() +
                                "; expected the manifold of the structure, " +
                                structure_->manifold()->name() + ".");
}

ExprVector Pullback::do_membership(const ExprVector& y, const ExprVector& v,
                                   const ExprVector& alpha, const ExprVector& u) const {
  const ExprMatrix tangent = phi_.tangent(y);
  const ExprVector image = phi_(y);
  const ExprVector beta = phi_.target()->tangent_projector(image).transpose() *
                          ExprVector(u.tail(phi_.target()->tangent_dimension()));
  return joined(structure_->membership(image, tangent * v, beta, u.head(structure_->port_size())),
                alpha - tangent.transpose().eval() * beta);
}

Pushforward::Pushforward(SmoothMap phi, SmoothMap section, StructurePointer structure)
    : DiracStructure{"Pushforward(" + not_null(structure, "Pushforward").name() + ")", phi.target(),
                     structure->port_size() + phi.source()->tangent_dimension(),
                     structure->equation_count() + phi.target()->tangent_dimension()},
      phi_(std::move(phi)),
      section_(std::move(section)),
      structure_(std::move(structure)) {
  if (*phi_.source() != *structure_->manifold() || *section_.target() != *phi_.source() ||
      *section_.source() != *phi_.target())
    throw std::invalid_argument(
        name() +
        "::Pushforward: phi and section do not fit the structure; expected phi from the "
        "manifold of the structure, and section back to it.");
}

ExprVector Pushforward::do_membership(const ExprVector& y, const ExprVector& v,
                                      const ExprVector& alpha, const ExprVector& u) const {
  const ExprVector x = section_(y);
  const ExprMatrix tangent = phi_.tangent(x);
  const ExprVector w =
      phi_.source()->tangent_projector(x) * ExprVector(u.tail(phi_.source()->tangent_dimension()));
  return joined(structure_->membership(x, w, tangent.transpose().eval() * alpha,
                                       u.head(structure_->port_size())),
                v - tangent * w);
}

}  // namespace courant
