#include "courant/core/language/formula.hpp"

#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/function.hpp"

// Mistakes that these cases have to notice:
//  * a cross product of the other hand (core/language/formula_value.cpp)
//  * a norm without its root (core/language/formula_value.cpp)
//  * greater or equal is greater (core/language/formula_value.cpp)
//  * a sum ends before its last term (core/language/formula_parser.cpp)
//  * the last element of an array is out of range (core/language/formula_parser.cpp)
//  * what does not count is computed (core/language/formula_parser.cpp)
BOOST_AUTO_TEST_SUITE(formula_test)

using namespace courant;

namespace {

bool same_node(const Expr& a, const Expr& b) {
  return !a.is_constant() && a.graph() == b.graph() && a.node() == b.node();
}

ExprVector numbers(std::initializer_list<double> values) {
  ExprVector vector(static_cast<Index>(values.size()));
  std::copy(values.begin(), values.end(), vector.begin());
  return vector;
}

// x = 3, y = -0.7, a = (1, 2, 3), b = (-2, 0.5, 4), r = 4 rows (i, i², 1), n = 4, m = 2; x' = 5, r'
// = r + 10.
SymbolTable constant_symbols() {
  SymbolTable symbols;
  symbols.add("x", 3.0);
  symbols.add("y", -0.7);
  symbols.add("a", {3}, numbers({1, 2, 3}));
  symbols.add("b", {3}, numbers({-2, 0.5, 4}));
  const ExprVector r = numbers({0, 0, 1, 1, 1, 1, 2, 4, 1, 3, 9, 1});
  symbols.add("r", {4, 3}, r);
  symbols.add("n", 4);
  symbols.add("m", 2);
  symbols.add_velocity("x", 5.0);
  symbols.add_velocity("r", {4, 3}, r + ExprVector::Constant(12, 10.0));
  return symbols;
}

double evaluate(const std::string& text) { return parse_formula(text, constant_symbols()).value(); }

void check(const std::string& text, double expected) {
  const double found = evaluate(text);
  BOOST_TEST(std::fabs(found - expected) <= 1e-15 * std::fabs(expected),
             text << " = " << found << ", expected " << expected);
}

}  // namespace

BOOST_AUTO_TEST_CASE(precedence) {
  check("1 + 2*3", 7);
  check("(1 + 2)*3", 9);
  check("7 - 2 - 1", 4);
  check("8/4/2", 1);
  check("8/4*2", 4);
  check("2 - -2", 4);
  check("2*-3", -6);
  check("--2", 2);
  check("+2 - +3", -1);
  check("-2^2", -4);
  check("(-2)^2", 4);
  check("2^-1", 0.5);
  check("2^-1*4", 2);
  check("2^-2^2", 1.0 / 16);  // 2^(-(2^2))
  check("2^3^2", 512);
  check("-x^2 + 1", -8);
  check("2*x^2", 18);
  check("1 - 2^2*3", -11);
  check("if(1 + 1 == 2 && 2 < 1 + 2, 1, 0)", 1);
  check("if(1 > 2 || 1 < 2 && 2 < 1, 1, 0)", 0);  // || last
  check("if((1 < 2 || 1 < 2) && 2 < 1, 1, 0)", 0);
  check("if(1 < 2 || 2 < 1 && 2 < 1, 1, 0)", 1);
  check("if(!(1 > 2) && 1 < 2, 1, 0)", 1);
  check(" \t1\n+\r1 ", 2);
}

BOOST_AUTO_TEST_CASE(numbers_and_constants) {
  check("1e-3", 1e-3);
  check(".5", 0.5);
  check("2.5E+2", 250);
  check("pi", std::numbers::pi);
  check("e", std::numbers::e);
  check("2*e", 2 * std::numbers::e);
}

BOOST_AUTO_TEST_CASE(functions) {
  const double y = -0.7;
  check("sqrt(2)", std::sqrt(2.0));
  check("exp(y)", std::exp(y));
  check("log(x)", std::log(3.0));
  check("sin(y)", std::sin(y));
  check("cos(y)", std::cos(y));
  check("tan(y)", std::tan(y));
  check("asin(y)", std::asin(y));
  check("acos(y)", std::acos(y));
  check("atan(y)", std::atan(y));
  check("atan2(y, x)", std::atan2(y, 3.0));
  check("sinh(y)", std::sinh(y));
  check("cosh(y)", std::cosh(y));
  check("tanh(y)", std::tanh(y));
  check("abs(y)", 0.7);
  check("sign(y) + sign(0) + 5*sign(x)", 4);
  check("min(x, y)", y);
  check("min(4, 3, 2, 5)", 2);
  check("max(4, 3, 2, 5)", 5);
  check("pow(x, 2)", 9);
  check("x^2.5", std::pow(3.0, 2.5));
}

BOOST_AUTO_TEST_CASE(arrays) {
  check("a[0] + 10*a[1] + 100*a[n-2]", 321);
  check("r[2][1]", 4);
  check("r[m][m-1]", 4);
  check("a[(m + 2)/4]", 2);
  check("x'", 5);
  check("r[3][1]'", 19);
  check("dot(a, b)", 11);
  check("norm(a)", std::sqrt(14.0));
  check("dot(r[1], a)", 6);
  check("dot(r[1]', a)", 66);
  check("norm(r[2]' - r[2])", std::sqrt(300.0));
  check("norm(2*a - b/2 + (-a)*3)", std::sqrt(0 + 2.25 * 2.25 + 25));
  check("cross(a, b)[0]", 2 * 4 - 3 * 0.5);
  check("cross(a, b)[1]", 3 * -2 - 1 * 4);
  check("cross(a, b)[2]", 1 * 0.5 - 2 * -2);
  check("dot(cross(a, b), a)", 0);
  check("(a + b)[1]", 2.5);
}

BOOST_AUTO_TEST_CASE(sums_and_products) {
  check("sum(i, 1, 10, i)", 55);
  check("sum(i, 1, 10, i^2) - 10*11*21/6", 0);
  check("prod(i, 1, 5, i)", 120);
  check("sum(i, 0, n-1, r[i][1])", 14);
  check("sum(i, 0, n-2, (r[i+1][1] - r[i][1])^2)", 1 + 9 + 25);
  check("sum(i, 0, n-1, sum(j, 0, m, r[i][j]))", 6 + 14 + 4);
  check("sum(i, 0, n-2, sum(j, i+1, n-1, 10*i + j))", 1 + 2 + 3 + 12 + 13 + 23);
  check("sum(i, 0, n-1, dot(r[i], a))", 6 + 28 + 12);
  check("sum(i, 0, n-1, r[i][0]')", 46);
  check("sum(i, -2, 2, i)", 0);
  check("sum(i, 0, 3, i)*sum(i, 0, 3, i)", 36);  // an index is free again after its sum
  check("sum(i, 1, 0, r[i+7][2])", 0);           // empty
  check("prod(i, 1, 0, r[i+7][2])", 1);
  check("sum(i, 0, n-1, sum(j, 0, i-1, 1))", 6);
  BOOST_TEST(std::fabs(evaluate("4*sum(k, 0, 99999, (-1)^k/(2*k + 1)) - pi") + 1e-5) <
             1e-9);  // Leibniz
}

BOOST_AUTO_TEST_CASE(conditions) {
  check("if(x > 0, 1, 2)", 1);
  check("if(x < 0, 1, 2)", 2);
  check("if(x >= 3 && x <= 3, 1, 2)", 1);
  check("if(x == 3, 1, 2) + if(x != 3, 10, 20)", 21);
  check("if(x < 0 || y < 0, 1, 2)", 1);
  check("if(!(x < 0), 1, 2)", 1);
  check("if(!(x < 0) && !(y > 0), 1, 2)", 1);
}

BOOST_AUTO_TEST_CASE(what_a_known_condition_rules_out_is_not_looked_up) {
  check("sum(i, 0, n-1, if(i < n-1, r[i+1][0], r[0][0]) - r[i][0])", 0);  // periodic
  check("sum(i, 0, n-1, if(i > 0 && r[i-1][0] > 0, 1, 0))", 2);
  check("sum(i, 0, n-1, if(i == 0 || r[i-1][0] > 0, 1, 0))", 3);
  check("if(1 < 0, sum(i, 0, 10^9, r[i/2][9]), 7)", 7);
  // The negative control: a condition on a coordinate rules nothing out.
  Graph graph;
  SymbolTable symbols;
  const ExprVector q = graph.variables("q", 2);
  symbols.add("q", {2}, q);
  BOOST_CHECK_THROW(parse_formula("if(q[0] > 0, q[2], 0)", symbols), FormulaError);
  BOOST_CHECK_NO_THROW(parse_formula("if(0 > 1, q[2], 0)", symbols));
}

BOOST_AUTO_TEST_CASE(formulas_are_expressions_of_the_same_graph) {
  Graph graph;
  SymbolTable symbols;
  const ExprVector q = graph.variables("q", 2);
  symbols.add("q", {2}, q);
  symbols.add("k", 2.5);
  symbols.add("θ", q[1]);
  BOOST_TEST(same_node(parse_formula("q[0]^2/2 + k*cos(q[1])", symbols),
                       q[0] * q[0] / 2 + 2.5 * cos(q[1])));
  BOOST_TEST(same_node(parse_formula("sin(θ)", symbols), sin(q[1])));
  BOOST_TEST(!same_node(parse_formula("sin(θ)", symbols), sin(q[0])));
  BOOST_TEST(parse_formula("2*k", symbols).is_constant(5));
}

namespace {

// A formula in x, y, r[3] and what it means, with its gradient by (x, y, r[0], r[1], r[2]) where
// given.
struct Meaning {
  std::string text;
  std::function<double(double x, double y, const std::array<double, 3>& r)> value;
  std::function<std::array<double, 5>(double x, double y, const std::array<double, 3>& r)> gradient;
};

using Vector3 = std::array<double, 3>;
using Gradient = std::array<double, 5>;

const std::vector<Meaning> kMeanings{
    {"x^2*y - y^3/3 + 1/(1 + x^2)",
     [](double x, double y, const Vector3&) { return x * x * y - y * y * y / 3 + 1 / (1 + x * x); },
     [](double x, double y, const Vector3&) {
       const double d = 1 + x * x;
       return Gradient{2 * x * y - 2 * x / (d * d), x * x - y * y, 0, 0, 0};
     }},
    {"exp(-x^2)*sin(3*y) + atan2(y, 2 + x^2)",
     [](double x, double y, const Vector3&) {
       return std::exp(-(x * x)) * std::sin(3 * y) + std::atan2(y, 2 + x * x);
     },
     [](double x, double y, const Vector3&) {
       const double g = std::exp(-x * x), c = 2 + x * x, n = c * c + y * y;
       return Gradient{-2 * x * g * std::sin(3 * y) - 2 * x * y / n,
                       3 * g * std::cos(3 * y) + c / n, 0, 0, 0};
     }},
    {"-1/norm(r) + dot(r, r)*x",
     [](double x, double, const Vector3& r) {
       const double s = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
       return -1 / std::sqrt(s) + s * x;
     },
     [](double x, double, const Vector3& r) {
       const double s = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
       const double f = std::pow(s, -1.5) + 2 * x;
       return Gradient{s, 0, f * r[0], f * r[1], f * r[2]};
     }},
    {"sum(i, 0, 1, sum(j, i+1, 2, log((r[i] - r[j])^2 + 1)))",
     [](double, double, const Vector3& r) {
       double sum = 0;
       for (std::size_t i = 0; i < 2; ++i)
         for (std::size_t j = i + 1; j < 3; ++j) sum += std::log((r[i] - r[j]) * (r[i] - r[j]) + 1);
       return sum;
     },
     [](double, double, const Vector3& r) {
       Gradient gradient{};
       for (std::size_t i = 0; i < 3; ++i)
         for (std::size_t j = 0; j < 3; ++j)
           gradient[2 + i] += 2 * (r[i] - r[j]) / ((r[i] - r[j]) * (r[i] - r[j]) + 1);
       return gradient;
     }},
    {"cross(r, 2*r + x*r)[1] + if(x < y, x^3, y^3)",
     [](double x, double y, const Vector3&) { return x < y ? x * x * x : y * y * y; },
     [](double x, double y, const Vector3&) {
       return x < y ? Gradient{3 * x * x} : Gradient{0, 3 * y * y};
     }},
    {"prod(i, 0, 2, cosh(r[i])) - max(x, y, 0)",
     [](double x, double y, const Vector3& r) {
       return std::cosh(r[0]) * std::cosh(r[1]) * std::cosh(r[2]) - std::max({x, y, 0.0});
     },
     [](double x, double y, const Vector3& r) {
       const double p = std::cosh(r[0]) * std::cosh(r[1]) * std::cosh(r[2]);
       return Gradient{x > y && x > 0 ? -1.0 : 0.0, y > x && y > 0 ? -1.0 : 0.0,
                       p * std::tanh(r[0]), p * std::tanh(r[1]), p * std::tanh(r[2])};
     }},
};

}  // namespace

BOOST_AUTO_TEST_CASE(values_and_gradients_are_those_written_in_c) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-2, 2);
  for (const Meaning& meaning : kMeanings) {
    Graph graph;
    const ExprVector variables = graph.variables("z", 5);
    SymbolTable symbols;
    symbols.add("x", variables[0]);
    symbols.add("y", variables[1]);
    symbols.add("r", {3}, variables.tail(3));
    const Expr formula = parse_formula(meaning.text, symbols);
    ExprVector outputs(6);
    outputs << formula, gradient(formula, variables);
    const Function function("f", {{"z", variables}}, outputs);
    for (int trial = 0; trial < 50; ++trial) {
      const VectorXd z = VectorXd::NullaryExpr(5, [&] { return uniform(random); });
      const Vector3 r{z[2], z[3], z[4]};
      const VectorXd found = function({z});
      VectorXd expected(6);
      expected[0] = meaning.value(z[0], z[1], r);
      const Gradient expected_gradient = meaning.gradient(z[0], z[1], r);
      std::copy(expected_gradient.begin(), expected_gradient.end(), expected.begin() + 1);
      const double defect = (found - expected).norm();
      BOOST_TEST(defect <= 1e-13 * (1 + expected.norm()), meaning.text << ": defect " << defect);
    }
  }
}

BOOST_AUTO_TEST_CASE(long_sums) {
  Graph graph;
  SymbolTable symbols;
  const Index n = 100'000;
  const ExprVector q = graph.variables("q", n);
  symbols.add("q", {n}, q);
  symbols.add("n", static_cast<double>(n));
  const Function function(
      "f", {{"q", q}},
      ExprVector::Constant(1, parse_formula("sum(i, 0, n-2, (q[i+1] - q[i])^2)/2", symbols)));
  const VectorXd ramp = VectorXd::LinSpaced(n, 0, static_cast<double>(n - 1));
  BOOST_TEST(function({ramp})[0] == static_cast<double>(n - 1) / 2);
}

BOOST_AUTO_TEST_CASE(names_that_a_formula_needs) {
  const auto check_names = [](const std::string& text, const std::vector<std::string>& names) {
    BOOST_TEST(names_used(text) == names, boost::test_tools::per_element());
  };
  check_names("", {});
  check_names("2*pi + e - sin(1)", {});
  check_names("k*x^2 + x + t", {"k", "x", "t"});
  check_names("x' + r[i+1][x]' - r[0]", {"x'", "r'", "i", "x", "r"});
  check_names("sum(i, 0, n-1, q[i]*w) + i", {"n", "q", "w", "i"});
  check_names("sum(i, 0, n-1, prod(j, i, m, a[j])*i)*j", {"n", "m", "a", "j"});
  check_names("norm(r[2] - s)", {"r", "s"});
  check_names("x)) + ((sum(", {"x"});  // also of what is no formula
  BOOST_CHECK_THROW(names_used("x $ y"), FormulaError);
}

namespace {

// Whether it is a formula; anything but a FormulaError that points into the text fails the test.
bool is_formula(const std::string& text, const SymbolTable& symbols) {
  try {
    parse_formula(text, symbols);
    return true;
  } catch (const FormulaError& error) {
    const std::string start = "column " + std::to_string(error.column()) + ": ";
    BOOST_REQUIRE_MESSAGE(std::string(error.what()).starts_with(start), error.what());
    BOOST_REQUIRE_MESSAGE(error.column() >= 1 && error.column() <= text.size() + 1,
                          text << "\n"
                               << error.what());
    return false;
  }
}

std::string joined(std::mt19937& random, const std::vector<std::string>& words, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += words[random() % words.size()];
  return text;
}

}  // namespace

BOOST_AUTO_TEST_CASE(garbage_is_refused_and_nothing_worse) {
  const std::vector<std::string> words{
      "x",      "y", "a",    "b",   "r",    "n",    "i",      "j",     "e",          "q9",
      "1",      "2", ".5",   "1e9", "+",    "-",    "*",      "/",     "^",          "(",
      ")",      "[", "]",    ",",   "'",    "<",    "<=",     "==",    "!=",         "&&",
      "||",     "!", "sin(", "if(", "min(", "dot(", "cross(", "norm(", "sum(i,0,3,", "prod(j,1,2,",
      "atan2(", " ", "[0]",  "[i]", "a[1]", "r[i]", "x'",     "θ",     "$",          "="};
  const std::vector<std::string> formulas{
      "sum(i, 0, n-2, sum(j, i+1, n-1, dot(r[i], r[j])/norm(r[i] - r[j])))",
      "if(x > 0 && y < 1, a[0]^2, -b[n-2]) + x'", "-x^2*(y + 1e-3)/max(x, y, 2) + r[2][1]'*pi"};
  const SymbolTable symbols = constant_symbols();
  std::mt19937 random(5);
  int valid = 0, refused = 0;
  const auto count = [&](const std::string& text) {
    is_formula(text, symbols) ? ++valid : ++refused;
  };
  for (int trial = 0; trial < 20'000; ++trial) {
    std::string bytes(random() % 12, ' ');
    for (char& byte : bytes) byte = static_cast<char>(random() % 256);
    count(bytes);
    count(joined(random, words, random() % 15));
    std::string mutated = formulas[random() % formulas.size()];
    for (std::size_t edits = random() % 3 + 1; edits > 0; --edits) {
      const std::size_t at = random() % mutated.size();
      random() % 2 == 0 ? mutated.erase(at, 1) : mutated.insert(at, words[random() % words.size()]);
    }
    count(mutated);
  }
  BOOST_TEST(valid > 1000);  // so both ways out were taken
  BOOST_TEST(refused > 1000);
}

BOOST_AUTO_TEST_SUITE_END()
