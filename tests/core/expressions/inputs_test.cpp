#include "courant/core/expressions/inputs.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/core/solve/newton.hpp"

using namespace courant;

// Mistakes that these cases have to notice:
//  * a solver moves unknowns that are not those that its equations read
//  * places behind the last group are read (core/solve/newton.cpp)
BOOST_AUTO_TEST_SUITE(inputs)

// f(y; a, b) = (a - 2 b y), at places in an order of their own.
Function difference() {
  Graph graph;
  const ExprVector y = graph.variables("y", 1), a = graph.variables("a", 1),
                   b = graph.variables("b", 1);
  return Function("difference", {{"y", y}, {"a", a}, {"b", b}},
                  ExprVector::Constant(1, a[0] - 2.0 * b[0] * y[0]), {.differentiate = {"y"}});
}

BOOST_AUTO_TEST_CASE(places_are_those_of_the_groups) {
  const double b = 3.0, a = 12.0;
  double y = 1.0, other = 5.0, value = 0.0;
  Inputs in(&y, {&a, &b});
  BOOST_TEST(in.count() == 3);
  BOOST_TEST(in.unknowns() == &y);
  BOOST_TEST(in[0] == &y);
  BOOST_TEST(in[1] == &a);
  BOOST_TEST(in[2] == &b);
  difference().value(in.data(), &value);
  BOOST_TEST(value == 6.0);

  Inputs moved = in;
  moved.set_unknowns(&other);
  BOOST_TEST(moved.unknowns() == &other);
  difference().value(moved.data(), &value);
  BOOST_TEST(value == -18.0);
  moved.set_parameter(2, &y);
  difference().value(moved.data(), &value);
  BOOST_TEST(value == 2.0);
  BOOST_TEST(in.unknowns() == &y);  // the copy is another one
  BOOST_TEST(in[2] == &b);

  in.add_parameter(&other);
  BOOST_TEST(in.count() == 4);
  BOOST_TEST(in[3] == &other);
}

BOOST_AUTO_TEST_CASE(groups_too_many_are_refused) {
  double y = 0.0;
  Inputs in(&y, {&y, &y, &y, &y, &y, &y, &y, &y, &y, &y, &y});
  BOOST_TEST(in.count() == Index{Inputs::kMost});
  const auto says = [](const std::length_error& error) {
    return std::string(error.what()) == "Inputs: got 13 groups, expected at most 12.";
  };
  BOOST_CHECK_EXCEPTION(in.add_parameter(&y), std::length_error, says);
  BOOST_CHECK_EXCEPTION(Inputs(&y, {&y, &y, &y, &y, &y, &y, &y, &y, &y, &y, &y, &y}),
                        std::length_error, says);
}

// A solver reads as many places as its equations have groups of inputs.
BOOST_AUTO_TEST_CASE(a_solver_refuses_another_number_of_groups) {
  const double a = 12.0, b = 3.0, scale = 1.0;
  double y = 1.0;
  Newton newton(difference(), {}, {});
  BOOST_TEST((newton.solve(Inputs(&y, {&a, &b}), &scale).status == Newton::Status::converged));
  BOOST_TEST(y == 2.0);
  const auto says = [](const std::invalid_argument& error) {
    return std::string(error.what()) == "Inputs: got 2 groups, expected the 3 of difference.";
  };
  BOOST_CHECK_EXCEPTION(newton.solve(Inputs(&y, {&a}), &scale), std::invalid_argument, says);
  BOOST_CHECK_EXCEPTION(newton.approach(Inputs(&y, {&a}), &scale), std::invalid_argument, says);
}

BOOST_AUTO_TEST_SUITE_END()
