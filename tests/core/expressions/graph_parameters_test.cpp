#include "courant/core/expressions/graph_parameters.hpp"

#include <boost/test/unit_test.hpp>
#include <stdexcept>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/function.hpp"

// Mistakes that these cases have to notice:
//  * a parameter is a constant in every graph
//  * parameters are told apart by their place, not by their name
//  * formulas that are differentiated at fresh variables lose their parameters
BOOST_AUTO_TEST_SUITE(graph_parameters)

using namespace courant;

namespace {

// l x², where l is a parameter.
Expr formula(const ExprVector& x) { return Parameter{"l", 2.5}.at(x) * x[0] * x[0]; }

}  // namespace

BOOST_AUTO_TEST_CASE(a_parameter_is_its_value_where_no_graph_has_it) {
  const Graph plain;
  const ExprVector x = plain.variables("x", 1);
  BOOST_TEST(Function("f", {{"x", x}}, ExprVector::Constant(1, formula(x)))(
                 {VectorXd::Constant(1, 3.0)})[0] == 22.5);
  BOOST_TEST(formula(constants(VectorXd::Constant(1, 3.0))).value() == 22.5);
  const Graph other;
  add_parameters(other, {"m"});
  const ExprVector y = other.variables("y", 1);
  BOOST_TEST((Parameter{"l", 2.5}.at(y) == Expr(2.5)));
}

BOOST_AUTO_TEST_CASE(in_a_graph_that_has_it_it_is_a_variable_by_its_name) {
  const Graph graph;
  const ExprVector theta = add_parameters(graph, {"m", "l"});
  const ExprVector x = graph.variables("x", 1);
  const ExprVector slope = gradient(formula(x), theta);
  BOOST_TEST((slope[0] == Expr(0.0)));
  const Function f("slope", {{"theta", theta}, {"x", x}}, slope);
  BOOST_TEST(f({VectorXd::Ones(2), VectorXd::Constant(1, 3.0)})[1] == 9.0);
  BOOST_TEST((parameter_names(graph) == std::vector<std::string>{"m", "l"}));
  BOOST_CHECK_THROW(add_parameters(graph, {"k"}), std::invalid_argument);
}

// d(l x²)/dx at fresh variables, as energies are differentiated.
BOOST_AUTO_TEST_CASE(fresh_graphs_have_the_parameters_of_those_they_lead_to) {
  const Graph graph;
  const ExprVector theta = add_parameters(graph, {"m", "l"});
  const ExprVector x = graph.variables("x", 1);
  const Graph fresh = fresh_graph({x});
  const ExprVector at = fresh.variables("at", 1);
  const ExprVector force = substitute(gradient(formula(at), at), at, x);
  const ExprVector by_l = gradient(force[0], theta);
  BOOST_TEST(Function("by l", {{"theta", theta}, {"x", x}},
                      by_l)({VectorXd::Ones(2), VectorXd::Constant(1, 3.0)})[1] == 6.0);
  BOOST_TEST(parameter_names(fresh_graph({constants(VectorXd::Ones(1))})).empty());
}

BOOST_AUTO_TEST_SUITE_END()
