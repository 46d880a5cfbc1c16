#include "courant/core/language/formula_tree.hpp"

#include <boost/test/unit_test.hpp>
#include <string>

BOOST_AUTO_TEST_SUITE(formula_tree_test)

using namespace courant;
using Kind = FormulaTree::Kind;

namespace {

// (+ 1 (* 2 x)): each operand with its own.
std::string written(const FormulaTree& tree) {
  std::string text = tree.kind == Kind::element ? "[]" : tree.text;
  if (tree.operands.empty()) return text;
  for (const FormulaTree& operand : tree.operands) text += " " + written(operand);
  return "(" + text + ")";
}

std::string read(const std::string& text) {
  const auto tree = formula_tree(text);
  return tree ? written(*tree) : "none";
}

}  // namespace

BOOST_AUTO_TEST_CASE(keeps_what_was_written) {
  BOOST_TEST(read("1 + 2*x") == "(+ 1 (* 2 x))");
  BOOST_TEST(read("1 - 2 - x") == "(- (- 1 2) x)");
  BOOST_TEST(read("(1 - 2)*x/y") == "(/ (* (- 1 2) x) y)");
  BOOST_TEST(read("0.50") == "0.50");
  BOOST_TEST(read("a < b && !c || d >= 2") == "(|| (&& (< a b) (! c)) (>= d 2))");
}

BOOST_AUTO_TEST_CASE(powers_bind_to_the_right_and_before_signs) {
  BOOST_TEST(read("-x^2") == "(- (^ x 2))");
  BOOST_TEST(read("2^-1") == "(^ 2 (- 1))");
  BOOST_TEST(read("a^b^c") == "(^ a (^ b c))");
  BOOST_TEST(read("-a*b") == "(* (- a) b)");
  BOOST_TEST(read("a^-b^2") == "(^ a (- (^ b 2)))");
}

BOOST_AUTO_TEST_CASE(reads_velocities_elements_and_calls) {
  BOOST_TEST(read("r[2]'") == "([] r' 2)");
  BOOST_TEST(read("r[i+1][0]") == "([] ([] r (+ i 1)) 0)");
  BOOST_TEST(read("x''") == "x''");
  BOOST_TEST(read("sum(i, 0, n-1, cos(q[i]))") == "(sum i 0 (- n 1) (cos ([] q i)))");
}

BOOST_AUTO_TEST_CASE(reads_equations) {
  BOOST_TEST(read("x' = v + 1") == "(= x' (+ v 1))");
  BOOST_TEST(read("a == b") == "(== a b)");
  BOOST_TEST(read("a <= b") == "(<= a b)");
}

BOOST_AUTO_TEST_CASE(says_nothing_of_what_is_no_formula) {
  for (const char* text :
       {"", "x +", "x y", "f(", "(x", "x)", "2'", "x = y = z", "= 1", "a # b", "… and 3 more"})
    BOOST_TEST(read(text) == "none", text);
  BOOST_TEST(read(std::string(90, '(') + "x" + std::string(90, ')')) == "x");
  BOOST_TEST(read(std::string(5000, '(') + "x" + std::string(5000, ')')) == "none");
  BOOST_TEST(read(std::string(5000, '-') + "x") == "none");
}

BOOST_AUTO_TEST_SUITE_END()
