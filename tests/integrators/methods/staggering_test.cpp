#include "courant/integrators/methods/staggering.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/tests/integrators/example_systems.hpp"

BOOST_AUTO_TEST_SUITE(staggering_of_coordinates)

using namespace courant;
using examples::equations;
using examples::FormulaSystem;
using V = const ExprVector&;

namespace {

std::optional<VectorXd> classes(Index n, const FormulaSystem::Formula& rate) {
  const auto system = std::make_shared<FormulaSystem>(
      std::make_shared<Euclidean>(n), 0, n,
      [rate](V x, V v, V z, const Expr& t) { return ExprVector(v - rate(x, v, z, t)); });
  const VectorXd x = VectorXd::LinSpaced(n, 0.3, 0.9);
  return staggering(
      {system, ConstraintAlgorithm().run(system, {.x = x}), VectorFieldFormulas::Freedom::none});
}

}  // namespace

// Two circuits; in each the first coordinate has 0. What depends on time alone is in either class.
BOOST_AUTO_TEST_CASE(charges_and_fluxes_are_told_apart) {
  const auto found = classes(5, [](V x, V, V, const Expr& t) {
    return equations({x[1], -x[0] - x[3] * square(x[3]), sin(t), x[1], -x[0]});
  });
  BOOST_REQUIRE(found.has_value());
  const std::vector<double> expected = {0.0, 1.0, 0.0, 0.0, 1.0};
  BOOST_TEST(std::vector<double>(found->begin(), found->end()) == expected,
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(there_are_none_with_friction_or_odd_circles) {
  BOOST_TEST(!classes(2, [](V x, V, V, const Expr&) {
                return equations({x[1], -x[0] - 0.1 * x[1]});
              }).has_value());
  BOOST_TEST(!classes(3, [](V x, V, V, const Expr&) {
                return equations({x[1], x[2], x[0]});
              }).has_value());
}

BOOST_AUTO_TEST_SUITE_END()
