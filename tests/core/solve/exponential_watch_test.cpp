#include "courant/core/solve/exponential_watch.hpp"

#include <boost/test/unit_test.hpp>

// Mistakes that these cases have to notice:
//  * a short change far from where the matrix was made settles exponentials
//  * exponentials that are nothing settle no step
BOOST_AUTO_TEST_SUITE(exponential_watch_test)

using namespace courant;

// exp(40 v) - 1 - i, where a change of v by 1/40 is a change of the argument by 1.
BOOST_AUTO_TEST_CASE(a_change_is_judged_by_its_argument_and_its_matrix) {
  const Graph graph;
  const ExprVector v = graph.variables("v", 1), i = graph.variables("i", 1);
  const ExprVector F = ExprVector::Constant(1, exp(40.0 * v[0]) - 1.0 - i[0]);
  ExponentialWatch watch(Exponentials("diode", {{"v", v}, {"i", i}}, F));
  double at = 0.5;
  const double current = 1.0;
  const Inputs in(&at, {&current});
  const auto is_settled_after = [&](double change) {
    return watch.is_settled(in, {0}, VectorXd::Constant(1, change));
  };
  watch.keep(in);
  BOOST_TEST(is_settled_after(1e-9));
  BOOST_TEST(!is_settled_after(1e-4));
  // By a matrix of a point further up a short change says nothing.
  at = 0.6;
  watch.keep(in);
  at = 0.5;
  BOOST_TEST(!is_settled_after(1e-16));
  // Below -30 the exponential is nothing, wherever it is.
  at = -1.0;
  watch.keep(in);
  at = -2.0;
  BOOST_TEST(is_settled_after(0.5));
}

BOOST_AUTO_TEST_SUITE_END()
