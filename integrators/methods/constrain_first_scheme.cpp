#include "courant/integrators/methods/constrain_first_scheme.hpp"

#include <stdexcept>

#include "courant/core/linear/qr_decomposition.hpp"

namespace courant {
namespace {

// W if it is the same at every x, as for momenta that positions determine; empty otherwise.
MatrixXd fixed_directions(const Manifold& M, const Projector& projector,
                          const ConstraintLadder& ladder) {
  const Index n = M.dimension(), d = n - ladder.degrees_of_freedom;
  if (d == 0 || n != M.tangent_dimension() || !projector.has_constant_directions(d)) return {};
  MatrixXd W =
      projector.directions(ladder.point.x, LinearMap<double>::identity(n),
                           orthonormalized(ladder.conormals().transpose()), ladder.point.t);
  // Unit vectors where their span is the same: formulas become simpler.
  constexpr double round_off = 1e-12;
  const MatrixXd onto = W * W.transpose(), rounded = onto.array().round();
  if ((onto - rounded).norm() > round_off) return W;
  MatrixXd units(n, d);
  Index column = 0;
  for (Index i = 0; i < n; ++i)
    if (rounded(i, i) == 1.0) units.col(column++) = VectorXd::Unit(n, i);
  return units;
}

}  // namespace

ConstrainFirstScheme::ConstrainFirstScheme(std::shared_ptr<const ImplicitSystem> of,
                                           const ConstraintLadder& of_system,
                                           std::shared_ptr<const DiscretizationMap> by,
                                           std::shared_ptr<const Projector> onto, bool keeps_all)
    : system(std::move(of)),
      ladder(std::make_shared<const ConstraintLadder>(of_system)),
      map(std::move(by)),
      projector(std::move(onto)),
      keeps_all_equations(keeps_all) {
  if (!map || !projector || *map->manifold() != manifold())
    throw std::invalid_argument(
        "ConstrainFirst::ConstrainFirst: the system, the map or the projector is missing, or the "
        "map is not on the manifold of the system.");
  if (ladder->verdict != Verdict::regular && ladder->verdict != Verdict::gauge)
    throw std::invalid_argument("ConstrainFirst::ConstrainFirst: the ladder's verdict is " +
                                to_string(ladder->verdict) + "; expected regular or gauge. " +
                                ladder->reason);
  check_ladder("ConstrainFirst::ConstrainFirst", *system, *ladder);
  fixed_directions = courant::fixed_directions(manifold(), *projector, *ladder);
}

}  // namespace courant
