#include "courant/integrators/step/kinetic_units.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/core/numbers/power_of_two.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/constrained_family.hpp"
#include "courant/structures/dirac_system.hpp"

// Mistakes that these cases have to notice:
//  * sizes follow the numbers of the point
//  * momenta are measured without the step, or by 1/√g
//  * an unknown that no coordinate meets in an equation is left at 1
//  * time counts as 1
BOOST_AUTO_TEST_SUITE(kinetic_units_test)

using namespace courant;
using Eigen::Vector4d;

namespace {

// Two masses on a line, held at a distance of l: z = λ.
std::shared_ptr<const ImplicitSystem> rod(double m, double M, double l) {
  const auto bundle = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(2));
  const auto energy =
      std::make_shared<Hamiltonian>(bundle, [m, M](const ExprVector& x, const Expr&) {
        return square(x[2]) / (2.0 * m) + square(x[3]) / (2.0 * M);
      });
  const auto held = std::make_shared<ConstrainedFamily>(
      energy,
      [l](const ExprVector& x, const ExprVector&, const Expr&) {
        return ExprVector{{(x[1] - x[0]) / l - 1.0}};
      },
      1);
  return std::make_shared<DiracSystem>(std::make_shared<CanonicalSymplectic>(bundle), held);
}

// Nothing where there is no kinetic energy.
std::optional<VectorXd> sizes_of(const std::shared_ptr<const ImplicitSystem>& system,
                                 const VectorXd& x, double h) {
  const auto masses = kinetic_masses(system, x);
  if (!masses) return std::nullopt;
  return kinetic_sizes(*system->manifold(), *masses, x, h);
}

}  // namespace

// The masses of 4 kg and 1 kg: √g is 2 and 1. What is 0, or round-off, has the size of what it is beside.
BOOST_AUTO_TEST_CASE(sizes_are_those_of_the_kinetic_energy) {
  const double h = 0.25;
  const Vector4d expected(0.5, 1.0, 2.0 / h, 1.0 / h);
  for (const double zero : {0.0, 1e-17, -1e-13}) {
    const auto sizes = sizes_of(rod(4.0, 1.0, 0.5), Vector4d(zero, 3.0, zero, zero), -h);
    BOOST_REQUIRE(sizes.has_value());
    BOOST_TEST((*sizes - 3.0 * expected).norm() < 1e-12, zero);
  }
  const auto moving = sizes_of(rod(4.0, 1.0, 0.5), Vector4d(0.0, 3.0, 0.0, -80.0), h);
  BOOST_TEST((*moving - 20.0 * expected).norm() < 1e-11);
  const auto nowhere = sizes_of(rod(4.0, 1.0, 0.5), Vector4d::Zero(), h);
  BOOST_TEST((*nowhere - expected).norm() < 1e-14);
  BOOST_TEST(spread(Vector4d(0.0, 2.0, 8.0, 4.0)) == 4.0);
  BOOST_TEST(spread(VectorXd()) == 1.0);
}

// In grams, millimetres and milliseconds all numbers are the same up to the rounding to powers of two.
BOOST_AUTO_TEST_CASE(numbers_are_the_same_in_other_units) {
  const double h = 0.25;
  const auto numbers = [h](double length, double mass, double time) {
    const auto system = rod(4.0 / mass, 1.0 / mass, 0.5 / length);
    State point{.x = Vector4d(0.0, 0.5 / length, 8.0 / (mass * length / time),
                              2.0 / (mass * length / time)),
                .v = {},
                .z = VectorXd::Constant(1, 3.0)};
    point.v = Vector4d(2.0, 2.0, 0.0, 0.0) * (time / length);
    const auto sizes = sizes_of(system, point.x, h / time);
    const Units units = kinetic_units(system, point, *sizes, h / time);
    BOOST_TEST(units.time == nearest_power_of_two(h / time));
    const Vector4d x = units.measure(point).x;
    return x;
  };
  const Vector4d expected = numbers(1.0, 1.0, 1.0);
  for (const auto& [length, mass, time] :
       {std::tuple{1e-3, 1e-3, 1e-3}, std::tuple{1e6, 1e3, 1.0}, std::tuple{1.0, 1e-26, 1e-15}}) {
    const Vector4d x = numbers(length, mass, time);
    for (Index i = 0; i < 4; ++i) BOOST_TEST(std::abs(x[i] - expected[i]) <= std::abs(expected[i]));
  }
}

// λ/l is a force, and momenta count by l/h: 1 where it changes a momentum by its size in a step.
BOOST_AUTO_TEST_CASE(multipliers_count_by_what_they_do) {
  const double h = 0.25;
  for (const double l : {0.5, 512.0, 1.0 / 1024.0}) {
    const auto system = rod(1.0, 1.0, l);
    const State point{
        .x = Vector4d(0.0, l, 0.0, 0.0), .v = Vector4d::Zero(), .z = VectorXd::Zero(1)};
    const auto sizes = sizes_of(system, point.x, h);
    const Units units = kinetic_units(system, point, *sizes, h);
    BOOST_TEST(units.auxiliary[0] == l * l / (h * h), l);
    BOOST_TEST(units.equations.size() == system->equation_count());
  }
}

// Vectors on spheres share a unit; points of a sphere have none.
BOOST_AUTO_TEST_CASE(sizes_are_those_of_scaling_symmetries) {
  const auto bundle = std::make_shared<CotangentBundle>(std::make_shared<Sphere>(2));
  const auto system = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(bundle),
      std::make_shared<Hamiltonian>(bundle, [](const ExprVector& x, const Expr&) {
        return ExprVector(x.tail(3)).squaredNorm() / 200.0;
      }));
  const VectorXd x = (VectorXd(6) << 0.0, 0.0, 1.0, 0.1, 0.2, 0.0).finished();
  const auto sizes = sizes_of(system, x, 0.1);
  BOOST_REQUIRE(sizes.has_value());
  BOOST_TEST(sizes->head(3).norm() == 0.0);
  BOOST_TEST((*sizes)[3] > 0.0);
  BOOST_TEST((*sizes)[3] == (*sizes)[5]);
}

BOOST_AUTO_TEST_CASE(without_a_kinetic_energy_there_are_none) {
  const auto plane = std::make_shared<Euclidean>(2);
  const auto bundle = std::make_shared<CotangentBundle>(plane);
  const auto system = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(bundle),
      std::make_shared<Hamiltonian>(
          bundle, [](const ExprVector& x, const Expr&) { return x[2] * x[0] + x[3] * x[1]; }));
  BOOST_TEST(!sizes_of(system, Vector4d::Ones(), 0.1));
}

BOOST_AUTO_TEST_SUITE_END()
