#include "courant/structures/symmetry.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/lagrangian_system.hpp"
#include "courant/structures/lie_poisson.hpp"

// Mistakes that these cases have to notice:
//  * the lift turns momenta the wrong way
//  * holonomic constraints are not looked at
//  * forces and reactions never act
//  * the energy is measured off the Lagrangian submanifold
//  * the terms of the energy hide asymmetries in large units
BOOST_AUTO_TEST_SUITE(symmetry)

using namespace courant;

namespace {

std::shared_ptr<const CotangentBundle> bundle_on(std::shared_ptr<const Manifold> Q) {
  return std::make_shared<CotangentBundle>(std::move(Q));
}
const auto T2 = bundle_on(std::make_shared<Euclidean>(2));
const auto T3 = bundle_on(std::make_shared<Euclidean>(3));
const auto on_sphere = bundle_on(std::make_shared<Sphere>(2));
const auto on_rotations = bundle_on(std::make_shared<SpecialOrthogonal3>());

std::shared_ptr<const DiracSystem> hamiltonian(std::shared_ptr<const CotangentBundle> T,
                                               Hamiltonian::Formula H,
                                               const Mechanics& mechanics = {}) {
  std::vector<std::string> names;
  for (Index i = 0; i < T->ambient_dimension(); ++i) names.push_back("x" + std::to_string(i));
  return hamiltonian_system(std::make_shared<CanonicalSymplectic>(T),
                            std::make_shared<Hamiltonian>(T, std::move(H)), names, mechanics);
}

Expr kepler(const ExprVector& x, const Expr&) {
  return 0.5 * (x[2] * x[2] + x[3] * x[3]) - 1.0 / sqrt(x[0] * x[0] + x[1] * x[1]);
}
ExprVector turn(const ExprVector& q) {  // about the last axis, or in the plane
  ExprVector xi = ExprVector::Zero(q.size());
  xi[0] = -q[1];
  xi[1] = q[0];
  return xi;
}
ExprVector shift(const ExprVector& q) { return ExprVector::Unit(q.size(), 0); }
// About the third axis of space: R' = ẑ R.
ExprVector turn_of_space(const ExprVector& R) {
  ExprVector xi = ExprVector::Zero(9);
  xi << -R.segment(3, 3), R.head(3), ExprVector::Zero(3);
  return xi;
}

// Under gravity, with the centre of mass on the third axis or not; moments of inertia (1, 1, 0.6).
Hamiltonian::Formula top(double off) {
  return [off](const ExprVector& x, const Expr&) -> Expr {
    return 0.5 * (x[9] * x[9] + x[10] * x[10] + x[11] * x[11] / 0.6) + off * x[6] + x[8];
  };
}

SymmetryReport report(const DiracSystem& system, const Symmetry& symmetry, const VectorXd& x) {
  return check_symmetry(system, symmetry, State{.x = x}, "J");
}
// The law that fails, without the rest.
std::string failing(const SymmetryReport& found) {
  for (const LawResult& law : found.laws)
    if (!law.passed()) return law.law.substr(0, 2);
  return "";
}

}  // namespace

// J = x p_y - y p_x, and X rotates positions and momenta.
BOOST_AUTO_TEST_CASE(lift_of_a_rotation) {
  const Symmetry rotation(T2, turn);
  const VectorXd x{{0.3, -0.7, 1.1, 0.4}};
  BOOST_TEST(std::fabs(values(ExprVector::Constant(1, rotation.momentum(constants(x))))[0] -
                       (x[0] * x[3] - x[1] * x[2])) < 1e-15);
  BOOST_TEST((values(rotation.lift(constants(x))) - VectorXd{{-x[1], x[0], -x[3], x[2]}}).norm() <
             1e-15);
}

// i_X ω = dJ with the form of CanonicalSymplectic, on a sphere and on a group, where X covers ξ.
BOOST_AUTO_TEST_CASE(lift_is_the_hamiltonian_vector_field_of_the_momentum) {
  std::mt19937 generator(1);
  const auto defect = [&](const std::shared_ptr<const CotangentBundle>& T, Symmetry::Field field) {
    const Symmetry symmetry(T, std::move(field));
    const VectorXd x = T->random_point(generator);
    const VectorXd X = values(symmetry.lift(constants(x)));
    const VectorXd dJ = values(symmetry.differential(constants(x)));
    const MatrixXd omega = values(CanonicalSymplectic(T).form(constants(x)));
    const VectorXd q = T->position(x);
    const VectorXd xi = values(symmetry.field(constants(q)));
    const MatrixXd frame = T->base()->frame(q);
    return (omega.transpose() * X - dJ).norm() + (frame * T->horizontal(X) - xi).norm();
  };
  BOOST_TEST(defect(on_sphere, turn) < 1e-14);
  BOOST_TEST(defect(on_rotations, turn_of_space) < 1e-14);
}

BOOST_AUTO_TEST_CASE(rotations_of_kepler_and_not_shifts) {
  const VectorXd x{{0.4, 0.0, 0.0, 2.0}};
  const auto system = hamiltonian(T2, kepler);
  const SymmetryReport rotation = report(*system, Symmetry(T2, turn), x);
  BOOST_TEST(rotation.holds());
  BOOST_TEST(rotation.is_conserved());
  BOOST_TEST(rotation.laws.size() == 2u);
  const SymmetryReport translation = report(*system, Symmetry(T2, shift), x);
  BOOST_TEST(failing(translation) == "Y3");
  BOOST_TEST(!translation.is_conserved());
  BOOST_TEST(translation.laws.back().defect > 0.5);
}

// A perturbation of one part in a million is seen, in units that make numbers large too, and beside
// a large constant of the energy.
BOOST_AUTO_TEST_CASE(small_asymmetries_are_seen_in_any_units) {
  for (const double epsilon : {0.0, 1e-6}) {
    const double mu = 3.986e14;  // m³/s², of the earth
    const auto system = hamiltonian(T2, [=](const ExprVector& x, const Expr&) -> Expr {
      return 1e12 + 0.5 * (x[2] * x[2] + x[3] * x[3]) -
             mu / sqrt(x[0] * x[0] + (1.0 + epsilon) * x[1] * x[1]);
    });
    const VectorXd x{{7e6, 0.0, 0.0, 7.5e3}};
    BOOST_TEST(report(*system, Symmetry(T2, turn), x).holds() == (epsilon == 0.0));
  }
}

BOOST_AUTO_TEST_CASE(a_field_has_to_be_tangent) {
  const auto system = hamiltonian(on_sphere, [](const ExprVector& x, const Expr&) -> Expr {
    return 0.5 * x.tail(3).squaredNorm() + 2.0 * x[2];
  });
  const VectorXd x{{0.6, 0.0, -0.8, 0.0, 0.9, 0.0}};
  BOOST_TEST(report(*system, Symmetry(on_sphere, turn), x).is_conserved());
  BOOST_TEST(failing(report(*system, Symmetry(on_sphere, shift), x)) == "Y1");
  // About another axis: tangent, and no symmetry of the weight.
  const Symmetry other(on_sphere, [](const ExprVector& q) {
    return ExprVector{{Expr(0.0), -q[2], q[1]}};
  });
  BOOST_TEST(failing(report(*system, other, x)) == "Y3");
}

// Any top about the vertical; about its own axis only where that is one of symmetry.
BOOST_AUTO_TEST_CASE(tops) {
  std::mt19937 generator(2);
  const VectorXd x = on_rotations->random_point(generator);
  const Symmetry vertical(on_rotations, turn_of_space);
  const Symmetry axis(on_rotations, [](const ExprVector& R) {
    return ExprVector(on_rotations->base()->frame(R) * constants(VectorXd{{0.0, 0.0, 1.0}}));
  });
  for (const double off : {0.0, 0.2}) {
    const auto system = hamiltonian(on_rotations, top(off));
    BOOST_TEST(report(*system, vertical, x).is_conserved());
    BOOST_TEST(report(*system, axis, x).is_conserved() == (off == 0.0));
  }
}

// ∂L/∂q along ξ with L(q, w) at rest as a start, where momenta and velocities are zero: the double
// role of w, on 𝓛 alone.
BOOST_AUTO_TEST_CASE(lagrangians_at_rest) {
  const auto system_of = [](double a) {
    return lagrangian_system(T2,
                             [a](const ExprVector& q, const ExprVector& w, const Expr&) -> Expr {
                               const Expr r2 = q[0] * q[0] + q[1] * q[1];
                               return 0.5 * (1.0 + r2) * w.dot(w) + a * w[0] * w[1] - r2;
                             },
                             {"x", "y", "p_x", "p_y"});
  };
  const State rest{.x = VectorXd{{0.5, 0.0, 0.0, 0.0}}, .z = VectorXd::Zero(2)};
  const Symmetry rotation(T2, turn);
  BOOST_TEST(check_symmetry(*system_of(0.0), rotation, rest, "J").holds());
  BOOST_TEST(failing(check_symmetry(*system_of(0.1), rotation, rest, "J")) == "Y3");
}

// x² + y² + z² = 1 goes with rotations, x + z = 1 does not; the energy does in both cases.
BOOST_AUTO_TEST_CASE(holonomic_constraints_have_to_be_invariant) {
  const auto system_of = [](bool round) {
    Mechanics mechanics;
    mechanics.holonomic = {{"phi"}, [round](const ExprVector& x, const ExprVector&, const Expr&) {
                             const Expr phi = round ? x.head(3).squaredNorm() : Expr(x[0] + x[2]);
                             return ExprVector::Constant(1, phi - 1.0).eval();
                           }};
    return hamiltonian(
        T3,
        [](const ExprVector& x, const Expr&) -> Expr {
          return 0.5 * x.tail(3).squaredNorm() + x[2];
        },
        mechanics);
  };
  const State start{.x = VectorXd{{0.6, 0.0, 0.8, 0.0, 1.0, 0.0}}, .z = VectorXd::Ones(1)};
  const State other{.x = VectorXd{{0.6, 0.0, 0.4, 0.0, 1.0, 0.0}}, .z = VectorXd::Ones(1)};
  const Symmetry rotation(T3, turn);
  const SymmetryReport sphere = check_symmetry(*system_of(true), rotation, start, "J");
  BOOST_TEST(sphere.is_conserved());
  BOOST_TEST(sphere.laws.size() == 3u);
  const SymmetryReport plane = check_symmetry(*system_of(false), rotation, other, "J");
  BOOST_TEST(failing(plane) == "Y2");
  BOOST_TEST(plane.laws[1].law.find("\"phi\"") != std::string::npos);
}

// The knife edge x' sin φ = y' cos φ on a slope: turns are in the distribution, shifts along y are
// symmetries and not in it, shifts along x, downhill, none.
BOOST_AUTO_TEST_CASE(reactions_change_momenta_of_symmetries_that_are_not_in_the_distribution) {
  Mechanics mechanics;
  mechanics.nonholonomic = {
      {"blade"}, [](const ExprVector& x, const ExprVector& w, const Expr&) {
        return ExprVector::Constant(1, w[0] * sin(x[2]) - w[1] * cos(x[2])).eval();
      }};
  const auto system = hamiltonian(
      T3,
      [](const ExprVector& x, const Expr&) -> Expr { return 0.5 * x.tail(3).squaredNorm() - x[0]; },
      mechanics);
  const VectorXd x{{0.0, 0.0, 0.3, std::cos(0.3), std::sin(0.3), 0.8}};
  const auto along = [&](Index i) {
    return report(
        *system, Symmetry(T3, [i](const ExprVector&) { return ExprVector::Unit(3, i).eval(); }), x);
  };
  BOOST_TEST(along(2).is_conserved());
  BOOST_TEST(along(1).holds());
  BOOST_TEST(!along(1).is_conserved());
  BOOST_REQUIRE(along(1).acting.size() == 1u);
  BOOST_TEST(along(1).acting[0] == "the reaction of \"blade\"");
  BOOST_TEST(failing(along(0)) == "Y3");
}

// A central force of friction changes angular momentum, one along the radius does not.
BOOST_AUTO_TEST_CASE(forces_change_momenta_if_they_act_along_the_symmetry) {
  for (const bool radial : {true, false}) {
    Mechanics mechanics;
    mechanics.force = [radial](const ExprVector& x, const ExprVector& w, const Expr&) {
      return ExprVector(-0.1 * (radial ? x.head(2) : w));
    };
    const SymmetryReport found = report(*hamiltonian(T2, kepler, mechanics), Symmetry(T2, turn),
                                        VectorXd{{0.4, 0.1, 0.3, 2.0}});
    BOOST_TEST(found.holds());
    BOOST_TEST(found.is_conserved() == radial);
    if (!radial) BOOST_TEST(found.acting.at(0) == "the forces");
  }
}

BOOST_AUTO_TEST_CASE(other_structures_are_refused) {
  BOOST_CHECK_THROW(Symmetry(nullptr, turn), std::invalid_argument);
  const auto M = std::make_shared<Euclidean>(3);
  const auto body = std::make_shared<LiePoisson>(LieAlgebra::so3());
  const DiracSystem rigid(
      body, std::make_shared<Hamiltonian>(body->manifold(), [](const ExprVector& x, const Expr&) {
        return x.squaredNorm();
      }));
  BOOST_CHECK_THROW(report(rigid, Symmetry(T3, turn), VectorXd::Ones(3)), std::invalid_argument);
  const Symmetry short_field(T2, [](const ExprVector&) { return ExprVector::Zero(3).eval(); });
  BOOST_CHECK_THROW(short_field.field(constants(VectorXd{{1.0, 2.0}})), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
