#include "courant/core/expressions/program.hpp"

#include <boost/test/unit_test.hpp>
#include <random>
#include <vector>

#include "courant/core/expressions/expr_vectors.hpp"

// Mistakes that these cases have to notice:
//  * operands of even stretches are those of the next instruction
//  * stretches that go down are turned around though results are operands of others
//  * results that go down the workspace go up
//  * inputs with gaps between them are taken as if they were side by side
//  * outputs are taken as if they were side by side
//  * stretches whose results are far apart are taken for even ones
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

// What is side by side is read and written at once: with gaps, from several groups, values that are written twice,
// and for numbers of several coefficients.
BOOST_AUTO_TEST_CASE(inputs_and_outputs_find_their_places) {
  const Index n = 40;
  const Graph graph;
  const ExprVector x = graph.variables("x", n), y = graph.variables("y", n);
  const VectorXd at_x = random_vector(n, 4), at_y = random_vector(n, 5);
  std::vector<Expr> outputs;
  std::vector<double> expected;
  for (Index i = 0; i < n; ++i) {
    if (i % 7 == 3) continue;  // not read
    outputs.push_back(x[i]);
    expected.push_back(at_x[i]);
    if (i % 5 == 2) {
      outputs.push_back(y[n - 1 - i] + 1.0);
      expected.push_back(at_y[n - 1 - i] + 1.0);
      outputs.push_back(outputs[outputs.size() / 2]);
      expected.push_back(expected[expected.size() / 2]);
      outputs.push_back(2.5);
      expected.push_back(2.5);
    }
  }
  const ExprVector all = Eigen::Map<const ExprVector>(outputs.data(), std::ssize(outputs));
  const std::vector<ExprVector> inputs = {y, x};
  const Program program(inputs, all);
  const VectorXd out = run(program, {at_y, at_x});
  BOOST_TEST(std::vector<double>(out.begin(), out.end()) == expected,
             boost::test_tools::per_element());

  // x + s, y + 2 s.
  VectorXd series_x(2 * n), series_y(2 * n), series(2 * out.size());
  for (Index i = 0; i < n; ++i) {
    series_x.segment(2 * i, 2) << at_x[i], 1.0;
    series_y.segment(2 * i, 2) << at_y[i], 2.0;
  }
  const double* places[] = {series_y.data(), series_x.data()};
  program.run_taylor(places, 1, series.data());
  for (Index i = 0; i < out.size(); ++i) {
    const Expr& output = all[i];
    const double slope = output.is_constant() ? 0.0 : depends(all.segment(i, 1), x) ? 1.0 : 2.0;
    BOOST_TEST(series[2 * i] == out[i]);
    BOOST_TEST(series[2 * i + 1] == slope);
  }
}

BOOST_AUTO_TEST_SUITE_END()
