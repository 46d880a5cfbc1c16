#include "courant/integrators/ladder/singularity.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "ladder_catalogue.hpp"

BOOST_AUTO_TEST_SUITE(singularity_test)

using namespace courant;
using namespace courant::examples;

namespace {

using V = const ExprVector&;
using T = const Expr&;

// x' = y beside x² + y² = r².
SystemPointer circle(double r) {
  return flat(2, 0, 2, [r](V x, V v, V, T) {
    return equations({v[0] - x[1], square(x[0]) + square(x[1]) - r * r});
  });
}

// What is singular at the consistent point of level 0 near x.
Singularity at_level_0(const SystemPointer& system, std::initializer_list<double> x) {
  const ConsistentPoint consistent(system, at(x), {});
  const ConsistentJet jet = consistent.find(consistent.start());
  BOOST_TEST_REQUIRE(jet.zero.found);
  return singularity(consistent, jet, levels_at(jet), true);
}

ConstraintLadder ladder(const SystemPointer& system, const InitialGuess& start) {
  return ConstraintAlgorithm().run(system, start);
}

}  // namespace

// (x, y) ↦ x² + y² has no slope at its centre, the only point of the circle of radius 0.
BOOST_AUTO_TEST_CASE(a_constraint_without_a_slope_is_singular) {
  BOOST_TEST(at_level_0(circle(0.0), {0.0, 0.0}).reason != "");
  const Singularity regular = at_level_0(circle(1.0), {0.6, -0.8});
  BOOST_TEST(regular.reason == "");
  BOOST_TEST(regular.seen_once == "");
  BOOST_TEST(regular.is_compared);
}

// 113 bits are asked only where doubles leave open what obstructs.
BOOST_AUTO_TEST_CASE(more_digits_are_asked_where_they_are_needed) {
  BOOST_TEST(!at_level_0(circle(1.0), {0.6, -0.8}).is_refined.has_value());
}

// Momenta of a relativistic particle at rest: (1, 0, 0) is the nearest one of the mass shell, and velocities stay of
// the size that was given.
BOOST_AUTO_TEST_CASE(a_relativistic_particle_at_rest) {
  const SystemPointer particle =
      lagrangian(3, [](V, V w, T) { return -sqrt(square(w[0]) - square(w[1]) - square(w[2])); });
  InitialGuess start = at({0.1, 0.2, 0.3, 0, 0, 0});
  start.v = at({1.3, 0.5, 0.4, 0, 0, 0}).x;
  start.z = at({1.3, 0.5, 0.4}).x;
  const ConstraintLadder found = ladder(particle, start);
  BOOST_TEST(to_string(found.verdict) == "gauge", found.reason);
  BOOST_TEST(found.degrees_of_freedom == 5);
  BOOST_TEST(!found.is_ambiguous());
  BOOST_TEST(found.point.v.lpNorm<Eigen::Infinity>() < 1e4);
  BOOST_TEST(std::abs(found.point.x[3]) < 1.0 + 1e-6);
}

BOOST_AUTO_TEST_SUITE_END()
