#include "courant/core/solve/equation_system.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/core/solve/newton.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * unknowns that follow are not written (core/solve/newton.cpp)
BOOST_AUTO_TEST_SUITE(equation_system_test)

namespace {

// x' = v, v' = -λ x, … in small: four unknowns are given by the first.
struct Example {
  Graph graph;
  ExprVector y = graph.variables("y", 5), a = graph.variables("a", 2);
  std::vector<Function::Input> inputs = {{"y", y}, {"a", a}};
  ExprVector equations{5};

  Example() {
    equations << y[1] - a[0] * sin(y[0]), y[3] + y[1] * y[0] - a[1],
        y[0] * y[0] + y[2] * y[2] - 1.0, y[4] - 2.0 * y[3], y[2] - 0.5 * y[4] * y[0] - 0.1;
  }
  EquationSystem system(bool eliminates) const {
    return {"example", inputs, equations, {.eliminates = eliminates}};
  }
};

struct Solution {
  VectorXd y;
  Newton::Result result;
};

Solution solve(const EquationSystem& system, const VectorXd& start, const VectorXd& a) {
  Newton newton(system, {2, 3}, {});
  Solution solution{start, {}};
  const Inputs in(solution.y.data(), {a.data()});
  const double scales[] = {1.0, 1.0};
  solution.result = newton.solve(in, scales);
  return solution;
}

BOOST_AUTO_TEST_CASE(newton_finds_the_same_solution) {
  const Example example;
  const EquationSystem whole = example.system(false), reduced = example.system(true);
  BOOST_TEST(!whole.is_reduced());
  BOOST_TEST(whole.kept().size() == 5);
  BOOST_TEST(reduced.is_reduced());
  BOOST_TEST(reduced.kept().size() == 1);
  BOOST_TEST(reduced.unknowns().output_size() == 5);
  BOOST_TEST(reduced.size() == 5);
  const VectorXd start = (VectorXd(5) << 0.8, 0.3, 0.6, 0.1, 0.2).finished();
  const VectorXd a = Eigen::Vector2d(0.4, 0.7);
  const Solution expected = solve(whole, start, a), found = solve(reduced, start, a);
  BOOST_TEST((expected.result.status == Newton::Status::converged));
  BOOST_TEST((found.result.status == Newton::Status::converged));
  BOOST_TEST((found.y - expected.y).lpNorm<Eigen::Infinity>() < 1e-15);
  const Function F("F", example.inputs, example.equations);
  BOOST_TEST(F({found.y, a}).lpNorm<Eigen::Infinity>() < 1e-15);
}

// What the system gives is not read: it may be anything before.
BOOST_AUTO_TEST_CASE(given_unknowns_are_not_read) {
  const EquationSystem system = Example().system(true);
  VectorXd start = (VectorXd(5) << 0.8, 0.3, 0.6, 0.1, 0.2).finished();
  const VectorXd a = Eigen::Vector2d(0.4, 0.7);
  const Solution expected = solve(system, start, a);
  for (Index j = 0; j < start.size(); ++j)
    if (!std::ranges::binary_search(system.kept(), j)) start[j] = std::nan("");
  const Solution found = solve(system, start, a);
  BOOST_TEST((found.result.status == Newton::Status::converged));
  BOOST_TEST(found.y == expected.y);
}

BOOST_AUTO_TEST_CASE(a_function_is_a_system) {
  const Example example;
  const EquationSystem system =
      Function("F", example.inputs, example.equations, {.differentiate = {"y"}});
  BOOST_TEST(system.size() == 5);
  BOOST_TEST(!system.is_reduced());
  BOOST_CHECK_THROW(EquationSystem(Function("F", example.inputs, example.equations)),
                    std::invalid_argument);
  BOOST_CHECK_THROW(
      EquationSystem(Function("F", example.inputs, example.equations, {.differentiate = {"a"}})),
      std::invalid_argument);
}

}  // namespace

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
