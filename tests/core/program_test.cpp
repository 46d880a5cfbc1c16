#include "courant/core/program.hpp"

#include <boost/test/unit_test.hpp>
#include <random>
#include <vector>

BOOST_AUTO_TEST_SUITE(programs)

using namespace courant;

namespace {

VectorXd run(const Program& program, const std::vector<VectorXd>& in) {
  std::vector<const double*> places;
  for (const VectorXd& group : in) places.push_back(group.data());
  VectorXd out(program.output_size());
  program.run(places.data(), out.data());
  return out;
}

VectorXd random_vector(Index n, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  return VectorXd::NullaryExpr(n, [&] { return normal(generator); });
}

}  // namespace

// Instructions that go through the workspace evenly are carried out in loops of their own. Series of order 0 are
// evaluated one instruction after the other: the same operations, so the same bits.
BOOST_AUTO_TEST_CASE(even_stretches_give_the_bits_of_single_instructions) {
  for (const Index n : {1, 7, 8, 9, 100, 5000}) {
    const Graph graph;
    const ExprVector x = graph.variables("x", n), y = graph.variables("y", n);
    std::vector<Expr> outputs;
    // Up and down, with constants, neighbours and quotients.
    for (const bool is_upward : {true, false})
      for (Index k = 0; k < n; ++k) {
        const Index i = is_upward ? k : n - 1 - k;
        const Expr middle = x[i] + 0.5 * y[i];
        const Expr beside = i > 0 ? x[i - 1] + 0.5 * y[i - 1] : Expr(0.0);
        outputs.push_back((is_upward ? 2.0 : 3.0) * middle - beside);
        outputs.push_back(-(middle * y[n - 1 - i]) / (1.0 + square(x[i])));
      }
    // Results that the next instructions need.
    Expr sum = 0.0, product = 1.0, difference = y[0];
    for (Index i = 0; i < n; ++i) {
      sum += x[i];
      product *= 1.0 + 1e-3 * y[i];
      difference = y[i] - difference;
      outputs.push_back(sum);
      outputs.push_back(difference);
    }
    outputs.push_back(product);
    const ExprVector all = Eigen::Map<const ExprVector>(outputs.data(), std::ssize(outputs));
    const std::vector<VectorXd> in = {random_vector(n, 1), random_vector(n, 2)};
    const std::vector<ExprVector> inputs = {x, y};
    for (const auto order : {Program::Order::grouped, Program::Order::as_made}) {
      const Program program(inputs, all, order);
      const double* places[] = {in[0].data(), in[1].data()};
      VectorXd singly(all.size());
      program.run_taylor(places, 0, singly.data());
      BOOST_TEST((run(program, in).array() == singly.array()).all(), n);
    }
  }
}

// By a loop that knows no instructions.
BOOST_AUTO_TEST_CASE(even_stretches_give_what_formulas_say) {
  const Index n = 1000;
  const Graph graph;
  const ExprVector x = graph.variables("x", n);
  ExprVector outputs(n);
  for (Index i = 0; i < n; ++i) outputs[n - 1 - i] = 0.5 * x[i] - x[(i + 1) % n];
  const VectorXd at = random_vector(n, 3);
  const std::vector<ExprVector> inputs = {x};
  const VectorXd out = run(Program(inputs, outputs), {at});
  for (Index i = 0; i < n; ++i) BOOST_TEST_REQUIRE(out[n - 1 - i] == 0.5 * at[i] - at[(i + 1) % n]);
}

BOOST_AUTO_TEST_SUITE_END()
