#include <boost/test/unit_test.hpp>
#include <thread>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr.hpp"
#include "courant/core/expressions/function.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(graph_test)

namespace {

BOOST_AUTO_TEST_CASE(equal_subexpressions_are_one_node) {
  Graph graph;
  const Expr x = graph.variable("x"), y = graph.variable("y");
  BOOST_TEST((x * y + sin(x)).node() == (x * y + sin(x)).node());
  BOOST_TEST((x * y).node() == (y * x).node());  // products and sums commute to the last bit
  BOOST_TEST((x + 2.5).node() == (2.5 + x).node());
  BOOST_TEST((x - y).node() != (y - x).node());
  BOOST_TEST(pow(x, 3).node() != pow(x, 4).node());
  BOOST_TEST(stumpff(1, x).node() != arccos_factor(1, x).node());
  const std::uint32_t size = graph.size();
  const Expr again = (x * y + sin(x)) * pow(x, 3);
  BOOST_TEST(graph.size() == size + 1);
  BOOST_TEST((again == (x * y + sin(x)) * pow(x, 3)));
}

BOOST_AUTO_TEST_CASE(constants_are_told_apart_by_their_bits) {
  Graph graph;
  const Expr x = graph.variable("x");
  BOOST_TEST(graph.make(Op::multiply, 0, x, 0.0).node() !=
             graph.make(Op::multiply, 0, x, -0.0).node());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST((x * nan).node() == (x * nan).node());
}

BOOST_AUTO_TEST_CASE(variables_of_one_name_differ) {
  Graph graph;
  const Expr first = graph.variable("x"), second = graph.variable("x");
  BOOST_TEST(first.node() != second.node());
  BOOST_TEST(graph.name(second.node()) == "x");
  const ExprVector q = graph.variables("q", 3);
  BOOST_TEST(graph.name(q[2].node()) == "q[2]");
}

BOOST_AUTO_TEST_CASE(nodes_keep_their_place_while_the_graph_grows) {
  Graph graph;
  Expr sum = graph.variable("x");
  const Node* first = &graph.node(sum.node());
  for (int i = 1; i <= 5000; ++i) sum = sum + static_cast<double>(i);
  BOOST_TEST(first == &graph.node(0));
  BOOST_TEST(graph.size() == 1 + 2 * 5000);
  for (std::uint32_t i = 1; i <= 5000; ++i) BOOST_REQUIRE(graph.constant(2 * i - 1) == i);
}

BOOST_AUTO_TEST_CASE(an_expression_keeps_its_graph_alive) {
  Expr kept;
  ExprVector variables;
  {
    const Graph graph;
    variables = graph.variables("x", 2);
    kept = sin(variables[0]) * variables[1] + 3.0;
  }
  const Expr grown = kept * kept + variables[0];
  BOOST_TEST(to_string(kept) == "sin(x[0])*x[1] + 3");
  const Function f("f", {{"x", variables}}, ExprVector::Constant(1, grown));
  const double value = std::sin(0.5) * 2.0 + 3.0;
  BOOST_TEST(f({VectorXd{{0.5, 2.0}}})[0] == value * value + 0.5);
}

BOOST_AUTO_TEST_CASE(copies_of_a_graph_are_the_same_graph) {
  const Graph graph, copy = graph, other;
  BOOST_TEST((graph == copy));
  BOOST_TEST(!(graph == other));
  const Expr sum = graph.variable("x") + copy.variable("y");
  BOOST_TEST((sum.graph() == graph));
  BOOST_TEST(Expr(1.0).graph().is_none());
}

BOOST_AUTO_TEST_CASE(two_graphs_do_not_mix) {
  Graph here, there;
  const Expr x = here.variable("x"), y = there.variable("y");
  BOOST_CHECK_THROW(x + y, std::invalid_argument);
  BOOST_CHECK_THROW(select(x < 0, y, x), std::invalid_argument);
  BOOST_CHECK_THROW(gradient(x, ExprVector::Constant(1, x) + ExprVector::Constant(1, y)),
                    std::invalid_argument);
  BOOST_CHECK_NO_THROW(x + y * 0.0);  // a constant after simplification
}

// A chain of 10⁶ operations: nothing recurses over depth.
BOOST_AUTO_TEST_CASE(a_deep_graph_is_differentiated_compiled_and_printed) {
  constexpr int kDepth = 1'000'000;
  Graph graph;
  const Expr x = graph.variable("x"), y = graph.variable("y");
  Expr f = x;
  for (int i = 0; i < kDepth; ++i) f = 0.999999 * f + y;
  const double decay = std::pow(0.999999, kDepth);
  ExprVector both(2);
  both << x, y;
  const ExprVector slope = gradient(f, both);
  const ExprVector rate = tangent(ExprVector::Constant(1, f), both, both);
  BOOST_TEST(substitute(f, both, constants(Eigen::Vector2d(1.0, 0.0))).value() == decay,
             boost::test_tools::tolerance(1e-9));
  ExprVector outputs(3);
  outputs << f, slope[0], rate[0];
  const Function function("deep", {{"x", both}}, outputs);
  BOOST_TEST(function.instruction_count() >= 2 * kDepth);
  const VectorXd value = function({Eigen::Vector2d(2.0, 3.0)});
  const double geometric = (1.0 - decay) / 1e-6;
  BOOST_TEST(value[0] == 2.0 * decay + 3.0 * geometric, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(value[1] == decay, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(value[2] == value[0], boost::test_tools::tolerance(1e-9));  // f is linear
  BOOST_TEST(to_string(f, 50).size() <= 53u);
}

BOOST_AUTO_TEST_CASE(several_threads_extend_one_graph) {
  Graph graph;
  const ExprVector x = graph.variables("x", 4);
  constexpr int kThreads = 4;
  std::vector<Expr> result(kThreads);
  std::vector<std::string> name(kThreads);
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < kThreads; ++t)
      threads.emplace_back([&, t] {
        Expr sum = 0.0;
        for (int i = 0; i < 2000; ++i)
          sum += sin(x[i % 4] * static_cast<double>(i)) * x[(i + 1) % 4];
        for (int i = 0; i < 100; ++i)
          name[t] = graph.name(graph.variable("own " + std::to_string(t)).node());
        result[t] = gradient(sum, x).sum();
      });
  }
  // The same work done at once by all is one expression.
  for (int t = 0; t < kThreads; ++t) {
    BOOST_TEST(result[t].node() == result[0].node());
    BOOST_TEST(name[t] == "own " + std::to_string(t));
  }
  const VectorXd at = Eigen::Vector4d(0.3, -0.2, 0.7, 1.1);
  double expected = 0.0;
  for (int i = 0; i < 2000; ++i)
    expected += i * std::cos(at[i % 4] * i) * at[(i + 1) % 4] + std::sin(at[i % 4] * i);
  BOOST_TEST(Function("f", {{"x", x}}, ExprVector::Constant(1, result[0]))({at})[0] == expected,
             boost::test_tools::tolerance(1e-9));
}

}  // namespace

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
