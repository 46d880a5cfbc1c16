// The four point vortices of Section 6.3, in both forms, and what their methods are measured by.
#pragma once

#include <functional>
#include <memory>
#include <numbers>

#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/constrain_first.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/dirac_system.hpp"
#include "courant/structures/poisson.hpp"

namespace courant::vortices {

inline const double kStrength[4] = {1, 1, -1, -1};

inline VectorXd positions() { return (VectorXd(8) << -1, 1, -1, 1, 2, 2, -2, -2).finished(); }

// Equation (9) over unordered pairs.
inline Expr hamiltonian(const ExprVector& q) {
  Expr sum = 0;
  for (Index j = 0; j < 4; ++j)
    for (Index k = j + 1; k < 4; ++k)
      sum += kStrength[j] * kStrength[k] * log(square(q[j] - q[k]) + square(q[4 + j] - q[4 + k]));
  return sum / (4.0 * std::numbers::pi);
}

// α(q) of equation (8).
inline ExprVector alpha(const ExprVector& q) {
  ExprVector result(8);
  for (Index j = 0; j < 4; ++j) {
    result[j] = -0.5 * kStrength[j] * q[4 + j];
    result[4 + j] = 0.5 * kStrength[j] * q[j];
  }
  return result;
}

using OneForm = std::function<ExprVector(const ExprVector& q)>;
using Energy = std::function<Expr(const ExprVector& q)>;

// L = ⟨α(q), q̇⟩ - H(q) on T*Rⁿ (equation (7)).
struct Degenerate {
  Degenerate(Index n, OneForm alpha, Energy H)
      : form(std::move(alpha)),
        base(std::make_shared<Euclidean>(n)),
        phase_space(std::make_shared<CotangentBundle>(base)),
        system(std::make_shared<DiracSystem>(
            std::make_shared<CanonicalSymplectic>(phase_space),
            std::make_shared<Lagrangian>(
                phase_space, [a = form, H](const ExprVector& q, const ExprVector& w, const Expr&) {
                  return a(q).dot(w) - H(q);
                }))) {}

  // The point of M_0 over q.
  VectorXd over(const VectorXd& q) const {
    VectorXd x(2 * q.size());
    x << q, values(form(constants(q)));
    return x;
  }
  std::shared_ptr<const DiscretizationMap> theta(double value) const {
    return std::make_shared<CotangentLift>(phase_space, std::make_shared<Theta>(base, value));
  }
  std::unique_ptr<Integrator> method_1(double theta_value = 0.5) const {
    return std::make_unique<DiscretizeFirst>(system, theta(theta_value));
  }
  std::unique_ptr<Integrator> method_2(const VectorXd& q,
                                       std::shared_ptr<const Projector> projector,
                                       double theta_value = 0.5) const {
    return std::make_unique<ConstrainFirst>(system,
                                            ConstraintAlgorithm().run(system, {.x = over(q)}),
                                            theta(theta_value), std::move(projector));
  }

  OneForm form;
  std::shared_ptr<const Euclidean> base;
  std::shared_ptr<const CotangentBundle> phase_space;
  std::shared_ptr<const DiracSystem> system;
};

inline Degenerate lagrangian_form() { return {8, alpha, hamiltonian}; }

// q̇ = Λ dH(q) on R⁸, equation (6).
inline std::shared_ptr<const DiracSystem> regular_form() {
  const auto M = std::make_shared<Euclidean>(8);
  const auto structure = std::make_shared<Poisson>(M, [](const ExprVector&) {
    ExprMatrix bivector = ExprMatrix::Zero(8, 8);
    for (Index i = 0; i < 4; ++i) {
      bivector(i, 4 + i) = -1.0 / kStrength[i];
      bivector(4 + i, i) = 1.0 / kStrength[i];
    }
    return bivector;
  });
  return std::make_shared<DiracSystem>(
      structure, std::make_shared<Hamiltonian>(
                     M, [](const ExprVector& q, const Expr&) { return hamiltonian(q); }));
}

// D x₁/D x₀ by central differences of order 6: with δ = 10⁻² the error is 10⁻¹² of the seventh
// derivative, and round-off 10⁻¹⁴.
template <class Map>
MatrixXd derivative(const Map& map, const VectorXd& x0, double delta = 1e-2) {
  MatrixXd result;
  for (Index j = 0; j < x0.size(); ++j) {
    const auto at = [&](double s) {
      VectorXd x = x0;
      x[j] += s * delta;
      return VectorXd(map(x));
    };
    const VectorXd column =
        (45.0 * (at(1) - at(-1)) - 9.0 * (at(2) - at(-2)) + (at(3) - at(-3))) / (60.0 * delta);
    if (j == 0) result.resize(column.size(), x0.size());
    result.col(j) = column;
  }
  return result;
}

inline VectorXd one_step(const Integrator& method, const VectorXd& x0, double h) {
  return method.advance({.x = x0}, h).x;
}

}  // namespace courant::vortices
