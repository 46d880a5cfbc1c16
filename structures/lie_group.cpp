#include "courant/structures/lie_group.hpp"

#include <algorithm>

#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/special_euclidean3.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"

namespace courant {

bool is_group_of(const std::shared_ptr<const Manifold>& G, const LieAlgebra& g) {
  const auto unit = G->unit();
  const Index n = g.dimension();
  if (!unit || G->tangent_dimension() != n) return false;
  const CotangentBundle T(G);
  const ExprVector e = constants(*unit);
  for (Index k = 0; k < n; ++k)
    for (Index i = 0; i < n; ++i) {
      const VectorXd torsion = values(T.torsion(e, ExprVector::Unit(n, k), ExprVector::Unit(n, i)));
      const VectorXd bracket = g.constants()[static_cast<std::size_t>(k)].row(i);
      if (!((torsion + bracket).cwiseAbs().maxCoeff() <= 1e-12)) return false;
    }
  return true;
}

std::shared_ptr<const Manifold> group_of(const LieAlgebra& g) {
  const std::vector<std::shared_ptr<const Manifold>> groups = {
      std::make_shared<SpecialOrthogonal3>(), std::make_shared<SpecialEuclidean3>(),
      std::make_shared<Euclidean>(g.dimension())};
  const auto found =
      std::ranges::find_if(groups, [&](const auto& group) { return is_group_of(group, g); });
  return found == groups.end() ? nullptr : *found;
}

namespace {

// Whether ρ turns each of the copies of R³: e_i × for the first three components, which are those of
// the angular velocity, 0 for the others.
bool is_rotation(const std::vector<MatrixXd>& rho) {
  for (std::size_t i = 0; i < rho.size(); ++i) {
    MatrixXd expected = MatrixXd::Zero(rho[i].rows(), rho[i].cols());
    if (i < 3)
      for (Index c = 0; c + 3 <= expected.rows(); c += 3) {
        const auto k = static_cast<Index>(i);
        expected(c + (k + 2) % 3, c + (k + 1) % 3) = 1.0;
        expected(c + (k + 1) % 3, c + (k + 2) % 3) = -1.0;
      }
    if (rho[i] != expected) return false;
  }
  return true;
}

}  // namespace

GroupAction group_action(const Manifold& G, const std::vector<MatrixXd>& rho) {
  const Index d = rho.empty() ? 0 : rho.front().rows();
  if (std::ranges::all_of(rho, [](const MatrixXd& r) { return r.isZero(0.0); }))
    return [d](const ExprVector&) { return ExprMatrix(ExprMatrix::Identity(d, d)); };
  const bool turns = dynamic_cast<const SpecialOrthogonal3*>(&G) != nullptr ||
                     dynamic_cast<const SpecialEuclidean3*>(&G) != nullptr;
  if (!turns || d % 3 != 0 || std::ssize(rho) != G.tangent_dimension() || !is_rotation(rho))
    return {};
  return [d](const ExprVector& x) {
    ExprMatrix A = ExprMatrix::Zero(d, d);
    for (Index c = 0; c < d; c += 3)
      for (Index i = 0; i < 3; ++i)
        for (Index j = 0; j < 3; ++j) A(c + i, c + j) = x[3 * i + j];
    return A;
  };
}

}  // namespace courant
