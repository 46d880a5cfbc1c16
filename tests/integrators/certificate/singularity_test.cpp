#include "courant/integrators/certificate/singularity.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "ladder_catalogue.hpp"

// Mistakes that these cases have to notice:
//  * what an uncertain point hides of a rank leaves no doubt
//  * entries of a tangent that are round-off bend equations
//    (integrators/certificate/ladder_levels.cpp)
//  * a tangent is one to 10⁻¹³ where units are far apart
//    (integrators/certificate/ladder_levels.cpp)
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
  BOOST_TEST_REQUIRE(jet.zero().found);
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

// (1, 0) moves along (0, 1), so that the directions of the circle and of its velocity have zeros that rounding fills.
BOOST_AUTO_TEST_CASE(what_repeats_itself_is_not_singular_along_an_axis) {
  for (const double again : {0.0, 3.0}) {
    const auto rotation = flat(2, 0, again == 0.0 ? 3 : 4, [again](V x, V v, V, T) {
      const Expr radius = square(x[0]) + square(x[1]) - 1;
      return again == 0.0 ? equations({v[0] + x[1], v[1] - x[0], radius})
                          : equations({v[0] + x[1], v[1] - x[0], radius, again * radius});
    });
    const ConstraintLadder found = ladder(rotation, at({1.0, 0.0}));
    BOOST_TEST(to_string(found.verdict) == to_string(Verdict::regular));
    BOOST_TEST(!found.is_ambiguous());
  }
}

// Two times and two dimensions of space: x² = x·p = p² = 0 generate motions that nothing determines, and each of the
// three follows from the others when it is differentiated.
BOOST_AUTO_TEST_CASE(what_repeats_itself_is_not_singular_in_far_units) {
  const auto two_times = flat(8, 3, 11, [](V x, V v, V z, T) {
    const auto square_of = [&](int i) {
      return square(x[i + 2]) + square(x[i + 3]) - square(x[i]) - square(x[i + 1]);
    };
    ExprVector F(11);
    F[9] = 0.0;
    for (int i = 0; i < 4; ++i) {
      const double sign = i < 2 ? -1.0 : 1.0;
      F[i] = v[i] - z[1] * x[i] - sign * z[2] * x[i + 4];
      F[i + 4] = v[i + 4] + sign * z[0] * x[i] + z[1] * x[i + 4];
      F[9] += x[i] * x[i + 4];
    }
    F[8] = square_of(0);
    F[10] = square_of(4);
    return F;
  });
  const ConstraintLadder found = ladder(two_times, at({1, 0, 1, 0, 0, 1, 0, 1}));
  BOOST_TEST(to_string(found.verdict) == to_string(Verdict::gauge));
  BOOST_TEST(found.gauge_dimension == 3);
  BOOST_TEST(!found.is_ambiguous());
}

BOOST_AUTO_TEST_SUITE_END()
