#include "courant/core/language/formula_parser.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/core/language/formula.hpp"

// Mistakes that these cases have to notice:
//  * sums of a million terms with unknowns are read, and take minutes
BOOST_AUTO_TEST_SUITE(formula_parser_test)

using namespace courant;

namespace {

// q, x[4], a[3], r[20][3], n = 4, half = 0.5; velocities q', r'.
struct Symbols {
  Graph graph;
  SymbolTable table;

  Symbols() {
    table.add("q", graph.variable("q"));
    table.add("x", {4}, graph.variables("x", 4));
    table.add("a", {3}, graph.variables("a", 3));
    table.add("r", {20, 3}, graph.variables("r", 60));
    table.add("n", 4);
    table.add("half", 0.5);
    table.add("p_q", graph.variable("p_q"));
    table.add_velocity("q", graph.variable("q'"));
    table.add_velocity("r", {20, 3}, graph.variables("r'", 60));
    table.add_velocity("w", {2}, graph.variables("w", 2));
  }
};

void check_refused(const std::string& text, std::size_t column, const std::string& message) {
  Symbols symbols;
  BOOST_CHECK_EXCEPTION(
      parse_formula(text, symbols.table), FormulaError, [&](const FormulaError& error) {
        BOOST_TEST(error.what() == "column " + std::to_string(column) + ": " + message);
        BOOST_TEST(error.column() == column);
        return true;
      });
}

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

}  // namespace

BOOST_AUTO_TEST_CASE(unknown_names) {
  check_refused("n*q^2 + qq", 9, "unknown name \"qq\" (did you mean \"q\"?)");
  check_refused("t", 1, "unknown name \"t\"");
  check_refused("hlaf + Half", 1, "unknown name \"hlaf\" (did you mean \"half\"?)");
  check_refused("1 + sine(q)", 5, "unknown function \"sine\" (did you mean \"sin\"?)");
  check_refused("foo(q)", 1, "unknown function \"foo\"");
  check_refused("sum(kk, 0, 3, x[k])", 17, "unknown name \"k\" (did you mean \"kk\"?)");
  check_refused("sum(k, 0, k, 1)", 11, "unknown name \"k\"");  // not yet known in the bounds
  check_refused("sum(k, 0, 3, 1) + k", 19, "unknown name \"k\"");
  check_refused("θ + 1", 1, "unknown name \"θ\"");
  check_refused("n'", 1, "velocity n' is not available here");
  check_refused("2*p_q'", 3, "velocity p_q' is not available here");
  check_refused("x[1]'", 1, "velocity x' is not available here");
  check_refused("w[1]", 1, "w is not available here; expected its velocity w'");
}

BOOST_AUTO_TEST_CASE(what_was_expected) {
  check_refused("", 1, "expected a number, a name, \"-\" or \"(\", found end of formula");
  check_refused("q +", 4, "expected a number, a name, \"-\" or \"(\", found end of formula");
  check_refused("q + * 2", 5, "expected a number, a name, \"-\" or \"(\", found \"*\"");
  check_refused("()", 2, "expected a number, a name, \"-\" or \"(\", found \")\"");
  check_refused("(q+1", 5, "expected \")\", found end of formula");
  check_refused("(q+1]", 5, "expected \")\", found \"]\"");
  check_refused("q + 1)", 6, "expected end of formula, found \")\"");
  check_refused(
      "q''", 3,
      "formulas have no second derivatives; expected v' of an unknown v with the equation q' - v");
  check_refused("2q", 2, "expected an operator, found \"q\"");
  check_refused("(q + 1)(q - 1)", 8, "expected an operator, found \"(\"");
  check_refused("q(n + 1)", 2, "expected an operator after \"q\", found \"(\"");
  check_refused("sin(q n)", 7, "expected an operator, found \"n\"");
  check_refused("sin q", 5, "expected \"(\" after \"sin\", found \"q\"");
  check_refused("2*sin", 6, "expected \"(\" after \"sin\", found end of formula");
  check_refused("sin(q", 6, "expected \")\", found end of formula");
  check_refused("atan2(q", 8, "expected \",\", found end of formula");
  check_refused("min(q, n", 9, "expected \",\" or \")\", found end of formula");
  check_refused("sin(q,)", 7, "expected a number, a name, \"-\" or \"(\", found \")\"");
  check_refused("x[1", 4, "expected \"]\", found end of formula");
  check_refused("x[1, 2]", 4, "expected \"]\", found \",\"");
  check_refused("q, n", 2, "expected end of formula, found \",\"");
}

BOOST_AUTO_TEST_CASE(numbers_of_arguments) {
  check_refused("q + sin(q, 1)", 5, "\"sin\" takes 1 argument, found 2");
  check_refused("sin()", 1, "\"sin\" takes 1 argument, found 0");
  check_refused("atan2(q)", 1, "\"atan2\" takes 2 arguments, found 1");
  check_refused("min(q)", 1, "\"min\" takes at least 2 arguments, found 1");
  check_refused("dot(a)", 1, "\"dot\" takes 2 arguments, found 1");
  check_refused("if(q > 0, 1)", 12,
                "expected \",\", found \")\" in if(condition, then, otherwise)");
  check_refused("if(q > 0, 1, 2, 3)", 15,
                "expected \")\", found \",\" in if(condition, then, otherwise)");
  check_refused("sum(i, 0, 3)", 12, "expected \",\", found \")\" in sum(index, first, last, term)");
  check_refused("prod(i, 0, 3, i, 1)", 16,
                "expected \")\", found \",\" in prod(index, first, last, term)");
  check_refused("sum(0, 3, 1)", 5,
                "expected a name for the index, found \"0\" in sum(index, first, last, term)");
}

BOOST_AUTO_TEST_CASE(indices) {
  check_refused("x[4]", 3, "index 4 is out of range for x[4] (0 … 3)");
  check_refused("x[-1]", 3, "index -1 is out of range for x[4] (0 … 3)");
  check_refused("r[20][0]", 3, "index 20 is out of range for r[20][3] (0 … 19)");
  check_refused("r[19][n-1]", 7, "index 3 is out of range for r[20][3] (0 … 2)");
  check_refused("r[0][3]'", 6, "index 3 is out of range for r[20][3]' (0 … 2)");
  check_refused("cross(a, a)[3]", 13, "index 3 is out of range for array[3] (0 … 2)");
  check_refused("sum(i, 0, n-1, x[i+1])", 18,
                "index 4 is out of range for x[4] (0 … 3), where i = 3");
  check_refused("sum(i, 0, 1, sum(j, 0, i, r[i][3*j]))", 32,
                "index 3 is out of range for r[20][3] (0 … 2), where i = 1, j = 1");
  check_refused("x[half]", 3, "index of x is 0.5; expected an integer");
  check_refused("x[q]", 3, "index of x is q; expected a constant integer");
  check_refused("x[1e300]", 3, "index of x is 1e+300; expected an integer");
  check_refused("x[1/0]", 3, "index of x is inf; expected an integer");
  check_refused("sum(i, 0, 3, x[i/2])", 16, "index of x is 0.5; expected an integer, where i = 1");
  check_refused("x[1 < 2]", 3, "this is a condition; expected a number");
}

BOOST_AUTO_TEST_CASE(numbers_arrays_and_conditions) {
  check_refused("1 + n*x[0] - x", 14, "x is an array of 4; expected an element such as x[0]");
  check_refused("sin(x)", 5, "x is an array of 4; expected an element such as x[0]");
  check_refused("q + r[n]", 5, "r[n] is an array of 3; expected an element such as r[n][0]");
  check_refused("q + r[1]'", 5, "r[1]' is an array of 3; expected an element such as r[1][0]'");
  check_refused("r", 1, "r is an array of 20×3; expected an element such as r[0][0]");
  check_refused("dot(r', a)", 5, "r' is an array of 20×3; expected an element such as r[0][0]'");
  check_refused("x + 1", 1, "x is an array of 4; expected an element such as x[0]");
  check_refused("x*x", 3, "x is an array of 4; expected an element such as x[0]");
  check_refused("a^2", 1, "a is an array of 3; expected an element such as a[0]");
  check_refused("q + (a - 2*a)", 6, "this is an array of 3; expected a number");
  check_refused("q[0]", 3, "q takes 0 indices, found 1");
  check_refused("x[1][2]", 6, "x[4] takes 1 index, found 2");
  check_refused("r[1][2][0]", 1, "r[1][2] is a number; expected an array");
  check_refused("x + a", 3, "sum of an array of 4 and an array of 3; expected one size");
  check_refused("norm(a - x)", 8,
                "difference of an array of 3 and an array of 4; expected one size");
  check_refused("dot(a, x)", 1, "dot of an array of 3 and an array of 4; expected one size");
  check_refused("cross(a, x)[0]", 10, "x is an array of 4; expected an array of 3");
  check_refused("dot(a, q)", 8, "q is a number; expected an array");
  check_refused("norm(2)", 6, "this is a number; expected an array");
  check_refused("sum(i, 0, 2, a)", 14, "a is an array of 3; expected an element such as a[0]");
  check_refused("q < 1", 1, "this is a condition; expected a number");
  check_refused("1 + (q < 1)", 6, "this is a condition; expected a number");
  check_refused("if(q, 1, 2)", 4, "q is a number; expected a condition such as x > 0");
  check_refused("if(q < 1 && n, 1, 2)", 13, "n is a number; expected a condition such as x > 0");
  check_refused("if(!q < 1, 1, 2)", 5, "q is a number; expected a condition such as x > 0");
  check_refused("if(0 < q < 1, 1, 2)", 10, "comparisons do not chain; expected a < b && b < c");
  check_refused("if(1 > 0 || n, 1, 2)", 13, "n is a number; expected a condition such as x > 0");
}

BOOST_AUTO_TEST_CASE(loops) {
  check_refused("sum(q, 0, 3, 1)", 5,
                "\"q\" has a meaning already; expected a new name for the index of sum");
  check_refused("prod(e, 0, 3, 1)", 6,
                "\"e\" has a meaning already; expected a new name for the index of prod");
  check_refused("sum(w, 0, 3, 1)", 5,
                "\"w\" has a meaning already; expected a new name for the index of sum");
  check_refused("sum(min, 0, 3, 1)", 5,
                "\"min\" has a meaning already; expected a new name for the index of sum");
  check_refused("sum(i, 0, 1, sum(i, 0, 1, 1))", 18,
                "\"i\" has a meaning already; expected a new name for the index of sum");
  check_refused("sum(i, half, 3, 1)", 8, "bound of sum is 0.5; expected an integer");
  check_refused("sum(i, 0, q, 1)", 11, "bound of sum is q; expected a constant integer");
  check_refused("sum(i, 0, x, 1)", 11, "x is an array of 4; expected an element such as x[0]");
  check_refused("q + sum(i, 1, 10^7 + 1, i)", 5,
                "\"sum\" is too long; expected at most 1000000 terms in a formula");
  check_refused("sum(i, 1, 10^4, prod(j, 0, 10^15, i))", 17,
                "\"prod\" is too long; expected at most 1000000 terms in a formula");
  check_refused("q + sum(i, 1, 5*10^5 + 1, i*q)", 5,
                "\"sum\" is too long; expected at most 500000 terms with unknowns in a formula");
  check_refused("sum(i, 0, 3, i", 15,
                "expected \")\", found end of formula in sum(index, first, last, term)");
}

BOOST_AUTO_TEST_CASE(what_does_not_count_must_still_be_right) {
  check_refused("sum(i, 1, 0, qq)", 14, "unknown name \"qq\" (did you mean \"q\"?)");
  check_refused("sum(i, 1, 0, x)", 14, "x is an array of 4; expected an element such as x[0]");
  check_refused("if(1 > 0, 1, 2 3)", 16, "expected an operator, found \"3\"");
  check_refused("if(1 > 0, 1, sin(q, q))", 14, "\"sin\" takes 1 argument, found 2");
}

BOOST_AUTO_TEST_CASE(nesting_is_limited) {
  const std::string message = "nested too deep; expected at most 200 levels";
  Symbols symbols;
  BOOST_CHECK_NO_THROW(parse_formula(repeated("(", 199) + "q" + repeated(")", 199), symbols.table));
  check_refused(repeated("(", 200) + "q" + repeated(")", 200), 201, message);
  for (const std::string opening :
       {"(", "-", "!", "+", "2^", "sin(", "x[", "if(", "sum(i, 0, ", "min(1, "}) {
    BOOST_CHECK_EXCEPTION(
        parse_formula(repeated(opening, 50'000), symbols.table), FormulaError,
        [&](const FormulaError& error) { return std::string(error.what()).ends_with(message); });
  }
  // Long is not deep.
  BOOST_CHECK_NO_THROW(parse_formula("q" + repeated(" + q*q - 1", 50'000), symbols.table));
}

BOOST_AUTO_TEST_SUITE_END()
