#include "courant/core/expressions/held_part.hpp"

#include <boost/test/unit_test.hpp>
#include <random>

#include "../random_expressions.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/function.hpp"
#include "courant/core/expressions/native.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * parts of what is held are held too
//  * outputs that stay are worked out each time
//  * what is held is not worked out for a single value (core/expressions/function.cpp)
//  * leaves of another graph are taken (core/expressions/subgraph.cpp)
BOOST_AUTO_TEST_SUITE(held_part_test)

namespace {

struct Parts {
  Graph graph;
  ExprVector x = graph.variables("x", 2), p = graph.variables("p", 2);
};

BOOST_FIXTURE_TEST_CASE(what_stays_is_found_where_it_ends, Parts) {
  const Expr product = p[0] * p[1], root = sqrt(product);
  const ExprVector outputs{{root * x[0] + p[1], product + 1.0, x[1], p[0], 3.0, sin(x[0] * root)}};
  const ExprVector held = held_part(outputs, x);
  // Not p[1], which is no operation, and not the product inside of the root and the sum.
  BOOST_TEST_REQUIRE(held.size() == 2);
  BOOST_TEST((held[0] == root));
  BOOST_TEST((held[1] == outputs[1]));
  BOOST_TEST(held_part(outputs, joined(x, p)).size() == 0);
  BOOST_TEST(held_part(ExprVector{{2.0, x[0]}}, x).size() == 0);
}

// Splitting an evaluation changes no bit, whichever way it is carried out.
BOOST_AUTO_TEST_CASE(held_functions_have_the_same_bits) {
  int held_ones = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 generator(seed);
    const Graph graph;
    const ExprVector x = graph.variables("x", 3), p = graph.variables("p", 3);
    const ExprVector all = random_expressions(generator, joined(p, x), 60, true);
    const ExprVector y = all.tail(8);
    const std::vector<Function::Input> inputs = {{"x", x}, {"p", p}};
    const Function plain("f", inputs, y, {.differentiate = {"x"}});
    std::vector<Function> split = {
        Function("f", inputs, y, {.differentiate = {"x"}, .varying = {"x"}})};
    if (machine_compiler()->is_available())
      split.emplace_back(
          "f", inputs, y,
          Function::Options{.differentiate = {"x"}, .varying = {"x"}, .backend = Backend::native});
    const VectorXd at_p = random_point(generator, 3);
    for (const Function& f : split) {
      VectorXd held(f.held_size());
      held_ones += held.size() > 0 ? 1 : 0;
      VectorXd at_x = random_point(generator, 3);
      const double* const in[] = {at_x.data(), at_p.data(), held.data()};
      f.hold(in, held.data());
      for (int i = 0; i < 3; ++i, at_x = random_point(generator, 3)) {
        const double* const now[] = {at_x.data(), at_p.data(), held.data()};
        const Index size = y.size() + f.nonzeros();
        VectorXd expected(size), with_held(size), at_once(size), values(y.size());
        plain.value_and_jacobian(now, expected.data());
        f.value_and_jacobian_with_held(now, with_held.data());
        f.value_and_jacobian(now, at_once.data());
        f.value_with_held(now, values.data());
        const auto same = [](const VectorXd& a, const VectorXd& b) {
          return (a.array() == b.array() || (a.array().isNaN() && b.array().isNaN())).all();
        };
        BOOST_TEST(same(with_held, expected));
        BOOST_TEST(same(at_once, expected));
        BOOST_TEST(same(values, expected.head(y.size())));
        f.value(now, values.data());
        BOOST_TEST(same(values, expected.head(y.size())));
      }
    }
  }
  BOOST_TEST(held_ones > 10);
}

// What is held is that of the numbers that hold() got, and few operations are not worth the call.
BOOST_FIXTURE_TEST_CASE(what_is_held_stays, Parts) {
  const ExprVector F{{x[0] * exp(p[0] * p[1] + 1.0) / sqrt(p[1])}};
  const Function f("F", {{"x", x}, {"p", p}}, F, {.varying = {"x"}});
  BOOST_TEST_REQUIRE(f.held_size() > 0);
  VectorXd held(f.held_size()), at_x = VectorXd::Ones(2), at_p = VectorXd::Ones(2);
  const double* const in[] = {at_x.data(), at_p.data(), held.data()};
  f.hold(in, held.data());
  double before = 0.0, after = 0.0, anew = 0.0;
  f.value_with_held(in, &before);
  at_p[0] = 2.0;
  f.value_with_held(in, &after);
  f.value(in, &anew);
  BOOST_TEST(before == after);
  BOOST_TEST(anew == std::exp(3.0));
  at_x[0] = 2.0;
  f.value_with_held(in, &after);
  BOOST_TEST(after == 2.0 * before);

  BOOST_TEST(Function("f", {{"x", x}, {"p", p}}, ExprVector{{x[0] / p[0]}}, {.varying = {"x"}})
                 .held_size() == 0);
  BOOST_TEST(Function("f", {{"x", x}, {"p", p}}, F).held_size() == 0);
  BOOST_CHECK_THROW(Function("f", {{"x", x}, {"p", p}}, F, {.varying = {"q"}}),
                    std::invalid_argument);
}

}  // namespace

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
