#include "courant/reading/network_branches.hpp"

#include <boost/test/unit_test.hpp>

namespace courant {
// Mistakes that these cases have to notice:
//  * temperatures are looked for at 0 K
BOOST_AUTO_TEST_SUITE(network_branches_test)

namespace {

using Kind = NetworkBranch::Kind;
using Role = NetworkBranch::Role;

const NetworkNodes nodes = {.names = {"0", "a", "b"},
                            .pointers = {"/nodes/0", "/nodes/1", "/nodes/2"},
                            .index = {{"0", 0}, {"a", 1}, {"b", 2}}};

const elements::Domain nameless{"nameless", "through_", "", "node_"};

NetworkElement element(const std::string& name, Kind kind, Role role,
                       const elements::Domain& domain = elements::domains::electrical,
                       const std::string& letters = "") {
  return {.type = "",
          .name = name,
          .pointer = "/" + name,
          .element =
              {.branches = {{.domain = &domain, .kind = kind, .role = role, .letters = letters}}},
          .terminals = {{"a", ""}, {"b", ""}}};
}

struct Assembled {
  explicit Assembled(const std::vector<NetworkElement>& elements)
      : of(nodes, elements, words, findings) {}

  NetworkWords words;
  Findings findings;
  NetworkBranches of;
};

}  // namespace

BOOST_AUTO_TEST_CASE(every_port_of_an_element_is_a_branch) {
  const NetworkElement capacitor =
      element("C1", Kind::charge, Role::storage, elements::domains::electrical, "q_");
  const NetworkElement resistor = element("R1", Kind::current, Role::resistor);
  const Assembled assembled({capacitor, resistor});
  BOOST_TEST(assembled.of.right);
  BOOST_TEST_REQUIRE(assembled.of.assembly.branches().size() == 2u);
  BOOST_TEST(assembled.of.of_elements == 2u);
  const NetworkBranch& first = assembled.of.assembly.branches()[0];
  BOOST_TEST(first.state_name == "q_C1");
  BOOST_TEST(first.current_name == "i_C1");
  BOOST_TEST(first.voltage_name == "v_C1");
  BOOST_TEST(first.from == 1);
  BOOST_TEST(first.to == 2);
  const auto& places = assembled.of.assembly.places();
  BOOST_TEST(places[1].first_branch == 1);
  BOOST_TEST(places[0].states == std::vector<Index>{0}, boost::test_tools::per_element());
  BOOST_TEST(places[1].states.empty());
  const NetworkWords& words = assembled.words;
  BOOST_TEST(words.vocabulary.coordinates.element_names() == std::vector<std::string>{"q_C1"},
             boost::test_tools::per_element());
  BOOST_TEST(words.vocabulary.unknowns.element_names() == std::vector<std::string>{"i_R1"},
             boost::test_tools::per_element());
  BOOST_TEST(words.currents.at("i_R1") == 1);
  BOOST_TEST(words.voltages.at("v_C1") == 0);
}

BOOST_AUTO_TEST_CASE(ports_of_the_network_have_inputs_and_outputs) {
  const Assembled assembled({element("P", Kind::current, Role::port)});
  BOOST_TEST(assembled.of.outputs.element_names() == std::vector<std::string>{"y_P"},
             boost::test_tools::per_element());
  BOOST_TEST(assembled.words.vocabulary.unknowns.element_names() ==
                 (std::vector<std::string>{"i_P", "u_P"}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(temperatures_are_looked_for_at_room_temperature) {
  const Assembled thermal(
      {element("G", Kind::voltage, Role::resistor, elements::domains::thermal)});
  BOOST_TEST(thermal.of.assembly.branches()[0].guess == 300.0);
  const Assembled electrical({element("G", Kind::voltage, Role::resistor)});
  BOOST_TEST(electrical.of.assembly.branches()[0].guess == 0.0);
}

// Once, however often it is used.
BOOST_AUTO_TEST_CASE(potentials_that_laws_use_are_measured) {
  NetworkElement source = element("V1", Kind::current, Role::source);
  source.formulas = {{"2*potential_b", "/V1/value"}, {"potential_b + i_V1", "/V1/other"}};
  const Assembled assembled({source});
  BOOST_TEST_REQUIRE(assembled.of.assembly.branches().size() == 2u);
  BOOST_TEST(assembled.of.of_elements == 1u);
  const NetworkBranch& meter = assembled.of.assembly.branches()[1];
  BOOST_TEST(meter.name == "potential_b");
  BOOST_TEST(meter.from == 2);
  BOOST_TEST(meter.to == 0);
  BOOST_TEST((meter.role == Role::coupler));
  BOOST_TEST(assembled.words.voltages.at("potential_b") == 1);
}

BOOST_AUTO_TEST_CASE(names_with_a_meaning_and_formulas_without_one_are_problems) {
  // The voltage of the one has the name of the velocity of the other.
  const Assembled twice({element("A", Kind::current, Role::resistor),
                         element("v_A", Kind::voltage, Role::resistor, nameless)});
  BOOST_TEST(!twice.of.right);
  BOOST_TEST_REQUIRE(!twice.findings.clean());
  BOOST_TEST(twice.findings.problems()[0].where == "/v_A");
  BOOST_TEST(twice.findings.problems()[0].what.starts_with(
      "needs the name \"v_A\", which has a meaning already"));
  NetworkElement source = element("V1", Kind::current, Role::source);
  source.formulas = {{"2 # i_V1", "/V1/value"}};
  const Assembled wrong({source});
  BOOST_TEST(!wrong.of.right);
  BOOST_TEST_REQUIRE(!wrong.findings.clean());
  BOOST_TEST(wrong.findings.problems()[0].where == "/V1/value");
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
