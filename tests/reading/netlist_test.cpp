#include "courant/reading/netlist.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/core/formula.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/reading/netlist_sources.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(netlist_test)

namespace {

using Words = std::vector<std::string>;

double at(const std::string& formula, double t) {
  SymbolTable symbols;
  symbols.add("t", t);
  return parse_formula(formula, symbols).value();
}

double source_at(const Words& words, double t) {
  return at(netlist::source(words, {}, {0.01, 10.0}, 1), t);
}

void refused(const std::string& body, const std::string& expected) {
  std::string found;
  try {
    import_netlist("A title\n" + body + "\n.tran 1u 1m\n");
  } catch (const ExperimentError& error) {
    found = error.what();
  }
  BOOST_TEST(found == expected);
}

}  // namespace

BOOST_AUTO_TEST_CASE(numbers_with_units) {
  const auto is = [](const char* word, double value) {
    const auto found = netlist::number(word);
    BOOST_REQUIRE(found.has_value());
    BOOST_TEST(std::abs(*found - value) <= 1e-15 * std::abs(value), word << ": " << *found);
  };
  is("4.7k", 4700.0);
  is("10uF", 1e-5);
  is("1meg", 1e6);
  is("1MEGohm", 1e6);
  is("3m", 3e-3);
  is("2p", 2e-12);
  is("1e-3", 1e-3);
  is("-.5n", -5e-10);
  is("5V", 5.0);
  BOOST_TEST(!netlist::number("r1").has_value());
  BOOST_TEST(!netlist::number("1k+2").has_value());
  BOOST_TEST(netlist::formula("{2k*rx**2}", {{"rx", "x1_rx"}}, 1) == "(2000*x1_rx^2)");
}

BOOST_AUTO_TEST_CASE(waveforms) {
  // 1 → 3 after 2, rise 1, width 2, fall 1, period 5.
  const Words pulse = {"pulse", "1", "3", "2", "1", "1", "2", "5"};
  for (const double period : {0.0, 5.0}) {
    for (const auto& [t, value] :
         {std::pair(0.5, 1.0), {2.25, 1.5}, {4.0, 3.0}, {5.5, 2.0}, {6.5, 1.0}})
      BOOST_TEST(std::abs(source_at(pulse, t + (t > 2.0 ? period : 0.0)) - value) < 1e-12);
  }
  BOOST_TEST(std::abs(source_at({"sin", "1", "2", "3", "0.5", "0.1", "30"}, 1.2) -
                      (1.0 + 2.0 * std::exp(-0.07) *
                                 std::sin(2.0 * M_PI * 3.0 * 0.7 + M_PI / 6.0))) < 1e-12);
  BOOST_TEST(std::abs(source_at({"sin", "1", "2", "3", "0.5", "0.1", "30"}, 0.2) - 2.0) < 1e-12);
  const Words line = {"pwl", "0", "1", "1", "3", "2", "-1"};
  for (const auto& [t, value] :
       {std::pair(0.0, 1.0), {0.5, 2.0}, {1.0, 3.0}, {1.75, 0.0}, {9.0, -1.0}})
    BOOST_TEST(std::abs(source_at(line, t) - value) < 1e-12);
  const Words rise = {"exp", "1", "3", "1", "2", "4", "0.5"};
  BOOST_TEST(source_at(rise, 0.5) == 1.0);
  BOOST_TEST(std::abs(source_at(rise, 3.0) - (3.0 - 2.0 * std::exp(-1.0))) < 1e-12);
  BOOST_TEST(std::abs(source_at(rise, 5.0) - 1.0) < 1e-12);
  BOOST_TEST(source_at({"dc", "5", "ac", "1", "90"}, 3.0) == 5.0);
}

BOOST_AUTO_TEST_CASE(what_is_wrong_is_told_by_line) {
  refused("R1 a 0", "line 2: has no value; expected one");
  refused("V1 a 0 1\nQ1 a b c npn",
          "line 3: the element Q1 is not supported; expected R, L, C, V, "
          "I, K, D, E, F, G, H or X");
  refused("R1 a 0 {r}", "line 2: unknown parameter \"r\"");
  refused("D1 a 0 missing", "line 2: unknown model \"missing\"");
  refused(".model q npn", "line 2: models of the type npn are not supported; expected D");
  refused("* comment\nR1 a 0\n+ 1k\nF1 a 0 V9 2",
          "line 5: needs the element v9, which does not stand before it");
  refused("X1 a 0 part", "line 2: unknown subcircuit \"part\"");
  refused(".ac dec 10 1 1k", "line 2: .ac is not supported");
  refused("V1 a 0 sffm(0 1 1k)\nR1 a 0",
          "line 2: the waveform sffm is not supported; expected PULSE, SIN, PWL or EXP\n"
          "line 3: has no value; expected one");
}

BOOST_AUTO_TEST_CASE(subcircuits_and_parameters) {
  const Json found = import_netlist(
      "Two stages\n"
      ".param r=2k tau={r*c} c=1n\n"
      ".subckt stage in out params: k=1\n"
      "R1 in m {k*r}\n"
      "C1 m 0 {c}\n"
      "E1 out 0 m 0 2\n"
      ".ends\n"
      "V1 a 0 1\n"
      "X1 a b stage\n"
      "X2 b c stage k=3\n"
      ".tran 1u 10u uic\n");
  const Json& system = found.at("system");
  BOOST_TEST(system.at("nodes") == Json({"0", "a", "b", "x1_m", "c", "x2_m"}));
  BOOST_TEST(system.at("elements").size() == 7u);
  const Json& second = system.at("elements")[4];
  BOOST_TEST(second.at("name") == "x2_R1");
  BOOST_TEST(second.at("from") == "b");
  BOOST_TEST(second.at("value") == "(x2_k*r)");
  BOOST_TEST(system.at("elements")[3].at("value") == "2*potential_x1_m");
  BOOST_TEST(found.at("initial") == Json({{"q_x1_C1", 0}, {"q_x2_C1", 0}}));
  const Experiment experiment = read_experiment(found.dump());
  BOOST_TEST(experiment.model.vocabulary.parameters.size() == 5u);
  BOOST_TEST(experiment.time->steps == 10);
}

// With sources that are on at the start, charges and fluxes are those of the operating point.
BOOST_AUTO_TEST_CASE(operating_points) {
  const std::string circuit = "R1 a b 1k\nC1 b 0 1n\nL1 b c 1u\nR2 c 0 1k\n.tran 1u 10u\n";
  BOOST_TEST(import_netlist("t\nV1 a 0 5\n" + circuit).at("initial") ==
             Json({{"q_C1'", 0}, {"phi_L1'", 0}}));
  BOOST_TEST(import_netlist("t\nV1 a 0 sin(0 1 1k)\n" + circuit).at("initial") ==
             Json({{"q_C1", 0}, {"phi_L1", 0}}));
  BOOST_TEST(import_netlist("t\nV1 a 0 5\n.ic v(b)=2\n" + circuit).at("initial") ==
             Json({{"q_C1", "1e-09*2"}, {"phi_L1'", 0}}));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
