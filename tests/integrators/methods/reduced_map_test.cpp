#include "courant/integrators/methods/reduced_map.hpp"

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bracket_defect.hpp"
#include "courant/integrators/maps/cayley_midpoint.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/composition.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/measurement.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/euler_poincare.hpp"
#include "courant/structures/representation.hpp"

// Mistakes that these cases have to notice:
//  * advected parameters are turned by half a step
//  * right-invariant systems go the other way
//  * the attitude goes on to the stage
//  * torques are those of the beginning
//  * the stage of maps without an inverse is the start (integrators/step/stage_step.cpp)
BOOST_AUTO_TEST_SUITE(reduced_map)

using namespace courant;

namespace {

using V = const ExprVector&;
using T = const Expr&;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using MapPointer = std::shared_ptr<const DiscretizationMap>;

const auto rotations = std::make_shared<SpecialOrthogonal3>();
const auto motions = std::make_shared<SpecialEuclidean3>();
const MapPointer cayley = std::make_shared<CayleyMidpoint>(rotations);
const MapPointer exponential = std::make_shared<Theta>(rotations);

std::vector<MatrixXd> turns() {
  std::vector<MatrixXd> rho;
  for (Index i = 0; i < 3; ++i) {
    rho.push_back(MatrixXd::Zero(3, 3));
    rho.back()((i + 2) % 3, (i + 1) % 3) = 1.0;
    rho.back()((i + 1) % 3, (i + 2) % 3) = -1.0;
  }
  return rho;
}

// Quadratic in μ and not: nothing cancels.
Expr spin(V mu, V, T) {
  return 0.5 * (square(mu[0]) + square(mu[1]) / 2.0 + square(mu[2]) / 0.7) +
         0.1 * square(mu[0] * mu[1]) + 0.2 * mu[2] * square(mu[1]);
}
EulerPoincare rigid_body(bool attitude = false) {
  return {
      .algebra = LieAlgebra::so3(), .hamiltonian = spin, .group = attitude ? rotations : nullptr};
}
Expr weight(V a) { return 0.1 * a[0] + 0.2 * a[1] + a[2]; }
Expr top_energy(V mu, V a) {
  return 0.5 * (square(mu[0]) + square(mu[1]) / 1.2 + square(mu[2]) / 0.6) + weight(a);
}
EulerPoincare heavy_top(bool attitude = false) {
  return {.algebra = LieAlgebra::so3(),
          .representation = turns(),
          .hamiltonian = [](V mu, V a, T) { return top_energy(mu, a); },
          .group = attitude ? rotations : nullptr};
}
// Kirchhoff's body in a fluid.
EulerPoincare body_in_fluid(bool attitude = false) {
  return {.algebra = LieAlgebra::se3(),
          .hamiltonian = [](V mu, V, T) -> Expr {
            return 0.5 * (square(mu[0]) + square(mu[1]) / 2.0 + square(mu[2]) / 3.0 +
                          square(mu[3]) + 1.5 * square(mu[4]) + 0.8 * square(mu[5])) +
                   0.2 * mu[0] * mu[4] + 0.1 * square(mu[3] * mu[5]);
          },
          .group = attitude ? motions : nullptr};
}

// A body in R⁴, with weight or without.
EulerPoincare top_of_four(bool weight) {
  EulerPoincare problem{.algebra = LieAlgebra::so(4)};
  problem.hamiltonian = [](V mu, V a, T) {
    Expr energy = 0.2 * mu[0] * square(mu[4]);
    for (Index i = 0; i < 6; ++i) energy += square(mu[i]) / (2.0 + 0.3 * static_cast<double>(i));
    if (a.size() > 0) energy += a[0] + 0.3 * a[2] * a[3];
    return energy;
  };
  for (Index i = 0; weight && i < 4; ++i)
    for (Index j = i + 1; j < 4; ++j) {
      problem.representation.push_back(MatrixXd::Zero(4, 4));
      problem.representation.back()(i, j) = 1.0;
      problem.representation.back()(j, i) = -1.0;
    }
  return problem;
}
const MapPointer cayley_of_four =
    std::make_shared<CayleyMidpoint>(std::make_shared<SpecialOrthogonal>(4));
const VectorXd kFour{{0.5, -0.3, 0.8, 0.2, -0.6, 0.4, 0.3, 0.7, -0.2, 0.5}};

ReducedMap reduced(const EulerPoincare& problem, MapPointer map = cayley) {
  return {euler_poincare_system(problem), std::move(map), {.backend = Backend::interpreter}};
}
const VectorXd kSpin{{0.8, -0.5, 0.6}};
const VectorXd kTop{{0.3, -0.2, 2.0, 0.19, 0.615, 0.765}};
const VectorXd kBody{{0.3, -0.5, 0.9, 0.7, 0.2, -0.4}};
VectorXd with_attitude(const VectorXd& x, const Manifold& group) {
  VectorXd all(x.size() + group.ambient_dimension());
  all << x, *group.unit();
  return all;
}
using test::bracket_defect;
using test::step;

Vector3d spatial(const VectorXd& x) {  // R μ of (μ, a, R) with a of three numbers
  Matrix3d R;
  for (Index i = 0; i < 3; ++i) R.row(i) = x.segment(x.size() - 9 + 3 * i, 3);
  return R * x.head(3);
}

}  // namespace

// μ₁ is μ₀ turned by cay(v/2)⁻²: with the angle 4 atan(‖v‖/4) about the axis v = h ∂h/∂μ at the
// stage μ₀, turned by half of that, over 1 + ‖v‖²/16.
BOOST_AUTO_TEST_CASE(the_cayley_step_by_hand) {
  const double h = 0.3;
  const ReducedMap method =
      reduced({.algebra = LieAlgebra::so3(), .hamiltonian = [](V mu, V, T) -> Expr {
                 return 0.5 * (square(mu[0]) + square(mu[1]) / 2.0 + square(mu[2]) / 0.7);
               }});
  const auto turned = [](const Vector3d& v, double part) {
    return Eigen::AngleAxisd(-part * 4.0 * std::atan(v.norm() / 4.0), v.normalized());
  };
  Vector3d v = h * kSpin.cwiseQuotient(Vector3d(1.0, 2.0, 0.7));
  for (int i = 0; i < 60; ++i) {
    const Vector3d stage = turned(v, 0.5) * Vector3d(kSpin) / (1.0 + v.squaredNorm() / 16.0);
    v = h * stage.cwiseQuotient(Vector3d(1.0, 2.0, 0.7));
  }
  const Vector3d expected = turned(v, 1.0) * Vector3d(kSpin);
  BOOST_TEST((step(method, kSpin, h) - expected).norm() < 1e-15);
}

// Casimirs over 10⁵ steps: |μ|² on so(3)*; |a|², μ·a of a top; |p|², l·p on se(3)*.
BOOST_AUTO_TEST_CASE(keeps_coadjoint_orbits) {
  const auto drift = [](const ReducedMap& method, const VectorXd& x, const auto& casimirs) {
    const auto before = casimirs(x);
    return (casimirs(step(method, x, 0.1, 100000)) - before).cwiseAbs().maxCoeff();
  };
  BOOST_TEST(drift(reduced(rigid_body()), kSpin, [](const VectorXd& x) {
               return VectorXd(VectorXd::Constant(1, x.squaredNorm()));
             }) < 1e-12);
  const auto both = [](const VectorXd& x) {
    return VectorXd{{x.tail(3).squaredNorm(), x.head(3).dot(x.tail(3))}};
  };
  BOOST_TEST(drift(reduced(heavy_top()), kTop, both) < 1e-12);
  BOOST_TEST(drift(reduced(body_in_fluid(), std::make_shared<CayleyMidpoint>(motions)), kBody,
                   both) < 1e-12);
}

// Of so(4) ⋉ R⁴ they are |a|² and |μ ∧ a|², of degree four, which the midpoint rule does not keep; on
// so(4)* alone |μ|² and the Pfaffian.
BOOST_AUTO_TEST_CASE(keeps_coadjoint_orbits_of_so4) {
  const auto square_of_wedge = [](const VectorXd& x) {  // (01), (02), (03), (12), (13), (23), a
    const VectorXd a = x.tail(4);
    return std::pow(x[0] * a[2] - x[1] * a[1] + x[3] * a[0], 2) +
           std::pow(x[0] * a[3] - x[2] * a[1] + x[4] * a[0], 2) +
           std::pow(x[1] * a[3] - x[2] * a[2] + x[5] * a[0], 2) +
           std::pow(x[3] * a[3] - x[4] * a[2] + x[5] * a[1], 2);
  };
  const auto drift = [](const Integrator& method, const VectorXd& x, const auto& casimir) {
    return std::fabs(casimir(step(method, x, 0.1, 20000)) - casimir(x));
  };
  const ReducedMap top = reduced(top_of_four(true), cayley_of_four);
  BOOST_TEST(drift(top, kFour, square_of_wedge) < 1e-12);
  BOOST_TEST(drift(top, kFour, [](const VectorXd& x) { return x.tail(4).squaredNorm(); }) < 1e-12);
  const auto system = euler_poincare_system(top_of_four(true));
  const DiscretizeFirst midpoint(system, std::make_shared<Theta>(system->manifold()));
  BOOST_TEST(drift(midpoint, kFour, square_of_wedge) > 1e-6);

  const ReducedMap body = reduced(top_of_four(false), cayley_of_four);
  const VectorXd mu = kFour.head(6);
  BOOST_TEST(drift(body, mu, [](const VectorXd& x) { return x.squaredNorm(); }) < 1e-12);
  BOOST_TEST(drift(body, mu, [](const VectorXd& x) {
               return x[0] * x[5] - x[1] * x[4] + x[2] * x[3];
             }) < 1e-12);
}

// A Poisson map to the accuracy of its differential; the midpoint rule keeps the same Casimirs and
// is none.
BOOST_AUTO_TEST_CASE(is_a_poisson_map) {
  const double h = 0.2;
  const auto defect = [&](const EulerPoincare& problem, const MapPointer& map, const VectorXd& x) {
    return bracket_defect(reduced(problem, map),
                          LiePoisson(problem.algebra, problem.representation), x, h);
  };
  BOOST_TEST(defect(rigid_body(), cayley, kSpin) < 1e-12);
  BOOST_TEST(defect(rigid_body(), exponential, kSpin) < 1e-12);
  BOOST_TEST(defect(heavy_top(), cayley, kTop) < 1e-12);
  BOOST_TEST(defect(heavy_top(), exponential, kTop) < 1e-12);
  BOOST_TEST(defect(body_in_fluid(), std::make_shared<CayleyMidpoint>(motions), kBody) < 1e-12);
  BOOST_TEST(defect(body_in_fluid(), std::make_shared<Theta>(motions), kBody) < 1e-12);
  BOOST_TEST(defect(top_of_four(false), cayley_of_four, kFour.head(6)) < 1e-12);
  BOOST_TEST(defect(top_of_four(true), cayley_of_four, kFour) < 1e-12);
  // Not only symmetric maps.
  BOOST_TEST(defect(rigid_body(), std::make_shared<Theta>(rotations, 0.3), kSpin) < 1e-12);

  const auto system = euler_poincare_system(rigid_body());
  const DiscretizeFirst midpoint(system, std::make_shared<Theta>(system->manifold()));
  BOOST_TEST(std::fabs(step(midpoint, kSpin, h).norm() - kSpin.norm()) < 1e-15);
  BOOST_TEST(bracket_defect(midpoint, LiePoisson(LieAlgebra::so3()), kSpin, h) > 1e-5);
}

// (R, μ) are those of Method 1 on T*SO(3), with a = Rᵀ e₃, and (μ, a) those without R.
BOOST_AUTO_TEST_CASE(is_the_reduction_of_method_1) {
  const auto bundle = std::make_shared<CotangentBundle>(rotations);
  const auto whole = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(bundle),
      std::make_shared<Hamiltonian>(bundle,
                                    [](V x, T) { return top_energy(x.tail(3), x.segment(6, 3)); }));
  const VectorXd R = rotations->retract(*rotations->unit(), VectorXd{{0.4, -0.9, 0.3}});
  VectorXd x(12), y(15);
  x << R, kTop.head(3);
  y << kTop.head(3), R.tail(3), R;
  for (const MapPointer& map : {cayley, exponential}) {
    const DiscretizeFirst full(whole, std::make_shared<CotangentLift>(bundle, map));
    const ReducedMap with = reduced(heavy_top(true), map), without = reduced(heavy_top(), map);
    const VectorXd end = step(full, x, 0.05, 400), reconstructed = step(with, y, 0.05, 400);
    BOOST_TEST((reconstructed.tail(9) - end.head(9)).norm() < 1e-11);
    BOOST_TEST((reconstructed.head(3) - end.tail(3)).norm() < 1e-11);
    BOOST_TEST((reconstructed.segment(3, 3) - end.segment(6, 3)).norm() < 1e-11);
    BOOST_TEST((step(without, y.head(6), 0.05, 400) - reconstructed.head(6)).norm() < 1e-11);
  }
}

// A body with an ellipsoid: S ∈ (so(3) ⋉ Sym)*, by its entries S_ij, i ≤ j, that are carried along.
Expr ellipsoid_energy(V mu, V S) {
  return 0.5 * (square(mu[0]) + square(mu[1]) / 1.2 + square(mu[2]) / 0.6) + 0.7 * S[0] -
         0.4 * S[3] + 0.3 * S[1] + 0.2 * S[4] * S[5];
}
EulerPoincare body_with_ellipsoid() {
  return {.algebra = LieAlgebra::so3(),
          .representation = dual(symmetric_square(dual(turns()))),
          .hamiltonian = [](V mu, V S, T) { return ellipsoid_energy(mu, S); }};
}
const VectorXd kEllipsoid{{0.3, -0.2, 1.1, 1.0, 0.2, -0.5, 2.0, 0.8, 0.6}};

// Coadjoint orbits of so(3) ⋉ Sym have codimension 3: the eigenvalues of S, by traces of its powers.
BOOST_AUTO_TEST_CASE(carries_symmetric_matrices_along) {
  const auto traces = [](const VectorXd& x) {
    Matrix3d S;
    S << x[3], x[4], x[5], x[4], x[6], x[7], x[5], x[7], x[8];
    return VectorXd{{S.trace(), (S * S).trace(), (S * S * S).trace()}};
  };
  for (const MapPointer& map : {cayley, exponential}) {
    const ReducedMap method = reduced(body_with_ellipsoid(), map);
    BOOST_TEST((traces(step(method, kEllipsoid, 0.05, 2000)) - traces(kEllipsoid)).norm() < 1e-12);
    const EulerPoincare problem = body_with_ellipsoid();
    BOOST_TEST(bracket_defect(method, LiePoisson(problem.algebra, problem.representation),
                              kEllipsoid, 0.1) < 1e-11);
  }
  // As S = Rᵀ S₀ R, by Method 1 on T*SO(3).
  const auto bundle = std::make_shared<CotangentBundle>(rotations);
  const auto whole = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(bundle),
      std::make_shared<Hamiltonian>(bundle, [](V x, T) {
        ExprMatrix S(3, 3), R(3, 3);
        for (Index i = 0; i < 3; ++i)
          for (Index j = 0; j < 3; ++j) {
            R(i, j) = x[3 * i + j];
            S(i, j) = kEllipsoid[3 + (i <= j ? i * (5 - i) / 2 + j : j * (5 - j) / 2 + i)];
          }
        const ExprMatrix turned = R.transpose() * S * R;
        ExprVector entries(6);
        entries << turned(0, 0), turned(0, 1), turned(0, 2), turned(1, 1), turned(1, 2),
            turned(2, 2);
        return ellipsoid_energy(x.tail(3), entries);
      }));
  const DiscretizeFirst full(whole, std::make_shared<CotangentLift>(bundle, cayley));
  VectorXd x(12);
  x << *rotations->unit(), kEllipsoid.head(3);
  const VectorXd end = step(reduced(body_with_ellipsoid()), kEllipsoid, 0.05, 100);
  BOOST_TEST((end.head(3) - step(full, x, 0.05, 100).tail(3)).norm() < 1e-11);
}

// The same on SO(4), where the map has no closed inverse; stages included.
BOOST_AUTO_TEST_CASE(is_the_reduction_of_method_1_on_so4) {
  const auto group = std::make_shared<SpecialOrthogonal>(4);
  const auto bundle = std::make_shared<CotangentBundle>(group);
  EulerPoincare problem = top_of_four(false);
  const auto whole = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(bundle),
      std::make_shared<Hamiltonian>(
          bundle, [H = problem.hamiltonian](V x, T t) { return H(x.tail(6), ExprVector(0), t); }));
  problem.group = group;
  const DiscretizeFirst full(whole, std::make_shared<CotangentLift>(bundle, cayley_of_four));
  const ReducedMap method = reduced(problem, cayley_of_four);
  State a{.x = VectorXd(22)}, b{.x = with_attitude(kFour.head(6), *group)};
  a.x << *group->unit(), kFour.head(6);
  const auto first = full.stepper(), second = method.stepper();
  for (int k = 1; k <= 100; ++k) {
    first->step(a, 0.1, 0.1 * k);
    second->step(b, 0.1, 0.1 * k);
  }
  BOOST_TEST((a.x.head(16) - b.x.tail(16)).norm() < 1e-12);
  BOOST_TEST((a.x.tail(6) - b.x.head(6)).norm() < 1e-12);
  const VectorXd stage = first->last().stage.x, reduced_stage = second->last().stage.x;
  BOOST_TEST((stage.head(16) - reduced_stage.tail(16)).norm() < 1e-12);
  BOOST_TEST((stage.tail(6) - reduced_stage.head(6)).norm() < 1e-12);
  // Between the two ends.
  BOOST_TEST((stage.head(16) - a.x.head(16)).norm() > 1e-3);
}

// R μ is the angular momentum in space: kept without weight, about the vertical with one.
BOOST_AUTO_TEST_CASE(reconstruction_keeps_the_momentum_in_space) {
  const VectorXd x = with_attitude(kSpin, *rotations);
  const VectorXd end = step(reduced(rigid_body(true)), x, 0.1, 10000);
  BOOST_TEST((spatial(end) - Vector3d(kSpin)).norm() < 1e-12);
  BOOST_TEST(rotations->point_defect(end.tail(9)) < 1e-13);

  const VectorXd body = with_attitude(kBody, *motions);
  const VectorXd moved =
      step(reduced(body_in_fluid(true), std::make_shared<Theta>(motions)), body, 0.1, 2000);
  Matrix3d R;
  for (Index i = 0; i < 3; ++i) R.row(i) = moved.segment(6 + 3 * i, 3);
  const Vector3d p = R * moved.segment(3, 3), r = moved.tail(3);
  BOOST_TEST((p - Vector3d(kBody.tail(3))).norm() < 1e-12);
  BOOST_TEST((R * moved.head(3) + r.cross(p) - Vector3d(kBody.head(3))).norm() <
             1e-12 * (1.0 + r.norm()));
}

BOOST_AUTO_TEST_CASE(orders) {
  const auto order = [](const Integrator& method, const VectorXd& x, double time,
                        const VectorXd& exact) {
    std::vector<double> steps, errors;
    for (const long count : {16, 32, 64, 128}) {
      steps.push_back(time / static_cast<double>(count));
      errors.push_back((step(method, x, steps.back(), count) - exact).norm());
    }
    return log_log_slope(steps, errors, 1e-12);
  };
  const auto fine = [](const EulerPoincare& problem, const VectorXd& x, double time) {
    return step(Composition(std::make_shared<ReducedMap>(reduced(problem)), 8), x, time / 400, 400);
  };
  const VectorXd exact = fine(heavy_top(), kTop, 2.0);
  BOOST_TEST(std::fabs(order(reduced(heavy_top()), kTop, 2.0, exact) - 2.0) < 0.15);
  BOOST_TEST(std::fabs(order(reduced(heavy_top(), exponential), kTop, 2.0, exact) - 2.0) < 0.15);
  const Composition fourth(std::make_shared<ReducedMap>(reduced(heavy_top())), 4);
  BOOST_TEST(std::fabs(order(fourth, kTop, 2.0, exact) - 4.0) < 0.15);
}

// μ' = -ad*_ξ μ is the flow of -h with the other sign; the attitude is by right translation there.
BOOST_AUTO_TEST_CASE(right_invariant_systems) {
  EulerPoincare minus = heavy_top(), plus = heavy_top();
  minus.hamiltonian = [](V mu, V a, T) -> Expr { return -top_energy(mu, a); };
  plus.sign = LiePoisson::Sign::plus;
  BOOST_TEST((step(reduced(plus), kTop, 0.1, 10) - step(reduced(minus), kTop, 0.1, 10)).norm() <
             1e-13);
  BOOST_TEST(
      (step(reduced(plus), kTop, 0.1, 10) - step(reduced(heavy_top()), kTop, 0.1, 10)).norm() >
      0.1);
  plus.group = rotations;
  BOOST_CHECK_THROW(euler_poincare_system(plus), std::invalid_argument);
}

// Torques and reactions: with a damping torque, and a wheel that may not turn about one axis.
BOOST_AUTO_TEST_CASE(inputs_and_constraints) {
  EulerPoincare suslov{.algebra = LieAlgebra::so3()};
  suslov.lagrangian = [](V xi, V, T) -> Expr {
    return 0.5 * (square(xi[0]) + 2.0 * square(xi[1]) + 3.0 * square(xi[2])) + 0.4 * xi[0] * xi[2];
  };
  suslov.input = [](V, V, V xi, T t) { return ExprVector{{-0.2 * xi[0], cos(t), Expr(0.0)}}; };
  suslov.constraint = [](V, V xi, T) { return ExprVector(ExprVector::Constant(1, xi[2])); };
  suslov.constraint_names = {"xi[2]"};
  const ReducedMap method = reduced(suslov);
  // ξ₂ = 0: μ = (ξ₀, 2 ξ₁, 0.4 ξ₀), μ₀' = -μ₂ ξ₁ - 0.2 ξ₀, μ₁' = μ₂ ξ₀ + cos t.
  const auto rate = [](const Eigen::Vector2d& xi, double t) {
    return Eigen::Vector2d(-0.4 * xi[0] * xi[1] - 0.2 * xi[0],
                           0.5 * (0.4 * xi[0] * xi[0] + std::cos(t)));
  };
  Eigen::Vector2d xi(1.0, 0.5);
  const double time = 1.0, dt = time / 2000;
  for (int k = 0; k < 2000; ++k) {
    const double t = k * dt;
    const Eigen::Vector2d a = rate(xi, t), b = rate(xi + dt / 2 * a, t + dt / 2),
                          c = rate(xi + dt / 2 * b, t + dt / 2), d = rate(xi + dt * c, t + dt);
    xi += dt / 6 * (a + 2 * b + 2 * c + d);
  }
  std::vector<double> steps, errors;
  for (const long count : {16, 32, 64, 128}) {
    steps.push_back(time / static_cast<double>(count));
    const State end = method.advance(
        {.x = VectorXd{{1.0, 1.0, 0.4}}, .z = VectorXd{{1.0, 0.5, 0.0, 0.0}}}, steps.back(), count);
    errors.push_back((Eigen::Vector2d(end.x[0], end.x[1] / 2.0) - xi).norm());
  }
  BOOST_TEST(std::fabs(log_log_slope(steps, errors, 1e-12) - 2.0) < 0.15);
}

BOOST_AUTO_TEST_CASE(at_rest_and_about_an_axis) {
  BOOST_TEST(step(reduced(rigid_body()), VectorXd::Zero(3), 0.1, 10).norm() == 0.0);
  const VectorXd axis{{0.0, 0.0, 0.9}};
  BOOST_TEST((step(reduced(rigid_body()), axis, 0.1, 10) - axis).norm() < 1e-15);
  const VectorXd hanging{{0.0, 0.0, 0.0, 0.1, 0.2, 1.0}};
  BOOST_TEST((step(reduced(heavy_top()), hanging, 0.1, 10) - hanging).norm() < 1e-15);
}

BOOST_AUTO_TEST_CASE(what_is_refused) {
  const auto system = euler_poincare_system(heavy_top());
  BOOST_CHECK_THROW(ReducedMap(nullptr, cayley), std::invalid_argument);
  BOOST_CHECK_THROW(ReducedMap(system, nullptr), std::invalid_argument);
  BOOST_CHECK_THROW(ReducedMap(system, std::make_shared<Theta>(std::make_shared<Euclidean>(3))),
                    std::invalid_argument);
  BOOST_CHECK_THROW(ReducedMap(system, std::make_shared<CayleyMidpoint>(motions)),
                    std::invalid_argument);
  // x acts as eˣ, which is no polynomial.
  const EulerPoincare scaled{
      .algebra = LieAlgebra::abelian(1),
      .representation = {MatrixXd::Ones(1, 1)},
      .hamiltonian = [](V mu, V a, T) -> Expr { return 0.5 * square(mu[0]) + square(a[0]); }};
  BOOST_CHECK_THROW(ReducedMap(euler_poincare_system(scaled),
                               std::make_shared<Theta>(std::make_shared<Euclidean>(1))),
                    std::invalid_argument);
  BOOST_CHECK_THROW(ReducedMap(euler_poincare_system(rigid_body(true)),
                               std::make_shared<Theta>(std::make_shared<SpecialOrthogonal3>(
                                   SpecialOrthogonal3::cayley()))),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
