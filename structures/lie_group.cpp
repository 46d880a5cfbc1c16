#include "courant/structures/lie_group.hpp"

#include <algorithm>

#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/special_euclidean3.hpp"
#include "courant/manifolds/special_orthogonal.hpp"
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
  std::vector<std::shared_ptr<const Manifold>> groups = {
      std::make_shared<SpecialOrthogonal3>(), std::make_shared<SpecialEuclidean3>(),
      std::make_shared<Euclidean>(g.dimension())};
  for (Index n = 2; n * (n - 1) / 2 <= g.dimension(); ++n)
    groups.push_back(std::make_shared<SpecialOrthogonal>(n));
  const auto found =
      std::ranges::find_if(groups, [&](const auto& group) { return is_group_of(group, g); });
  return found == groups.end() ? nullptr : *found;
}

namespace {

// The n of the rotations that the points of a group begin with, n × n numbers; 0 if they do not.
Index rotation_size(const Manifold& G) {
  if (const auto* rotations = dynamic_cast<const SpecialOrthogonal*>(&G)) return rotations->size();
  const bool is_of_space = dynamic_cast<const SpecialOrthogonal3*>(&G) != nullptr ||
                           dynamic_cast<const SpecialEuclidean3*>(&G) != nullptr;
  return is_of_space ? 3 : 0;
}

// n × n blocks along the diagonal, d rows in all.
ExprMatrix copies(const ExprVector& rotation, Index n, Index d) {
  ExprMatrix A = ExprMatrix::Zero(d, d);
  for (Index c = 0; c < d; c += n)
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < n; ++j) A(c + i, c + j) = rotation[n * i + j];
  return A;
}

}  // namespace

GroupAction group_action(const Manifold& G, const std::vector<MatrixXd>& rho) {
  const Index d = rho.empty() ? 0 : rho.front().rows();
  if (std::ranges::all_of(rho, [](const MatrixXd& r) { return r.isZero(0.0); }))
    return [d](const ExprVector&) { return ExprMatrix(ExprMatrix::Identity(d, d)); };
  const Index n = rotation_size(G);
  if (n == 0 || d % n != 0 || std::ssize(rho) != G.tangent_dimension()) return {};
  const MatrixXd frame = G.frame(*G.unit());
  for (Index i = 0; i < G.tangent_dimension(); ++i)
    if (rho[static_cast<std::size_t>(i)] != values(copies(constants(frame.col(i)), n, d)))
      return {};
  return [n, d](const ExprVector& x) { return copies(x, n, d); };
}

}  // namespace courant
