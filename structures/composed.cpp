#include "courant/structures/composed.hpp"

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/structures/structure_checks.hpp"

namespace courant {

namespace {

using ManifoldPointer = std::shared_ptr<const Manifold>;
using StructurePointer = std::shared_ptr<const DiracStructure>;

}  // namespace

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
    require_equal(where, "the ambient dimension" + at, whole.ambient_dimension(),
                  part.ambient_dimension() + shared);
    require_equal(where, "the tangent dimension" + at, whole.tangent_dimension(),
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

}  // namespace courant
