#include "courant/core/expressions/undefined.hpp"

#include <boost/test/unit_test.hpp>

namespace courant {
namespace {

struct Fixture {
  Graph graph;
  Expr x = graph.variable("x"), y = graph.variable("y");

  std::optional<Undefined> at(const std::vector<Expr>& outputs, double x_value, double y_value) {
    ExprVector F(static_cast<Index>(outputs.size()));
    for (Index i = 0; i < F.size(); ++i) F[i] = outputs[static_cast<std::size_t>(i)];
    return find_undefined(F, (ExprVector(2) << x, y).finished(), Eigen::Vector2d(x_value, y_value));
  }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(undefined, Fixture)

BOOST_AUTO_TEST_CASE(names_the_function_and_its_argument) {
  const auto root = at({y, 1.0 + y * sqrt(x - 2.0)}, 1.0, 3.0);
  BOOST_REQUIRE(root);
  BOOST_TEST(root->output == 1);
  BOOST_TEST(root->formula == "sqrt(x - 2)");
  BOOST_TEST(root->reason == "the argument of sqrt is -1, expected at least 0");
  BOOST_TEST(at({log(x)}, 0.0, 0.0)->reason == "the argument of log is 0, expected more than 0");
  BOOST_TEST(at({acos(x)}, 2.0, 0.0)->reason == "the argument of acos is 2, expected -1 to 1");
  BOOST_TEST(at({y / (x - 1.0)}, 1.0, 2.0)->reason == "the divisor is 0");
  BOOST_TEST(at({pow(x, -2)}, 0.0, 0.0)->reason == "the divisor is 0");
  BOOST_TEST(at({pow(x, y)}, -1.0, 0.5)->reason ==
             "the base of the power 0.5 is -1, expected at least 0");
  BOOST_TEST(at({exp(x)}, 1000.0, 0.0)->reason == "it is too large, of 1000");
  const Expr nan = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST(at({y, atan2(x, nan)}, 0.0, 0.0)->reason == "a number in it is nan");
  BOOST_TEST(at({y, nan}, 0.0, 0.0)->reason == "it is nan");
}

// What is not finite in a branch that is not taken, or in no output, is of no account.
BOOST_AUTO_TEST_CASE(says_nothing_where_the_outputs_are_finite) {
  BOOST_TEST(!at({sqrt(x), y}, 1.0, 2.0));
  BOOST_TEST(!at({select(x < 1.0, y, sqrt(x - 2.0))}, 0.0, 2.0));
  BOOST_TEST(!at({Expr(1.0)}, 0.0, 0.0));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
