#include "courant/running/c_functions.hpp"

#include <boost/test/unit_test.hpp>
#include <limits>
#include <string>

// Mistakes that these cases have to notice:
//  * two question marks in a comment begin a trigraph
BOOST_AUTO_TEST_SUITE(c_functions)

using namespace courant;

namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_CASE(numbers_read_back_as_doubles) {
  BOOST_TEST(c_number(2.0) == "2.0");
  BOOST_TEST(c_number(0.1) == "0.1");
  BOOST_TEST(c_number(1e300) == "1e+300");
  BOOST_TEST(c_number(-std::numeric_limits<double>::infinity()) == "-INFINITY");
  BOOST_TEST(c_number(std::numeric_limits<double>::quiet_NaN()) == "NAN");
  BOOST_TEST(std::stod(c_number(1.0 / 3.0)) == 1.0 / 3.0);
}

BOOST_AUTO_TEST_CASE(arrays_are_never_empty) {
  BOOST_TEST(c_array(VectorXd()) == "{0}");
  BOOST_TEST(c_array(Eigen::Vector2d(1.0, 0.5)) == "{1.0, 0.5}");
  BOOST_TEST(c_array(std::vector<Index>{3, 1}) == "{3, 1}");
  BOOST_TEST(c_state({.t = 1.0, .x = Eigen::Vector2d(2.0, 3.0)}) ==
             "{1.0,\n  {2.0, 3.0},\n  {0},\n  {0}}");
}

// What stands in an experiment ends no comment and no text.
BOOST_AUTO_TEST_CASE(comments_and_texts_cannot_be_left) {
  BOOST_TEST(!has(c_comment("a */ b /* c ?\?/"), "*/"));
  BOOST_TEST(!has(c_comment("**//"), "*/"));
  BOOST_TEST(!has(c_comment("a ?\?/"), "?\?"));
  BOOST_TEST(c_string("say \"a\\b\"") == "\"say \\\"a\\\\b\\\"\"");
  BOOST_TEST(!has(c_string("?\?/"), "?\?"));
}

// 3 y₀ = p, y₁ = y₀²: elimination leaves nothing, without it there are two equations.
BOOST_AUTO_TEST_CASE(equations_with_what_elimination_leaves) {
  Graph graph;
  const ExprVector y = graph.variables("y", 2), p = graph.variables("p", 1);
  ExprVector F(2);
  F << 3.0 * y[0] - p[0], y[1] - square(y[0]) - sin(y[1]);
  const Elimination::Options options;
  CFunctions functions;
  const auto eliminated = functions.add({.symbol = "fewer",
                                         .inputs = {{"y", y}, {"p", p}},
                                         .equations = F,
                                         .groups = {},
                                         .elimination = &options});
  BOOST_TEST(eliminated.sought == std::vector<Index>({1}), boost::test_tools::per_element());
  BOOST_TEST(functions.most_unknowns() == 2);
  BOOST_TEST(has(functions.source(), "fewer_unknowns"));
  const auto all = functions.add(
      {.symbol = "all", .inputs = {{"y", y}, {"p", p}}, .equations = F, .groups = {}});
  BOOST_TEST(all.sought.size() == 2u);
  BOOST_TEST(!has(functions.source(), "all_unknowns"));
  BOOST_TEST(has(functions.source(), "static const struct equations all_equations"));
}

BOOST_AUTO_TEST_CASE(an_unknown_that_stands_nowhere_is_left) {
  Graph graph;
  const ExprVector y = graph.variables("y", 2);
  CFunctions functions;
  const auto unknowns = functions.add({.symbol = "one",
                                       .inputs = {{"y", y}},
                                       .equations = ExprVector::Constant(1, y[1] - cos(y[1])),
                                       .groups = {}});
  BOOST_TEST(unknowns.sought == std::vector<Index>({1}), boost::test_tools::per_element());
  BOOST_TEST(unknowns.left == std::vector<Index>({0}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(equations_that_newton_in_c_cannot_solve_are_refused) {
  Graph graph;
  const ExprVector y = graph.variables("y", 2);
  CFunctions functions;
  BOOST_CHECK_THROW(functions.add({.symbol = "oblong",
                                   .inputs = {{"y", y}},
                                   .equations = ExprVector::Constant(1, y[0] * y[1]),
                                   .groups = {}}),
                    std::invalid_argument);
  const ExprVector many = graph.variables("m", 64);
  ExprVector F(64);
  for (Index i = 0; i < 64; ++i) F[i] = many[i] - cos(many[i]);
  BOOST_CHECK_THROW(
      functions.add({.symbol = "large", .inputs = {{"m", many}}, .equations = F, .groups = {}}),
      std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
