// Kepler's problem with its solution.
#pragma once

#include <cmath>
#include <memory>

#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/dirac_system.hpp"

namespace courant::examples {

// H = ‖p‖²/2 - 1/‖q‖ on T*R², the ellipse with a = 1 of this eccentricity, from the perihelion; the
// period is 2π.
struct Kepler {
  double eccentricity = 0.9;
  std::shared_ptr<const Euclidean> space = std::make_shared<Euclidean>(2);
  std::shared_ptr<const CotangentBundle> M = std::make_shared<CotangentBundle>(space);
  std::shared_ptr<const DiracSystem> system = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(M),
      std::make_shared<Hamiltonian>(M, [](const ExprVector& x, const Expr&) {
        return 0.5 * (square(x[2]) + square(x[3])) - 1.0 / radius(x);
      }));

  static Expr radius(const ExprVector& x) { return sqrt(square(x[0]) + square(x[1])); }
  static double energy(const VectorXd& x) {
    return 0.5 * x.tail(2).squaredNorm() - 1.0 / x.head(2).norm();
  }
  // Kepler's equation t = u - e sin u, by Newton's method.
  VectorXd at(double t) const {
    const double e = eccentricity, turns = std::round(t / (2.0 * M_PI)) * 2.0 * M_PI;
    const double m = t - turns;
    double u = m > 0.0 ? M_PI / 2.0 : m < 0.0 ? -M_PI / 2.0 : 0.0;
    for (int i = 0; i < 100; ++i) u -= (u - e * std::sin(u) - m) / (1.0 - e * std::cos(u));
    const double b = std::sqrt(1.0 - e * e), rate = 1.0 / (1.0 - e * std::cos(u));
    return Eigen::Vector4d(std::cos(u) - e, b * std::sin(u), -std::sin(u) * rate,
                           b * std::cos(u) * rate);
  }
};

}  // namespace courant::examples
