#include "courant/core/expressions/expr_vectors.hpp"

#include <boost/test/unit_test.hpp>

namespace courant {
BOOST_AUTO_TEST_SUITE(expr_vectors_test)

namespace {

BOOST_AUTO_TEST_CASE(parts_keep_their_order) {
  Graph graph;
  const ExprVector x = graph.variables("x", 2), y = graph.variables("y", 1);
  const ExprVector all = joined(x, 2.0 * y, ExprVector(0), x.tail(1));
  BOOST_TEST(all.size() == 4);
  BOOST_TEST((all[0] == x[0] && all[1] == x[1] && all[2] == 2.0 * y[0] && all[3] == x[1]));
  BOOST_TEST((joined({y, x}) == joined(y, x)));
  BOOST_TEST(joined(std::vector<ExprVector>{}).size() == 0);
}

BOOST_AUTO_TEST_CASE(a_variable_that_cancels_is_none_that_is_depended_on) {
  Graph graph;
  const ExprVector x = graph.variables("x", 2);
  const ExprVector product = ExprVector::Constant(1, x[0] * x[0]);
  BOOST_TEST(depends(product, x.head(1)));
  BOOST_TEST(!depends(product, x.tail(1)));
  BOOST_TEST(!depends(ExprVector::Constant(1, x[1] - x[1] + 3.0), x));
  BOOST_TEST(!depends(ExprVector(0), x));
}

}  // namespace

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
