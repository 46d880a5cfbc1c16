#include "courant/core/algebra/normal_form.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "courant/core/expressions/expr_vectors.hpp"

namespace courant {
namespace {

// x on the unit sphere, v tangent to it, u any vector.
struct Sphere {
  Graph graph;
  ExprVector x = graph.variables("x", 3), v = graph.variables("v", 3), u = graph.variables("u", 3);
  Expr t = graph.variable("t");

  static Expr dot(const ExprVector& a, const ExprVector& b) {
    Expr sum = 0.0;
    for (Index i = 0; i < a.size(); ++i) sum = sum + a[i] * b[i];
    return sum;
  }
  ExprVector variables() const {
    ExprVector all(10);
    all << x, t, v, u;
    return all;
  }
  NormalForm on_sphere() const { return {variables(), {dot(x, x) - 1.0, dot(x, v)}}; }
};

// Mistakes that these cases have to notice:
//  * a square root is no longer what is under it
//  * an equation that is no polynomial of the unknowns is dropped
//  * a relation with a denominator is left out
//  * a root is not eliminated, so that nothing follows
//  * what stands below may be zero, so that the consequence has a factor too many
//  * relations that contradict each other are not noticed (core/algebra/polynomial_relations.cpp)
BOOST_FIXTURE_TEST_SUITE(normal_form_test, Sphere)

BOOST_AUTO_TEST_CASE(projections_of_tangent_vectors_are_nothing) {
  NormalForm form = on_sphere();
  const ExprVector projected = v - x * dot(x, v), twice = projected - x * dot(x, projected);
  for (Index i = 0; i < 3; ++i) {
    BOOST_TEST((form(projected[i]) == v[i]));
    BOOST_TEST((form(twice[i]) == v[i]));
  }
  BOOST_TEST((form(dot(x, x) * v[0]) == v[0]));
  BOOST_TEST(!(form(u[0] - x[0] * dot(x, u)) == u[0]));
  BOOST_TEST(form(Expr(2.0)).is_constant(2.0));
}

// sin(t) and 1/(1 + t) are factors like others; t/t is 1.
BOOST_AUTO_TEST_CASE(what_is_no_polynomial_is_a_factor) {
  NormalForm form = on_sphere();
  BOOST_TEST((form(sin(t) * v[1] * dot(x, x)) == form(v[1] * sin(t))));
  BOOST_TEST(form(sin(t) * dot(x, v)).is_constant(0.0));
  BOOST_TEST(form(dot(x, v) / (1.0 + t)).is_constant(0.0));
  BOOST_TEST((form(t * v[2] / t) == v[2]));
  BOOST_TEST((form(square(v[2]) / (2.0 * v[2])) == form(0.5 * v[2])));
}

// x₀ = √(1 + x₁²): a square root is gone where a variable has its value, in denominators too.
BOOST_AUTO_TEST_CASE(roots_are_what_relations_say) {
  const Expr root = sqrt(1.0 + square(x[1]));
  NormalForm form(variables(), {x[0] - root, v[0] - x[1] * v[1] / root});
  BOOST_TEST((form(root) == x[0]));
  BOOST_TEST(form(square(x[0]) - square(x[1]) - 1.0).is_constant(0.0));
  BOOST_TEST(form(x[0] * v[0] - x[1] * v[1]).is_constant(0.0));
}

// As in the Lagrangian of a pendulum on a sphere: p - u + 2 x (x·u) = 0 with x·p = 0 is u = p.
BOOST_AUTO_TEST_CASE(unknowns_are_eliminated) {
  NormalForm form = on_sphere();
  const ExprVector residual = v - u + 2.0 * (x * dot(x, u));
  const auto found = form.eliminated(std::vector<Expr>(residual.begin(), residual.end()), u);
  BOOST_REQUIRE_EQUAL(found.size(), 3U);
  for (Index i = 0; i < 3; ++i) {
    const bool is_there = std::ranges::any_of(found, [&](const Expr& equation) {
      return form(equation - u[i] + v[i]).is_constant(0.0) ||
             form(equation + u[i] - v[i]).is_constant(0.0);
    });
    BOOST_TEST(is_there);
  }
  BOOST_TEST(form.eliminated({sin(u[0])}, u).empty());
}

// p = u/|u| has the length 1, whatever u is; with a denominator and a root that u is under.
BOOST_AUTO_TEST_CASE(consequences_are_free_of_unknowns) {
  NormalForm form(variables(), {});
  const Expr length = sqrt(dot(u, u));
  std::vector<Expr> equations;
  for (Index i = 0; i < 3; ++i) equations.push_back(v[i] - 2.0 * u[i] / length);
  const auto found = form.consequences(equations, u);
  BOOST_REQUIRE_EQUAL(found.size(), 1U);
  const Expr sphere = dot(v, v) - 4.0;
  BOOST_TEST(
      (form(found[0] - sphere).is_constant(0.0) || form(found[0] + sphere).is_constant(0.0)));
  // v₀ = 1/(u₀ + 1), v₁ = u₀ + 2: a denominator with several terms.
  const auto hyperbola = form.consequences({v[0] - 1.0 / (u[0] + 1.0), v[1] - u[0] - 2.0}, u);
  BOOST_REQUIRE_EQUAL(hyperbola.size(), 1U);
  BOOST_TEST((form(hyperbola[0] - v[0] * v[1] + v[0] + 1.0).is_constant(0.0)));
  BOOST_TEST(form.consequences({v[0] - sin(u[0])}, u).empty());
  BOOST_TEST(form.consequences({v[0] - u[0]}, u).empty());
}

BOOST_AUTO_TEST_CASE(contradictions_are_noticed) {
  const Expr circle = square(x[0]) + square(x[1]);
  BOOST_TEST(NormalForm(variables(), {circle - 1.0, circle - 2.0}).hold_nowhere());
  BOOST_TEST(NormalForm(variables(), {x[0], x[0] - 1.0}).hold_nowhere());
  BOOST_TEST(!NormalForm(variables(), {circle - 1.0, x[0] - 2.0}).hold_nowhere());
  BOOST_TEST(!NormalForm(variables(), {circle}).hold_nowhere());
}

// By y and exp(z), not by x, which may be 0.
BOOST_AUTO_TEST_CASE(common_factors_are_divided_out) {
  NormalForm form(variables(), {});
  const Expr whole = x[0] * x[1] * exp(x[2]) * (v[0] + v[1]);
  const auto not_x0 = [&](const Expr& factor) { return factor.node() != x[0].node(); };
  const auto all = [](const Expr&) { return true; };
  BOOST_TEST((form(form.without_factors(whole, not_x0) - x[0] * (v[0] + v[1])).is_constant(0.0)));
  BOOST_TEST((form(form.without_factors(whole, all) - (v[0] + v[1])).is_constant(0.0)));
  const Expr below = v[0] / x[0] + v[1] / square(x[0]);
  BOOST_TEST((form.without_factors(below, all) == below));
  BOOST_TEST((form.without_factors(x[0] + x[1], all) == x[0] + x[1]));
  BOOST_TEST(form.without_factors(Expr(2.0), all).value() == 2.0);
}

BOOST_AUTO_TEST_CASE(what_is_too_long_stays_as_it_is) {
  NormalForm form = on_sphere();
  Expr product = 1.0;
  for (int i = 0; i < 8; ++i) product = product * (u[0] + i * u[1] + u[2] + t + v[0] + i);
  BOOST_TEST((form(product) == product));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
}  // namespace courant
