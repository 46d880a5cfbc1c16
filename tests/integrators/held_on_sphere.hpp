// A point on a curved set in S³, kept there by a multiplier.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/dirac_system.hpp"

namespace courant::examples {

// E(q, p, λ) = ‖p‖²/2 + V(q) + λ φ(q) on T*S³, with φ = q₀ + 0.3 q₁² + 0.2 q₂q₃ - 0.197 and V = q₃
// + 0.6 q₀q₂, which have no symmetry. M_f has dimension 4.
class Held final : public GeneratingFamily {
 public:
  explicit Held(std::shared_ptr<const Manifold> M) : GeneratingFamily(std::move(M), 1) {}

 private:
  Expr do_value(const ExprVector& x, const ExprVector& lambda, const Expr&) const override {
    const Expr level = x[0] + 0.3 * square(x[1]) + 0.2 * x[2] * x[3] - 0.197;
    return 0.5 * (square(x[4]) + square(x[5]) + square(x[6]) + square(x[7])) + x[3] +
           0.6 * x[0] * x[2] + lambda[0] * level;
  }
};

struct HeldOnSphere {
  std::shared_ptr<const Sphere> sphere = std::make_shared<Sphere>(3);
  std::shared_ptr<const CotangentBundle> M = std::make_shared<CotangentBundle>(sphere);
  std::shared_ptr<const ImplicitSystem> system = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(M), std::make_shared<Held>(M));
  ConstraintLadder ladder = ConstraintAlgorithm().run(
      system, {.x = (VectorXd(8) << 0.1, 0.7, 0.5, -0.5, 0.3, -0.2, 0.1, -0.12).finished()});

  // The greater of |φ(q)| and |⟨dφ(q), p⟩|, from differences of φ along p.
  static double violation(const VectorXd& x) {
    const auto level = [](const VectorXd& q) {
      return q[0] + 0.3 * q[1] * q[1] + 0.2 * q[2] * q[3] - 0.197;
    };
    const VectorXd q = x.head(4), p = x.tail(4);
    // φ is quadratic: the central difference is exact.
    return std::max(std::abs(level(q)), 0.5 * std::abs(level(q + p) - level(q - p)));
  }
};

}  // namespace courant::examples
