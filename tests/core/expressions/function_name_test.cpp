#include "courant/core/expressions/function_name.hpp"

#include <boost/test/unit_test.hpp>
#include <string>

#include "courant/core/expressions/expr.hpp"
#include "courant/core/language/formula.hpp"
#include "courant/core/language/formula_functions.hpp"

// Mistakes that these cases have to notice:
//  * the sine is called cos (core/expressions/function_name.cpp)
BOOST_AUTO_TEST_SUITE(function_name_test)

using namespace courant;

BOOST_AUTO_TEST_CASE(the_language_reads_a_name_as_its_operation) {
  Graph graph;
  SymbolTable symbols;
  Expr operand[3];
  const std::string names[] = {"a", "b", "c"};
  for (int i = 0; i < 3; ++i) symbols.add(names[i], operand[i] = graph.variable(names[i]));
  int read = 0;
  for (std::size_t i = 0; i < kOpCount; ++i) {
    const Op op = static_cast<Op>(i);
    const char* const name = function_name(op);
    if (name == nullptr || formula::find_function(name) == nullptr || op == Op::select) continue;
    std::string text = std::string(name) + "(a";
    for (int k = 1; k < arity(op); ++k) text += ", " + names[k];
    const Expr value = parse_formula(text + ")", symbols);
    BOOST_TEST_CONTEXT(text) { BOOST_TEST((graph.node(value.node()).op == op)); }
    ++read;
  }
  BOOST_TEST(read == 17);
}

BOOST_AUTO_TEST_CASE(what_is_written_by_a_sign_has_no_name) {
  for (const Op op : {Op::constant, Op::variable, Op::negate, Op::add, Op::multiply, Op::power,
                      Op::pow, Op::less, Op::logical_not})
    BOOST_TEST(function_name(op) == nullptr);
  BOOST_TEST(function_name(Op::select) == std::string("if"));
  BOOST_TEST(function_name(Op::stumpff) == std::string("stumpff"));
}

BOOST_AUTO_TEST_SUITE_END()
