// Method 2 step by step: a degenerate Lagrangian, its ladder, and a discretization on what the
// ladder ends at; then the same with a projector of one's own.
#include <cmath>
#include <iostream>

#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/constrain_first.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/dirac_system.hpp"

using namespace courant;

// The point of M_f that is nearest where momenta cost more than positions: W = G⁻¹ C with the
// metric G = diag(1, …, 1, w, …, w), C the conormals of M_f.
class WeightedProjector final : public Projector {
 public:
  explicit WeightedProjector(double weight) : Projector("weighted"), weight_(weight) {}

 private:
  // T*R² has no tangents Π but the identity, so conormals are C itself.
  ExprMatrix do_directions(const ExprVector&, const Expr&, const LinearMap<Expr>&,
                           const ExprMatrix& conormals) const override {
    ExprMatrix directions = conormals;
    directions.bottomRows(directions.rows() / 2) /= Expr(weight_);
    return directions;
  }
  double weight_;
};

int main() {
  // L(q, w) = ½ (q₀ w₁ - q₁ w₀) - ½ |q|² says p = ½ (-q₁, q₀), and q turns with angular velocity 1.
  const auto base = std::make_shared<Euclidean>(2);
  const auto phase_space = std::make_shared<CotangentBundle>(base);
  const auto lagrangian = std::make_shared<Lagrangian>(
      phase_space, [](const ExprVector& q, const ExprVector& w, const Expr&) {
        return 0.5 * (q[0] * w[1] - q[1] * w[0]) - 0.5 * q.squaredNorm();
      });
  const auto system =
      std::make_shared<DiracSystem>(std::make_shared<CanonicalSymplectic>(phase_space), lagrangian);

  // The certificate: M_f has dimension 2, and each of its points one velocity.
  const VectorXd guess = VectorXd{{1.0, 0.0, 0.0, 0.5}};
  const ConstraintLadder ladder = ConstraintAlgorithm().run(system, {.x = guess});
  for (const LadderLevel& level : ladder.levels)
    std::cout << "S_" << level.k << ": dimension " << level.dim_S << " over M_" << level.k
              << ": dimension " << level.dim_M << '\n';
  std::cout << "verdict: " << to_string(ladder.verdict) << '\n';
  bool as_known = ladder.verdict == Verdict::regular && ladder.degrees_of_freedom == 2;

  const auto map = std::make_shared<CotangentLift>(phase_space, std::make_shared<Theta>(base));
  const std::shared_ptr<const Projector> projectors[] = {
      std::make_shared<OrthogonalProjector>(), std::make_shared<MomentumProjector>(phase_space),
      std::make_shared<WeightedProjector>(10.0)};
  for (const auto& projector : projectors) {
    const ConstrainFirst method(system, ladder, map, projector);
    const auto error = [&](int steps) {
      const VectorXd x = method.advance(ladder.point, 1.0 / steps, steps).x;
      // On M_f to round-off, whatever the step.
      as_known = as_known && std::hypot(x[2] + x[1] / 2.0, x[3] - x[0] / 2.0) < 1e-14;
      return std::hypot(x[0] - std::cos(1.0), x[1] - std::sin(1.0));
    };
    const double ratio = error(20) / error(40);
    std::cout << "projector " << projector->name() << ": half the step, error divided by " << ratio
              << '\n';
    as_known = as_known && std::abs(ratio - 4.0) < 0.1;
  }
  return as_known ? 0 : 1;
}
