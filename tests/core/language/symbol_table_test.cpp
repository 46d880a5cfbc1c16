#include "courant/core/language/symbol_table.hpp"

#include <boost/test/unit_test.hpp>
#include <numbers>
#include <stdexcept>

BOOST_AUTO_TEST_SUITE(symbol_table_test)

using namespace courant;

namespace {

bool same_node(const Expr& a, const Expr& b) {
  return !a.is_constant() && a.graph() == b.graph() && a.node() == b.node();
}

void check_refused(const std::string& name, const Shape& shape, Index values,
                   const std::string& message) {
  SymbolTable symbols;
  symbols.add("q", 1.0);
  BOOST_CHECK_EXCEPTION(symbols.add(name, shape, ExprVector::Zero(values)), std::invalid_argument,
                        [&](const std::invalid_argument& error) {
                          BOOST_TEST(error.what() == "SymbolTable::add: " + message);
                          return true;
                        });
}

}  // namespace

BOOST_AUTO_TEST_CASE(keeps_numbers_arrays_and_velocities_apart) {
  Graph graph;
  SymbolTable symbols;
  const ExprVector r = graph.variables("r", 6);
  symbols.add("r", {2, 3}, r);
  symbols.add_velocity("r", {3}, r.head(3));
  symbols.add("k", 4);

  BOOST_TEST((symbols.find("r")->shape == Shape{2, 3}));
  BOOST_TEST(same_node(symbols.find("r")->values[5], r[5]));
  BOOST_TEST((symbols.find_velocity("r")->shape == Shape{3}));
  BOOST_TEST(symbols.find("k")->values[0].value() == 4.0);
  BOOST_TEST(symbols.find("k")->shape.empty());
  BOOST_TEST(symbols.find_velocity("k") == nullptr);
  BOOST_TEST(symbols.find("z") == nullptr);
  BOOST_TEST(symbols.find("pi")->values[0].value() == std::numbers::pi);
  BOOST_TEST(symbols.find("e")->values[0].value() == std::numbers::e);
  BOOST_TEST(symbols.names() == (std::vector<std::string>{"e", "k", "pi", "r"}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(counts_elements) {
  BOOST_TEST(element_count({}) == 1);
  BOOST_TEST(element_count({4}) == 4);
  BOOST_TEST(element_count({20, 3}) == 60);
}

BOOST_AUTO_TEST_CASE(refuses_what_a_formula_could_not_mean) {
  check_refused("2x", {}, 1,
                "\"2x\" is not a name; expected letters, digits and _, a letter first.");
  check_refused("", {}, 1, "\"\" is not a name; expected letters, digits and _, a letter first.");
  check_refused("a b", {}, 1,
                "\"a b\" is not a name; expected letters, digits and _, a letter first.");
  check_refused("sin", {}, 1, "\"sin\" is the name of a function; expected another.");
  check_refused("sum", {}, 1, "\"sum\" is the name of a function; expected another.");
  check_refused("pi", {}, 1, "\"pi\" is already there.");
  check_refused("q", {}, 1, "\"q\" is already there.");
  check_refused("r", {4}, 3, "\"r\" has 3 values; expected 4.");
  check_refused("r", {0}, 0,
                "the shape of \"r\" is wrong; expected at most 2 extents, each at least 1.");
  check_refused("r", {2, 2, 2}, 8,
                "the shape of \"r\" is wrong; expected at most 2 extents, each at least 1.");
}

BOOST_AUTO_TEST_CASE(a_velocity_does_not_take_the_name) {
  SymbolTable symbols;
  symbols.add_velocity("x", 1.0);
  BOOST_CHECK_NO_THROW(symbols.add("x", 2.0));
  BOOST_CHECK_THROW(symbols.add_velocity("x", 1.0), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
