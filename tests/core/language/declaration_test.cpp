#include "courant/core/language/declaration.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(declaration_test)

using namespace courant;

namespace {

template <class Parse>
void check_refused(Parse parse, const std::string& text, std::size_t column,
                   const std::string& message) {
  BOOST_CHECK_EXCEPTION(parse(text), FormulaError, [&](const FormulaError& error) {
    BOOST_TEST(error.what() == message);
    BOOST_TEST(error.column() == column);
    return true;
  });
}

SymbolTable known() {
  SymbolTable symbols;
  symbols.add("n", 4);
  symbols.add("length", 1.5);
  return symbols;
}

}  // namespace

BOOST_AUTO_TEST_CASE(declarations) {
  BOOST_TEST(parse_declaration("x").name == "x");
  BOOST_TEST(parse_declaration("x").shape.empty());
  BOOST_TEST((parse_declaration("r[4]").shape == Shape{4}));
  BOOST_TEST((parse_declaration(" r [20] [3] ").shape == Shape{20, 3}));
  BOOST_TEST((parse_declaration("r[n][n-1]", known()).shape == Shape{4, 3}));
  BOOST_TEST(parse_declaration("r[20][3]").size() == 60);
  BOOST_TEST(parse_declaration("θ_1").name == "θ_1");
}

BOOST_AUTO_TEST_CASE(element_names_are_references_in_row_major_order) {
  BOOST_TEST(parse_declaration("x").element_names() == std::vector<std::string>{"x"},
             boost::test_tools::per_element());
  const Declaration matrix = parse_declaration("R[2][3]");
  const std::vector<std::string> names = matrix.element_names();
  BOOST_TEST(names.size() == 6);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const Reference element = parse_reference(names[k]);
    BOOST_TEST(element.name == "R");
    BOOST_TEST_REQUIRE(element.indices.size() == 2);
    BOOST_TEST(element.indices[0] * 3 + element.indices[1] == static_cast<Index>(k));
  }
}

BOOST_AUTO_TEST_CASE(wrong_declarations) {
  const auto parse = [](const std::string& text) { return parse_declaration(text, known()); };
  check_refused(parse, "", 1, "column 1: expected a name, found end of declaration");
  check_refused(parse, "2x", 1, "column 1: expected a name, found \"2\"");
  check_refused(parse, "x'", 2, "column 2: expected end of declaration, found \"'\"");
  check_refused(parse, "x y", 3, "column 3: expected end of declaration, found \"y\"");
  check_refused(parse, "x.y", 2,
                "column 2: unexpected \".\"; expected a name of letters, digits and _");
  check_refused(parse, "r[4", 4, "column 4: expected \"]\", found end of declaration");
  check_refused(parse, "r[]", 3,
                "column 3: expected a number, a name, \"-\" or \"(\", found \"]\"");
  check_refused(parse, "r[0]", 3,
                "column 3: size of r is 0; expected at least 1, and at most 10000000 elements");
  check_refused(
      parse, "r[10][9999999]", 7,
      "column 7: size of r is 9999999; expected at least 1, and at most 10000000 elements");
  check_refused(parse, "r[2][2][2]", 8, "column 8: expected end of declaration, found \"[\"");
  check_refused(parse, "r[length]", 3, "column 3: size of r is 1.5; expected an integer");
  check_refused(parse, "r[m]", 3, "column 3: unknown name \"m\"");
  check_refused(parse, "e", 1,
                "column 1: \"e\" has a meaning already, Euler's number; expected a new name");
  check_refused(parse, "n[2]", 1, "column 1: \"n\" has a meaning already; expected a new name");
  check_refused(parse, "cos", 1,
                "column 1: \"cos\" has a meaning already, a function; expected a new name");
}

BOOST_AUTO_TEST_CASE(references) {
  const auto check = [](const std::string& text, const std::string& name,
                        const std::vector<Index>& indices, bool is_velocity) {
    const Reference reference = parse_reference(text);
    BOOST_TEST(reference.name == name);
    BOOST_TEST(reference.indices == indices, boost::test_tools::per_element());
    BOOST_TEST(reference.is_velocity == is_velocity);
  };
  check("x", "x", {}, false);
  check("x[0]", "x", {0}, false);
  check("r[3][2]", "r", {3, 2}, false);
  check("x'", "x", {}, true);
  check("r[2]'", "r", {2}, true);
  check("p_r[ 3 ][1]", "p_r", {3, 1}, false);
}

BOOST_AUTO_TEST_CASE(wrong_references) {
  check_refused(parse_reference, "", 1, "column 1: expected a name, found end of name");
  check_refused(parse_reference, "x[-1]", 3, "column 3: index of x is -1; expected at least 0");
  check_refused(parse_reference, "x[k]", 3, "column 3: unknown name \"k\"");
  check_refused(parse_reference, "x[0.5]", 3, "column 3: index of x is 0.5; expected an integer");
  check_refused(parse_reference, "x''", 3, "column 3: expected end of name, found \"'\"");
  check_refused(parse_reference, "x'[0]", 3, "column 3: expected end of name, found \"[\"");
  check_refused(parse_reference, "x+1", 2, "column 2: expected end of name, found \"+\"");
}

// r[1] is not named, and 0.
BOOST_AUTO_TEST_CASE(a_table_of_elements) {
  ExprVector values(4);
  values << 1.0, 2.0, 3.0, 4.0;
  const auto symbols = symbols_of_elements({"x", "r[0]", "r[2]", "x'"}, values);
  BOOST_REQUIRE(symbols.has_value());
  BOOST_TEST(symbols->find("x")->values[0].value() == 1.0);
  BOOST_TEST((symbols->find("r")->shape == Shape{3}));
  BOOST_TEST(symbols->find("r")->values[1].value() == 0.0);
  BOOST_TEST(symbols->find("r")->values[2].value() == 3.0);
  BOOST_TEST(symbols->find_velocity("x")->values[0].value() == 4.0);
  BOOST_TEST(!symbols_of_elements({"no name"}, ExprVector::Zero(1)).has_value());
}

BOOST_AUTO_TEST_SUITE_END()
