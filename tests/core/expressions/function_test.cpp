#include "courant/core/expressions/function.hpp"

#include <boost/test/unit_test.hpp>
#include <thread>

#include "../random_expressions.hpp"
#include "courant/core/expressions/derivative.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * the Jacobian is transposed
//  * what a Jacobian by other groups is made of is taken for that by the first
BOOST_AUTO_TEST_SUITE(function_test)

namespace {

struct Polar {
  Graph graph;
  ExprVector r = graph.variables("r", 1), angle = graph.variables("angle", 1);
  ExprVector outputs{{r[0] * cos(angle[0]), r[0] * sin(angle[0]), 7.0, r[0]}};
  Function function{
      "polar", {{"r", r}, {"angle", angle}}, outputs, {.differentiate = {"angle", "r"}}};
  VectorXd at_r = VectorXd::Constant(1, 2.0), at_angle = VectorXd::Constant(1, 0.3);
};

BOOST_FIXTURE_TEST_CASE(values_and_jacobians_come_out, Polar) {
  const VectorXd y = function({at_r, at_angle});
  BOOST_TEST(y == Eigen::Vector4d(2.0 * std::cos(0.3), 2.0 * std::sin(0.3), 7.0, 2.0));
  MatrixXd expected = MatrixXd::Zero(4, 2);  // by angle, then r: as asked for
  expected << -y[1], std::cos(0.3), y[0], std::sin(0.3), 0.0, 0.0, 0.0, 1.0;
  BOOST_TEST((function.jacobian({at_r, at_angle}) - expected).norm() < 1e-15);
  BOOST_TEST((MatrixXd(function.sparse_jacobian(std::vector{at_r, at_angle})) - expected).norm() <
             1e-15);
  BOOST_TEST(function.nonzeros() == 5);
  BOOST_TEST(function.jacobian_cols() == 2);
  BOOST_TEST(function.input_count() == 2);
  BOOST_TEST(function.input_size(1) == 1);
  BOOST_TEST(function.output_size() == 4);
  BOOST_TEST(function.name() == "polar");
  BOOST_TEST(!function.is_native());
}

BOOST_FIXTURE_TEST_CASE(the_inner_loop_gets_values_then_entries, Polar) {
  const double* const in[] = {at_r.data(), at_angle.data()};
  VectorXd out(4 + function.nonzeros());
  function.value_and_jacobian(in, out.data());
  BOOST_TEST(out.head(4) == function({at_r, at_angle}));
  const MatrixXd J = function.jacobian({at_r, at_angle});
  for (std::size_t k = 0; k < function.pattern_row().size(); ++k)
    BOOST_TEST(out[4 + static_cast<Index>(k)] ==
               J(function.pattern_row()[k], function.pattern_col()[k]));
}

BOOST_AUTO_TEST_CASE(a_function_outlives_its_graph) {
  Function function;
  BOOST_TEST(function.output_size() == 0);
  {
    Polar polar;
    function = polar.function;
  }
  const Function copy = function;
  BOOST_TEST(copy({VectorXd::Constant(1, 2.0), VectorXd::Zero(1)})[0] == 2.0);
}

BOOST_FIXTURE_TEST_CASE(series_have_a_jacobian_too, Polar) {
  // Along r = 2 + t, angle = 0.3: the derivative of J is ∂J/∂r.
  const double r_series[] = {2.0, 1.0}, angle_series[] = {0.3, 0.0};
  const double* const in[] = {r_series, angle_series};
  VectorXd out(2 * (4 + function.nonzeros()));
  function.taylor_with_jacobian(in, 1, out.data());
  const auto coefficient = [&](Index i, Index order) { return out[2 * i + order]; };
  BOOST_TEST(coefficient(0, 1) == std::cos(0.3));
  const auto close = boost::test_tools::tolerance(1e-15);
  BOOST_TEST(coefficient(4, 0) == -2.0 * std::sin(0.3), close);  // ∂(r cos)/∂angle
  BOOST_TEST(coefficient(4, 1) == -std::sin(0.3), close);
}

// The order in which a program is carried out, and in which slots are used again, changes nothing.
BOOST_AUTO_TEST_CASE(grouping_operations_keeps_every_bit) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 generator(seed);
    Graph graph;
    const ExprVector x = graph.variables("x", 5);
    const ExprVector y = random_expressions(generator, x, 200, false);
    const std::vector<ExprVector> groups = {x};
    const Program grouped(groups, y), as_made(groups, y, Program::Order::as_made);
    const VectorXd point = random_point(generator, 5);
    const double* const in[] = {point.data()};
    VectorXd first(y.size()), second(y.size());
    grouped.run(in, first.data());
    as_made.run(in, second.data());
    // Constants fold to what the program computes.
    const ExprVector folded = substitute(y, x, constants(point));
    for (Index i = 0; i < y.size(); ++i) {
      BOOST_TEST((first[i] == second[i] || (std::isnan(first[i]) && std::isnan(second[i]))));
      BOOST_TEST((first[i] == folded[i].value() || std::isnan(first[i])));
    }
  }
}

BOOST_FIXTURE_TEST_CASE(threads_evaluate_at_once, Polar) {
  std::vector<VectorXd> result(4, VectorXd::Zero(4));
  {
    std::vector<std::jthread> threads;
    for (std::size_t t = 0; t < result.size(); ++t)
      threads.emplace_back([&, t] {
        for (int i = 0; i <= 1000; ++i)
          result[t] =
              function({VectorXd::Constant(1, static_cast<double>(t) + 0.001 * i), at_angle});
      });
  }
  for (std::size_t t = 0; t < result.size(); ++t)
    BOOST_TEST(result[t][3] == static_cast<double>(t) + 0.001 * 1000);
}

BOOST_AUTO_TEST_CASE(says_what_its_jacobian_is_made_of) {
  const Graph graph;
  const ExprVector x = graph.variables("x", 1), h = graph.variables("h", 1),
                   k = graph.variables("k", 1);
  const std::vector<Function::Input> inputs = {{"x", x}, {"h", h}, {"k", k}};
  const ExprVector F = ExprVector::Constant(1, x[0] * h[0] + h[0] * k[0] - k[0] * x[0]);
  const auto groups = [&](const std::vector<std::string>& differentiate) {
    return Function("F", inputs, F, {.differentiate = differentiate}).matrix_numbers().groups();
  };
  BOOST_TEST((groups({"x"}) == std::vector<Index>{1, 2}));
  BOOST_TEST(!groups({"h"}));
  BOOST_TEST(!groups({"x", "h"}));
  BOOST_TEST(!groups({}));
}

BOOST_FIXTURE_TEST_CASE(wrong_arguments_are_refused, Polar) {
  const auto says = [](const std::string& text) {
    return [text](const std::exception& e) {
      return std::string(e.what()).find(text) != std::string::npos;
    };
  };
  BOOST_CHECK_EXCEPTION(function({at_r}), std::invalid_argument,
                        says("got 1 input groups, expected 2"));
  BOOST_CHECK_EXCEPTION(function({at_r, VectorXd::Zero(3)}), std::invalid_argument,
                        says("group 1 has 3 entries, expected 1"));
  BOOST_CHECK_EXCEPTION(Function("f", {{"r", r}}, outputs), std::invalid_argument,
                        says("angle[0]"));
  BOOST_CHECK_EXCEPTION(
      Function("f", {{"r", r}, {"angle", angle}}, outputs, {.differentiate = {"phi"}}),
      std::invalid_argument, says("phi"));
  BOOST_CHECK_EXCEPTION(Function("f", {{"r", r}, {"again", r}, {"angle", angle}}, outputs),
                        std::invalid_argument, says("expected each variable once"));
  BOOST_CHECK_EXCEPTION(Function("f", {{"r", outputs}}, outputs), std::invalid_argument,
                        says("expected a variable"));
  BOOST_CHECK_EXCEPTION(function.taylor(std::vector{MatrixXd(1, 3), MatrixXd(1, 2)}),
                        std::invalid_argument, says("1 x 2"));
}

}  // namespace

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
