#include "courant/extensions/spice/netlist_parameters.hpp"

#include <boost/test/unit_test.hpp>

// Mistakes that these cases have to notice:
//  * defaults of a subcircuit see the parameters outside before its own
//  * a parameter of an instance that mentions its own name is a circle
BOOST_AUTO_TEST_SUITE(netlist_parameters)

using namespace courant;
using namespace courant::netlist;

namespace {

struct Defined {
  NetlistCircuit circuit;
  LineProblems problems{"the netlist"};
  NetlistParameters parameters{circuit, problems};
  Scope scope;
};

}  // namespace

// Whatever the order in which they stand.
BOOST_AUTO_TEST_CASE(those_that_others_need_come_first) {
  Defined of;
  of.parameters.define(of.scope, "", {{"b", "2*a", 3}, {"c", "a + b", 4}, {"a", "5", 5}});
  BOOST_TEST(of.problems.empty());
  BOOST_TEST(of.circuit.value_of("c", 0) == 15.0);
  BOOST_TEST(of.circuit.parameters["a"] == Json(5.0));
  BOOST_TEST(of.circuit.parameters["b"] == Json("2*a"));
  BOOST_TEST(of.circuit.parameter_lines.at("b") == 3);
}

BOOST_AUTO_TEST_CASE(the_last_value_of_a_name_counts) {
  Defined of;
  of.parameters.define(of.scope, "", {{"a", "1", 2}, {"a", "7", 3}});
  BOOST_TEST(of.circuit.value_of(of.scope.at("a"), 0) == 7.0);
  BOOST_TEST(of.circuit.parameters.size() == 1u);
}

// In an instance a name hides that of the whole, which its own value may mention.
BOOST_AUTO_TEST_CASE(instances_have_names_of_their_own) {
  Defined of;
  of.parameters.define(of.scope, "", {{"r", "100", 2}});
  Scope inside = of.scope;
  of.parameters.define(inside, "x1.", {{"r", "2*r", 5}});
  BOOST_TEST(inside.at("r") != of.scope.at("r"));
  BOOST_TEST(of.circuit.value_of(inside.at("r"), 0) == 200.0);
  BOOST_TEST(of.circuit.value_of(of.scope.at("r"), 0) == 100.0);
  // What comes before it means the own one too.
  Scope other = of.scope;
  of.parameters.define(other, "x2.", {{"half", "r/2", 7}, {"r", "30", 8}});
  BOOST_TEST(of.circuit.value_of(other.at("half"), 0) == 15.0);
}

// e is a number in formulas, so a parameter of this name has another one.
BOOST_AUTO_TEST_CASE(names_of_formulas_are_left_to_them) {
  Defined of;
  of.parameters.define(of.scope, "", {{"e", "3", 2}});
  BOOST_TEST(of.scope.at("e") == "e_");
  BOOST_TEST(of.circuit.value_of("e_", 0) == 3.0);
}

// A circle is a problem of all that are in it, and of no other.
BOOST_AUTO_TEST_CASE(circles_are_problems) {
  Defined of;
  of.parameters.define(of.scope, "", {{"a", "b", 2}, {"b", "a", 3}, {"c", "4", 4}});
  BOOST_TEST(!of.problems.empty());
  try {
    of.problems.require_none();
    BOOST_ERROR("no problem");
  } catch (const ExperimentError& error) {
    BOOST_TEST(error.problems().size() == 2u);
    BOOST_TEST(error.problems()[0].where == "line 2");
    BOOST_TEST(error.problems()[1].where == "line 3");
  }
  BOOST_TEST(of.circuit.value_of(of.scope.at("c"), 0) == 4.0);
}

BOOST_AUTO_TEST_SUITE_END()
