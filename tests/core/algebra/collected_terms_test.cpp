#include "courant/core/algebra/collected_terms.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>
#include <string>

#include "courant/core/expressions/function.hpp"
#include "courant/core/numbers/uncertain.hpp"

// Mistakes that these cases have to notice:
//  * coefficients that are round-off stay (core/algebra/sum_of_terms.cpp)
//  * terms with a known factor are scaled by numbers that round (core/algebra/sum_of_terms.cpp)
//  * what is known of a sum is added up last (core/algebra/sum_of_terms.cpp)
//  * sums that are needed elsewhere are never taken apart
//  * a quotient by a number is a product with it
//  * sums are written anew though no terms meet
//  * sums without terms that meet lose their parentheses
//  * numbers in a row are joined that make another number by rounding
//  * two known factors in a row are rounded together
//  * a product in a product with what is known loses its parentheses
//  * what depends on what varies is taken for known (core/expressions/subgraph.cpp)
BOOST_AUTO_TEST_SUITE(collected_terms)

using namespace courant;

namespace {

struct Variables {
  Graph graph = {};
  Expr p = graph.variable("p"), d = graph.variable("d"), h = graph.variable("h"),
       x = graph.variable("x"), y = graph.variable("y");
};

Expr one(const Expr& a) { return collected(ExprVector::Constant(1, a))[0]; }
std::string text(const Expr& a) { return to_string(one(a)); }

ExprVector vector(std::initializer_list<Expr> list) {
  ExprVector result(static_cast<Index>(list.size()));
  std::copy(list.begin(), list.end(), result.begin());
  return result;
}

}  // namespace

BOOST_FIXTURE_TEST_CASE(equal_terms_meet, Variables) {
  BOOST_TEST(text((p + d - p) / h) == "d/h");
  BOOST_TEST(text(0.5 * p - (-0.5) * p - 0.25 * d) == "p - 0.25*d");
  BOOST_TEST(text((0.5 * x - 0.5 * (p + y + x - y)) / 0.25) == "-2*p");
  BOOST_TEST(text(p - (p - (d - (d - x)))) == "x");
  BOOST_TEST(one(2.0 * (p + d) - p - (p + d) - d).is_constant(0.0));
  BOOST_TEST(text(sin(p + d - p) * sin(d) + p) == "sin(d)^2 + p");
  BOOST_TEST(text(2.0 * (x - y) + 2.0 * (x + p - x)) == "2*(x - y + p)");
  BOOST_TEST(text((x + 3.0) - (x - 4.0) + y) == "y + 7");
}

// Coefficients that are round-off of 0.1 + 0.2 are nothing, others stay.
BOOST_FIXTURE_TEST_CASE(round_off_of_coefficients_is_nothing, Variables) {
  BOOST_TEST(text(0.1 * x + y + 0.2 * x - 0.3 * x) == "y");
  BOOST_TEST(text(0.1 * x + y + 0.2 * x - 0.29999999 * x) != "y");
}

// A sum that is needed in several places is taken apart for terms that meet, and for nothing else.
BOOST_FIXTURE_TEST_CASE(shared_sums_stay, Variables) {
  const Expr q = x + 0.5 * d, r = y + 0.5 * p;
  const ExprVector all = vector({q * q, r * r, q - r, q - x, (q - r) - (x + q + p)});
  const ExprVector result = collected(all);
  const auto same = [](const Expr& a, const Expr& b) { return to_string(a) == to_string(b); };
  BOOST_TEST(same(result[0], all[0]));
  BOOST_TEST(same(result[2], all[2]));
  BOOST_TEST(to_string(result[3]) == "0.5*d");
  BOOST_TEST(same(result[4], -r - x - p));
}

// What has no terms that meet is the same expression, so that its bits are the same.
BOOST_FIXTURE_TEST_CASE(other_expressions_stay, Variables) {
  for (const Expr& a : {2.0 * (x + y) - p, x * y - x * p, (x + p) / 3.0 - sqrt(y), p / 0.0 - p,
                        -(x - y) + 1e300 * h, x * x - 2.0 * (x + 1.0)}) {
    const Expr b = one(a);
    BOOST_TEST(b.node() == a.node());
    BOOST_TEST((b.graph() == a.graph()));
  }
}

// A diode beside two resistors: the current of the diode stays a difference that is nothing for small voltages.
BOOST_FIXTURE_TEST_CASE(parentheses_without_terms_that_meet_stay, Variables) {
  BOOST_TEST(text((x - p) / 8.0 + 1e-14 * (exp(x / 0.025) - 1.0) + x / 4.0) ==
             "0.375*x - 0.125*p + 1e-14*(exp(x/0.025) - 1)");
  const Expr q = d + h;
  BOOST_TEST(to_string(collected(vector({q * q, (q + 2.0) - d + 3.0 * (y - 2.0)}))[1]) ==
             "h + 3*(y - 2) + 2");
}

// With d and y that vary, and p, h, x that are known.
BOOST_FIXTURE_TEST_CASE(known_parts_are_put_together, Variables) {
  const auto of = [&](const Expr& a) {
    return to_string(collected(ExprVector::Constant(1, a), vector({d, y}))[0]);
  };
  BOOST_TEST(of(h * ((y / 2.0) / (-4.0)) - p) == "-0.125*h*y - p");
  BOOST_TEST(of(-2.0 * (0.25 * sin(d))) == "-0.5*sin(d)");
  BOOST_TEST(of(-(d / 2.0) / (-0.5)) == "d");
  BOOST_TEST(of((0.5 * d / h + sin(y)) / 0.5 - (p + x - d) / h) ==
             "2*1/h*(d - 0.5*(p + x)) + 2*sin(y)");
  BOOST_TEST(of(d / h + y - (x - d) / h) == "2*1/h*(d - x/2) + y");
  BOOST_TEST(of(d / h + (d + (y + x / h) / p) / h) == "2*1/h*(d + 0.5*(y + x/h)/p)");
  // Not 3/h, which is rounded once more in each step.
  BOOST_TEST(of(d / h + y - (x - 2.0 * d) / h) == "d/h + y - (x - 2*d)/h");
  // Terms that may cancel keep their parentheses, and what cancels its order.
  const Expr difference = (exp(p) - 1.0) * h;
  for (const Expr& a : {h * (d - x) + p * d, (d + (y + (x - d) / h) / p) / h,
                        0.3 * (exp(d) - 1.0) + 0.7 * (exp(y) - 1.0), difference + d,
                        3.0 * (2.0 * sin(d)), 2.0 * ((d + y) / h), p * (h * d)})
    BOOST_TEST(collected(ExprVector::Constant(1, a), vector({d, y}))[0].node() == a.node(), a);
  // Known, or without terms that meet.
  for (const Expr& a :
       {p * x - (p + 2.0 * x), h * (d + y) - p, p + d - y / h, 2.0 * d - 3.0 * sin(y)})
    BOOST_TEST(collected(ExprVector::Constant(1, a), vector({d, y}))[0].node() == a.node());
}

// Of many random expressions the values stay, to round-off, and programs become shorter. (One may grow by an operation that
// several sums shared.)
BOOST_AUTO_TEST_CASE(values_stay_and_programs_become_shorter) {
  Index before_all = 0, after_all = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Graph graph;
    const ExprVector x = graph.variables("x", 4);
    std::mt19937 generator(seed);
    std::uniform_int_distribution<int> choice(0, 5);
    std::uniform_real_distribution<double> number(-2.0, 2.0);
    std::vector<Expr> known(x.begin(), x.end());
    const auto any = [&] { return known[generator() % known.size()]; };
    for (int k = 0; k < 25; ++k) {
      const Expr a = any(), b = any();
      switch (choice(generator)) {
        case 0:
          known.push_back(a + b);
          break;
        case 1:
          known.push_back(a - b);
          break;
        case 2:
          known.push_back(number(generator) * a);
          break;
        case 3:
          known.push_back(a / 0.25 - b);
          break;
        case 4:
          known.push_back(cos(a) - b);
          break;
        default:
          known.push_back(-a);
      }
    }
    const ExprVector before = vector({known.back(), known[known.size() - 2], known[8]});
    const Function f("before", {{"x", x}}, before), g("after", {{"x", x}}, collected(before));
    BOOST_TEST(g.instruction_count() <= f.instruction_count() + 1);
    before_all += f.instruction_count();
    after_all += g.instruction_count();
    const VectorXd at = VectorXd::NullaryExpr(4, [&] { return number(generator); });
    std::vector<Uncertain> in(at.begin(), at.end()), values(3);
    const Uncertain* groups[] = {in.data()};
    f.taylor_with_jacobian(groups, 0, values.data());
    const VectorXd result = g({at});
    for (Index i = 0; i < 3; ++i) {
      const Uncertain& value = values[static_cast<std::size_t>(i)];
      BOOST_TEST(std::fabs(result[i] - value.value) <= 2.0 * value.error + 1e-300);
    }
  }
  BOOST_TEST(10 * after_all < 9 * before_all);
}

// A sum of very many terms takes no recursion, and no time that grows with its square.
BOOST_AUTO_TEST_CASE(long_sums) {
  const Graph graph;
  const ExprVector x = graph.variables("x", 100'000);
  Expr sum = 0.0, shared = 0.0;
  for (Index i = 0; i < x.size(); ++i) sum += x[i];
  for (Index i = 0; i + 1 < x.size(); ++i)
    shared += sin(x[i]) * (x[i + 1] - x[i]) - (x[i + 1] - x[i]);
  const ExprVector result = collected(vector({sum - x[7], shared}));
  BOOST_TEST(to_string(result[0]).find("x[7] ") == std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
