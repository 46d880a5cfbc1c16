// A generating family of one's own: an optimal control problem, by Pontryagin's principle.
#include <cmath>
#include <iostream>

#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/dirac_system.hpp"

using namespace courant;

// A cart that is pushed by a force u, at the cost ∫ u²/2 dt: position and velocity q, costates p,
//
//   E(q, p, u) = ⟨p, f(q, u)⟩ - ℓ(q, u),   f = (q[1], u),   ℓ = u²/2.
//
// The submanifold that E generates is {∂_x E : ∂_u E = 0}: the best force is u = p[1].
class CartControl final : public GeneratingFamily {
 public:
  explicit CartControl(std::shared_ptr<const CotangentBundle> phase_space)
      : GeneratingFamily(phase_space, 1) {}

 private:
  Expr do_value(const ExprVector& x, const ExprVector& u, const Expr&) const override {
    const Expr velocity = x[1], p0 = x[2], p1 = x[3];
    return p0 * velocity + p1 * u[0] - square(u[0]) / 2.0;
  }
};

int main() {
  const auto base = std::make_shared<Euclidean>(2);
  const auto phase_space = std::make_shared<CotangentBundle>(base);
  const auto system =
      std::make_shared<DiracSystem>(std::make_shared<CanonicalSymplectic>(phase_space),
                                    std::make_shared<CartControl>(phase_space));

  const VectorXd x = VectorXd{{0.0, 0.0, 12.0, 6.0}};  // at rest; arrives at 1, at rest, at t = 1
  const ConstraintLadder ladder = ConstraintAlgorithm().run(system, {.x = x});
  std::cout << "verdict " << to_string(ladder.verdict) << ", index " << ladder.index
            << ", force at the start " << ladder.point.z[0] << '\n';

  const auto lift = std::make_shared<CotangentLift>(phase_space, std::make_shared<Theta>(base));
  const DiscretizeFirst method(system, lift);
  const VectorXd end = method.advance(ladder.point, 0.01, 100).x;
  std::cout << "at t = 1: position " << end[0] << ", velocity " << end[1] << '\n';
  // The costates are those of the exact solution; the position has the error of the midpoint rule.
  const bool as_known = ladder.verdict == Verdict::regular &&
                        std::abs(ladder.point.z[0] - 6.0) < 1e-12 &&
                        std::abs(end[2] - 12.0) < 1e-12 && std::abs(end[3] + 6.0) < 1e-12 &&
                        std::abs(end[0] - 1.0) < 2e-4 && std::abs(end[1]) < 1e-12;
  return as_known ? 0 : 1;
}
