#include "courant/integrators/certificate/ladder_in_units.hpp"

#include <Eigen/SVD>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "ladder_catalogue.hpp"

// Mistakes that these cases have to notice:
//  * combinations of equations are those of equations in other units
//  * coefficients of powers of time have another unit of time
BOOST_AUTO_TEST_SUITE(ladder_in_units)

using namespace courant;
using namespace courant::examples;

namespace {

using V = const ExprVector&;
using T = const Expr&;

// The pendulum in its plane, with one equation twice.
SystemPointer pendulum() {
  return flat(4, 1, 6, [](V x, V v, V z, T) {
    return equations({v[0] - x[2], v[1] - x[3], v[2] + z[0] * x[0], v[3] + z[0] * x[1] + 9.81,
                      square(x[0]) + square(x[1]) - 1,
                      2.0 * square(x[0]) + 2.0 * square(x[1]) - 2});
  });
}

std::shared_ptr<const SystemInUnits> measured(const SystemPointer& system) {
  Units units;
  units.coordinates = units.tangent = Eigen::Vector4d(2.0, 0.5, 4.0, 1.0);
  units.auxiliary = VectorXd::Constant(1, 8.0);
  units.equations = VectorXd(6);
  units.equations << 1.0, 2.0, 4.0, 0.25, 0.5, 16.0;
  units.time = 0.25;
  return std::make_shared<SystemInUnits>(system, units);
}

// Ranges of rows are the same.
bool span_the_same(const MatrixXd& a, const MatrixXd& b) {
  MatrixXd both(a.rows() + b.rows(), a.cols());
  both << a, b;
  Eigen::JacobiSVD<MatrixXd> svd(both);
  svd.setThreshold(1e-10);
  return a.rows() == b.rows() && svd.rank() == a.rows();
}

}  // namespace

// What was found in other units is what is found without them.
BOOST_AUTO_TEST_CASE(a_ladder_is_restored) {
  const SystemPointer system = pendulum();
  const auto there = measured(system);
  const State given{.t = 0.0, .x = Eigen::Vector4d(0.6, -0.8, 0.8, 0.7)};
  const State start = there->units().measure(given);
  const ConstraintLadder own =
      ConstraintAlgorithm().run(system, {.x = given.x, .hold_x = {0, 1, 2}});
  const ConstraintLadder found =
      restored(ConstraintAlgorithm().run(there, {.x = start.x, .hold_x = {0, 1, 2}}), *there);
  BOOST_TEST(are_alike(own, found));
  BOOST_TEST((found.point.x - own.point.x).norm() < 1e-12);
  BOOST_TEST((found.point.v - own.point.v).norm() < 1e-10);
  BOOST_TEST((found.point.z - own.point.z).norm() < 1e-10);
  // Through x', which the equations determine, and x'' too.
  BOOST_TEST_REQUIRE(found.jet.size() == own.jet.size());
  BOOST_TEST((found.jet.head(14) - own.jet.head(14)).norm() < 1e-9);
  BOOST_TEST(span_the_same(found.conormals(), own.conormals()));
  BOOST_TEST_REQUIRE(found.moves.size() == own.moves.size());
  for (std::size_t i = 0; i < own.moves.size(); ++i) {
    BOOST_TEST(found.moves[i].name == own.moves[i].name);
    BOOST_TEST(found.moves[i].from == own.moves[i].from);
    BOOST_TEST(std::fabs(found.moves[i].to - own.moves[i].to) < 1e-12);
  }
}

// A combination of equations and derivatives that is free of unknowns is so in the units of the system.
BOOST_AUTO_TEST_CASE(combinations_are_restored) {
  const SystemPointer system = pendulum();
  const auto there = measured(system);
  const State start = there->units().measure({.t = 0.0, .x = Eigen::Vector4d(0.6, -0.8, 0.8, 0.6)});
  const ConstraintLadder found = restored(ConstraintAlgorithm().run(there, {.x = start.x}), *there);
  BOOST_TEST_REQUIRE(!found.redundancies.empty());
  for (const Combination& redundancy : found.redundancies) {
    double first = 0.0, second = 0.0;
    for (const Combination::Term& term : redundancy.terms) {
      if (term.equation == 4) first = term.coefficient;
      if (term.equation == 5) second = term.coefficient;
    }
    BOOST_TEST(std::fabs(first + 2.0 * second) < 1e-10 * std::fabs(first));
  }
}

BOOST_AUTO_TEST_CASE(other_dimensions_are_not_alike) {
  const ConstraintLadder ladder =
      ConstraintAlgorithm().run(pendulum(), {.x = Eigen::Vector4d(0.6, -0.8, 0.8, 0.6)});
  ConstraintLadder other = ladder;
  BOOST_TEST(are_alike(ladder, other));
  other.levels.back().dim_M += 1;
  BOOST_TEST(!are_alike(ladder, other));
  other = ladder;
  other.verdict = Verdict::gauge;
  BOOST_TEST(!are_alike(ladder, other));
}

BOOST_AUTO_TEST_SUITE_END()
