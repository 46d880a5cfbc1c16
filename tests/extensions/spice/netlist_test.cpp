#include "courant/extensions/spice/netlist.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/core/language/formula.hpp"
#include "courant/extensions/spice/netlist_behaviour.hpp"
#include "courant/extensions/spice/netlist_sources.hpp"
#include "courant/reading/experiment.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * a state that has decayed to the least numbers is to be followed by a curve
//    (integrators/step/step_solver.cpp)
//  * a start with a current through a diode is looked for without limits on its exponential
//    (integrators/certificate/consistent_point.cpp)
//  * netlists with diodes are integrated by the midpoint rule
//  * potentials of .ic are no initial voltages of capacitors
//  * a corner of a pulse stands for the first period alone (extensions/spice/netlist_sources.cpp)
//  * AC behind a waveform is a value of it (extensions/spice/netlist_sources.cpp)
//  * names that look alike are one (extensions/importing/different_names.cpp)
//  * an error that changes its sign after the edge of a pulse is taken for none of the method
//    (running/energy_watch.cpp)
//  * a change of H that ports account for is a finding (running/energy_watch.cpp)
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
  BOOST_TEST(*netlist::number("100n") == 1e-7);
  BOOST_TEST(*netlist::number("2e2n") == 2e2 * 1e-9);
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
  BOOST_TEST(source_at({"dc", "=", "5", "ac", "=", "1"}, 3.0) == 5.0);
  BOOST_TEST(std::abs(source_at({"sffm", "1", "2", "5", "0.3", "0.7"}, 1.3) -
                      (1.0 + 2.0 * std::sin(2.0 * M_PI * 5.0 * 1.3 +
                                            0.3 * std::sin(2.0 * M_PI * 0.7 * 1.3)))) < 1e-12);
  const Words am = {"am", "2", "0.5", "0.3", "4", "1"};
  BOOST_TEST(source_at(am, 0.9) == 0.0);
  BOOST_TEST(std::abs(source_at(am, 1.7) - 2.0 * (0.5 + std::sin(2.0 * M_PI * 0.3 * 0.7)) *
                                               std::sin(2.0 * M_PI * 4.0 * 0.7)) < 1e-12);
  // Names of Gnucap, shortened too.
  BOOST_TEST(std::abs(source_at({"sin", "ampl", "=", "2", "freq", "=", "3"}, 1.2) -
                      2.0 * std::sin(2.0 * M_PI * 3.0 * 1.2)) < 1e-12);
  BOOST_TEST(std::abs(source_at({"pulse", "iv", "=", "1", "pv", "=", "3", "delay", "=", "2", "rise",
                                 "=", "1", "width", "=", "2", "period", "=", "50"},
                                2.25) -
                      1.5) < 1e-12);
  // A period of 3 in which it rises at 1.
  const Words again = {"exp", "iv",  "=",   "0", "pv", "=",    "1", "td1", "=",      "1", "tau1",
                       "=",   "0.5", "td2", "=", "9",  "tau2", "=", "1",   "period", "=", "3"};
  for (const double t : {0.5, 3.5, 6.5}) BOOST_TEST(source_at(again, t) == 0.0);
  for (const double t : {2.0, 5.0, 8.0})
    BOOST_TEST(std::abs(source_at(again, t) - (1.0 - std::exp(-2.0))) < 1e-12);
  BOOST_CHECK_THROW(source_at({"sin", "colour", "=", "2"}, 1.2), LineError);
  BOOST_CHECK_THROW(source_at({"pulse", "iv", "=", "1"}, 1.2), LineError);
}

BOOST_AUTO_TEST_CASE(expressions_of_constants) {
  const auto value = [](const std::string& text) { return at(netlist::formula(text, {}, 1), 0.0); };
  BOOST_TEST(value("{1 < 2 ? 3 : 4}") == 3.0);
  BOOST_TEST(std::abs(value("{asinh(2) + log10(1000) - atanh(0.5)}") -
                      (std::asinh(2.0) + 3.0 - std::atanh(0.5))) < 1e-14);
  BOOST_TEST(value("{max(1, 4, 2) + min(3)}") == 7.0);
  BOOST_TEST(value("{temper}") == 27.0);
  BOOST_CHECK_THROW(value("{v(a)}"), LineError);
}

// Comments of all dialects, and a netlist whose commands have quotes of their own.
BOOST_AUTO_TEST_CASE(comments_and_commands) {
  std::vector<Problem> notes;
  const Json found = import_netlist(
      "t\n# one\n* two\nV1 a 0 DC=2 ; three\nR1 a b 1k // four\nC1 b 0 \"2*0.5u\" $ five\n"
      ".control\necho don't\n.endc\n.ac dec 1 1 10\n.end\n\x1a",
      &notes);
  BOOST_TEST(found.at("system").at("elements").size() == 3u);
  BOOST_TEST(found.at("system").at("elements")[2].at("value") == "(2*5e-07)");
  BOOST_TEST(found.at("time").at("end") == 1e-3);
  BOOST_TEST_REQUIRE(notes.size() == 2u);
  BOOST_TEST(notes[1].what.starts_with("no .tran says how long to go on: the experiment ends at"));
}

// Steps end where sources bend, once or in each period; corners of several sources, and those after the end, are not told again.
BOOST_AUTO_TEST_CASE(corners_of_waveforms) {
  const Json time = import_netlist(R"(Corners
V1 a 0 PULSE(0 1 1u 2u 3u 4u 20u)
V2 b a PULSE(0 1 1u 2u 3u 4u 20u)
V3 c b PWL(0 0 5u 1 2m 0)
V4 d c SIN(0 1 1k 7u)
V5 e d PULSE(0 1 8u 1u 1u)
R1 e 0 1k
.tran 1u 1m
.end
)")["time"];
  const auto periodic = [](double first) { return Json({{"first", first}, {"period", 2e-5}}); };
  const Json expected = {periodic(1e-6), periodic(3e-6), periodic(7e-6), periodic(1e-5),
                         5e-6,           7e-6,           8e-6,           9e-6};
  BOOST_TEST_REQUIRE(time["corners"].size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto number = [&](const Json& corner, const char* key) {
      return corner.is_object() ? corner[key].get<double>()
                                : (std::string(key) == "first" ? corner.get<double>() : 0.0);
    };
    for (const char* key : {"first", "period"})
      BOOST_TEST(std::abs(number(time["corners"][i], key) - number(expected[i], key)) < 1e-18);
  }
  BOOST_TEST(!time.contains("halvings"));
  BOOST_TEST(!import_netlist("A\nV1 a 0 SIN(0 1 1k)\nR1 a 0 1\n.tran 1u 1m\n")["time"].contains(
      "corners"));
}

// The midpoint rule keeps the energy of a lossless circuit; with diodes what is stiff has to die out.
BOOST_AUTO_TEST_CASE(methods_of_netlists) {
  const std::string body = "A\nV1 a 0 SIN(0 1 1k)\nL1 a b 1m\nC1 b 0 1u IC=0\n";
  const Json lossless = import_netlist(body + ".tran 1u 1m\n");
  BOOST_TEST(!lossless["method"].contains("damping"));
  const Json diode = import_netlist(body + "D1 b 0 dm\n.model dm D\n.tran 1u 1m\n");
  BOOST_TEST(lossless["method"]["type"] == "constrain-first");
  BOOST_TEST(diode["method"]["type"] == "discretize-first");
  BOOST_TEST(diode["method"]["damping"] == "l-stable");
  BOOST_TEST(diode["time"]["halvings"] == 10);
  BOOST_CHECK_NO_THROW(read_experiment(diode.dump()));
}

BOOST_AUTO_TEST_CASE(what_is_wrong_is_told_by_line) {
  refused("R1 a 0", "line 2: has no value; expected one");
  refused("V1 a 0 1\nJ1 a b c npn",
          "line 3: the element J1 is not supported; expected R, L, C, V, "
          "I, K, D, E, F, G, H, B, S, W, Q, M or X");
  refused("R1 a 0 {r}", "line 2: unknown parameter \"r\"");
  refused("D1 a 0 missing", "line 2: unknown model \"missing\"");
  refused("R1 a 0 4R7", "line 2: unknown model \"4r7\", and no number; expected 4.7");
  refused("R1 a 0 4K7", "line 2: unknown model \"4k7\", and no number; expected 4.7k");
  refused("R1 a 0 1M5",
          "line 2: unknown model \"1m5\", and no number; expected 1.5m for 10⁻³ or 1.5meg for 10⁶");
  refused("D1 a 0 q\n.model q npn", "line 2: the model q is of the type npn; expected d");
  refused("* comment\nR1 a 0\n+ 1k\nF1 a 0 V9 2",
          "line 5: needs the voltage source v9, which is not there");
  refused("X1 a 0 part", "line 2: unknown subcircuit \"part\"");
  refused(".laplace", "line 2: .laplace is not supported");
  refused(
      "V1 a 0 trnoise(0 1 1k)\nR1 a 0",
      "line 2: the waveform trnoise is not supported; expected PULSE, SIN, PWL, EXP, SFFM or AM\n"
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
  BOOST_TEST(experiment.model.vocabulary.parameters.size() == 4u);  // tau is used by nothing
  BOOST_TEST(experiment.time->steps == 10);
}

// With sources that are on at the start, charges and fluxes are those of the operating point.
BOOST_AUTO_TEST_CASE(operating_points) {
  const std::string circuit = "R1 a b 1k\nC1 b 0 1n\nL1 b c 1u\nR2 c 0 1k\n.tran 1u 10u\n";
  const auto is_near = [](const Json& value, double expected) {
    return std::abs(value.get<double>() - expected) <= 1e-12 * std::abs(expected);
  };
  const Json on = import_netlist("t\nV1 a 0 5\n" + circuit).at("initial");
  BOOST_TEST(on.size() == 2u);
  BOOST_TEST(is_near(on.at("q_C1"), 2.5e-9));
  BOOST_TEST(is_near(on.at("phi_L1"), 2.5e-9));
  BOOST_TEST(import_netlist("t\nV1 a 0 sin(0 1 1k)\n" + circuit).at("initial") ==
             Json({{"q_C1", 0}, {"phi_L1", 0}}));
  const Json held = import_netlist("t\nV1 a 0 5\n.ic v(b)=2\n" + circuit).at("initial");
  BOOST_TEST(is_near(held.at("q_C1"), 2e-9));
  BOOST_TEST(is_near(held.at("phi_L1"), 2e-9));
}

// .nodeset is where an operating point is looked for first, not where it is.
BOOST_AUTO_TEST_CASE(guessed_potentials) {
  const std::string circuit = "V1 a 0 5\nR1 a b 1k\nC1 b 0 1n\nD1 b 0 dm\n.model dm D\n";
  const auto charge = [&](const std::string& guess, const char* times = ".tran 1u 10u\n") {
    std::vector<Problem> notes;
    const Json found = import_netlist("t\n" + circuit + guess + times, &notes);
    return std::pair(found.at("initial").at("q_C1").get<double>(), notes.size());
  };
  const double expected = charge("").first;
  for (const char* guess : {".nodeset v(b)=0.6\n", ".nodeset v(b)=-300 v(a)=2\n"}) {
    BOOST_TEST(std::abs(charge(guess).first - expected) < 1e-12 * expected);
    BOOST_TEST(charge(guess).second == 0u);
  }
  BOOST_TEST(std::abs(charge(".ic v(b)=0.2\n.nodeset v(b)=0.6\n").first - 2e-10) < 1e-16);
  refused(circuit + ".nodeset v(output)=1", "line 7: unknown node \"output\"");
  refused(circuit + ".nodeset b=1", "line 7: expected .nodeset v(node)=value …");
  refused(circuit + ".nodeset v(0)=1", "line 7: the ground is at 0 V; expected another node");
  std::vector<Problem> notes;
  import_netlist("t\n" + circuit + ".nodeset v(b)=1\n.tran 1u 10u uic\n", &notes);
  BOOST_TEST_REQUIRE(notes.size() == 1u);
  BOOST_TEST(notes[0].where == "line 7");
  BOOST_TEST(notes[0].what == ".nodeset has no effect with uic in .tran");
}

// With uic, potentials of .ic are the voltages of capacitors that have no ic=, and other nodes are at
// 0 V.
BOOST_AUTO_TEST_CASE(given_potentials) {
  std::vector<Problem> notes;
  const std::string circuit =
      "t\nR0 a 0 1k\nC1 a b 1u\nC2 c a 2u\nC3 a b 3u ic=5\nC4 d c 4u\nR1 b 0 1k\nR2 c d 1k\n"
      ".param v=1\n.ic v(a)={v} v(d)=7\n";
  BOOST_TEST(import_netlist(circuit + ".tran 1u 10u uic\n", &notes).at("initial") ==
             Json({{"q_C1", "1e-06*(v)"},
                   {"q_C2", "2e-06*(-(v))"},
                   {"q_C3", "3e-06*5"},
                   {"q_C4", "4e-06*7"}}));
  BOOST_TEST(notes.empty());
  import_netlist("t\nR0 a 0 1k\nR1 a b 1k\nC1 b 0 1u ic=1\n.ic v(a)=1\n.tran 1u 9u uic\n", &notes);
  BOOST_REQUIRE(notes.size() == 1u);
  BOOST_TEST(notes[0].where == "line 5");
  BOOST_TEST(
      notes[0].what ==
      "the potential of a has no effect: with uic it is that of capacitors without ic= and of "
      "junctions with a charge, and there is none at this node");
  // Of a junction below forward * junction: C V / (1 - m) (1 - (1 - v/V)^(1 - m)), behind its resistance too.
  const Json diode = import_netlist(
      "t\nV1 a 0 1\nD1 a b d\nR1 b 0 1k\n.model d D(cjo=2n vj=0.8 m=0.5 rs=3 is=1e-30)\n"
      ".ic v(a)=1 v(b)=0.7\n.tran 1u 9u uic\n",
      &notes);
  BOOST_TEST(diode.at("initial").at("q_D1").get<double>() ==
                 2e-9 * 0.8 / 0.5 * (1.0 - std::sqrt(1.0 - 0.3 / 0.8)),
             boost::test_tools::tolerance(1e-9));
  BOOST_TEST(notes.empty());
  import_netlist("t\nV1 a 0 1\nR1 a b 1k\nC1 b 0 1u ic=1\n.tran 1u 9u\n", &notes);
  BOOST_REQUIRE(notes.size() == 1u);
  BOOST_TEST(notes[0].where == "line 4");
}

BOOST_AUTO_TEST_CASE(no_operating_point) {
  refused("V1 a 0 1\nL1 a b 1m\nL2 b 0 1m",
          "line 4: V1, L1 and L2 form a loop with a direct voltage, which makes its current grow "
          "forever: there is no operating point; expected one to start from, or uic in .tran, with "
          "initial values by ic= and .ic");
  refused("I1 0 a 1\nC1 a 0 1u",
          "line 3: I1 and C1 form a cut-set with a direct current, which charges the capacitors "
          "forever: there is no operating point; expected one to start from, or uic in .tran, with "
          "initial values by ic= and .ic");
}

BOOST_AUTO_TEST_CASE(different_names_stay_different) {
  const Json found = import_netlist(
      "t\nV1 in 0 1\nR-1 in o+ 1k\nR_1 in o- 1k\nC1 o+ 0 1n\nC2 o- o_plus 1n\nR3 o_plus 0 1k\n"
      "X1 in a-b s\nR4 a-b 0 1k\nR5 a_b x1_m 1k\nC5 x1_m 0 1u\nR6 a_b 0 1k\n"
      ".subckt s p q\nR1 p m 1k\nR2 m q 1k\n.ends\n.tran 1u 10u\n");
  const Json& system = found.at("system");
  BOOST_TEST(system.at("nodes") ==
             Json({"0", "in", "o_plus_2", "o_minus", "o_plus", "a_b_2", "x1_m_2", "a_b", "x1_m"}));
  BOOST_TEST(system.at("elements")[1].at("name") == "R_1_2");
  BOOST_TEST(system.at("elements")[2].at("name") == "R_1");
  BOOST_TEST(system.at("elements")[6].at("name") == "x1_R1");
}

// SPICE knows no order, and values may be assigned.
BOOST_AUTO_TEST_CASE(ways_to_write_elements) {
  const Json found = import_netlist(
      "t\nF1 0 c Vm 10\nR2 c 0 R=100\nC2 c 0 C=100n ic=2\nK1 L1 L2 0.5\nL1 a 0 L=1m\nL2 c 0 1m\n"
      "D1 c 0 dm area=3\nD2 c 0 dm 2 off\nV1 s 0 PULSE(0 1 {td} 1u 1u 1u) AC 1 0\n"
      "V2 d 0 SIN(0 1 1k) DC 1\nR5 d 0 1\nVm s b 0\nR1 b a 1k\n.model dm d is=1f\n.param td=2u\n"
      ".control\nrun\nplot v(c)\n.endc\n.tran {td/20} 300u uic\n");
  const Json& elements = found.at("system").at("elements");
  BOOST_TEST(elements[0].at("value") == "10*i_Vm");
  BOOST_TEST(elements[1].at("value") == 100.0);
  BOOST_TEST(elements[2].at("value") == 1e-7);
  BOOST_TEST(elements[3].at("inductors") == Json({"L1", "L2"}));
  BOOST_TEST(elements[4].at("value") == 1e-3);
  BOOST_TEST(elements[6].at("saturation") == "1e-15*3");
  BOOST_TEST(elements[7].at("saturation") == "1e-15*2");
  const std::string pulse = elements[8].at("value").get<std::string>();
  for (const auto& [t, value] : {std::pair(1e-6, 0.0), {2.5e-6, 0.5}, {3.5e-6, 1.0}, {9e-6, 0.0}})
    BOOST_TEST(std::abs(at(pulse, t) - value) < 1e-12);
  BOOST_TEST(std::abs(at(elements[9].at("value").get<std::string>(), 0.25e-3) - 1.0) < 1e-12);
  BOOST_TEST(found.at("initial").at("q_C2") == "1e-07*2");
}

// Parameters and models of a subcircuit are its own; defaults are of the inside, values of an instance
// of the outside.
BOOST_AUTO_TEST_CASE(scopes_of_subcircuits) {
  const Json found = import_netlist(
      "t\n.param q=5 w=7\n.model dm d is=1p\n"
      ".subckt bp a b PARAMS: r=2 q={w*10} w=3\n.param l={r/(w*q)} w2={l+1}\n.model dm d is=2p\n"
      "R1 a b {l}\nR2 a b {w2}\nD1 a b dm\n.ends\n"
      "V1 i 0 1\nX1 i 0 bp q={q*2}\nX2 i 0 bp r={w}\nD1 i 0 dm\nC1 i 0 1\n.tran 1 2 uic\n");
  const Experiment experiment = read_experiment(found.dump());
  const SymbolTable values = experiment.model.vocabulary.symbols({});
  const Json& elements = found.at("system").at("elements");
  const auto value = [&](std::size_t k) {
    return parse_formula(elements[k].at("value").get<std::string>(), values).value();
  };
  BOOST_TEST(std::abs(value(1) - 2.0 / (3.0 * 10.0)) < 1e-15);
  BOOST_TEST(std::abs(value(2) - 1.0 - 2.0 / (3.0 * 10.0)) < 1e-15);
  BOOST_TEST(std::abs(value(4) - 7.0 / (3.0 * 30.0)) < 1e-15);
  BOOST_TEST(elements[3].at("saturation") == 2e-12);
  BOOST_TEST(elements[7].at("saturation") == 1e-12);
}

// Wholly coupled inductors are one, beside an ideal transformer of ratio √(L₁/L₂).
BOOST_AUTO_TEST_CASE(whole_coupling) {
  const std::string circuit =
      "R1 a 0 1\nL1 a 0 4m ic=1\nL2 0 b 1m ic=3\nR2 b 0 1\n.tran 1u 9u uic\n";
  for (const double k : {1.0, -1.0}) {
    const Json found = import_netlist("t\nK1 L1 L2 " + std::to_string(k) + "\n" + circuit);
    const Json& elements = found.at("system").at("elements");
    BOOST_REQUIRE(elements.size() == 4u);
    BOOST_TEST(elements[0].at("type") == "ideal-transformer");
    BOOST_TEST(elements[0].at("from") == "a");
    BOOST_TEST(elements[0].at("secondary") == Json({"0", "b"}));
    BOOST_TEST(at(elements[0].at("ratio").get<std::string>(), 0.0) == 2.0 * k);
    // φ₁ = L₁ i₁ + M i₂ with M = 2 mH
    BOOST_TEST(found.at("initial").size() == 1u);
    BOOST_TEST(std::abs(at(found.at("initial").at("phi_L1").get<std::string>(), 0.0) -
                        (4e-3 + k * 2e-3 * 3.0)) < 1e-17);
  }
  refused(
      "V1 a 0 0\nR1 a b 1\nL1 b 0 1\nL2 c 0 1\nR2 c 0 1\nL3 d 0 1\nR3 d 0 1\nK1 L1 L2 1\n"
      "K2 L2 L3 0.1",
      "line 10: the inductors are coupled wholly, and one of them is coupled with others in part; "
      "expected a coupling between -1 and 1");
}

// Three coils with one flux: the first, and a transformer to each other one.
BOOST_AUTO_TEST_CASE(three_coils_on_one_core) {
  const std::string coils =
      "V1 a 0 0\nR1 a p 1\nL1 p 0 90m\nL2 s 0 360m\nL3 u 0 22.5m\nR2 s 0 9\nR3 u 0 4\n";
  const Json found =
      import_netlist("t\n" + coils + "K1 L1 L2 1\nK2 L1 L3 -1\nK3 L2 L3 -1\n.tran 1m 5m\n");
  const Json& elements = found.at("system").at("elements");
  BOOST_TEST_REQUIRE(elements.size() == 7u);
  BOOST_TEST(at(elements[5].at("ratio").get<std::string>(), 0.0) == 0.5);
  BOOST_TEST(at(elements[6].at("ratio").get<std::string>(), 0.0) == -2.0);
  BOOST_CHECK_NO_THROW(read_experiment(found.dump()));
  // One card for all of them.
  BOOST_TEST(import_netlist("t\n" + coils + "K1 L1 L2 L3 1\n.tran 1m 5m\n")
                 .at("system")
                 .at("elements")
                 .size() == 7u);
  BOOST_TEST(import_netlist("t\n" + coils + "K1 L1 L2 L3 0.5\n.tran 1m 5m\n")
                 .at("system")
                 .at("elements")
                 .size() == 10u);
  refused(coils + "K1 L1 L2 1\nK2 L1 L3 -1\nK3 L2 L3 1",
          "line 11: the signs of the couplings on one core contradict each other");
}

// Files beside the netlist, and below it; none outside.
BOOST_AUTO_TEST_CASE(files_are_included_from_the_folder_alone) {
  const IncludedText files = [](const std::string& file) -> std::string {
    if (file == "models.lib") return "* models\n.model dm d is=1e-12\n.param half={r/2}\n";
    if (file == "sections.lib")
      return ".lib fast\n.param r=1k\n.endl\n.lib slow\n.param r=2k\n.endl\n";
    if (file == "bad.lib") return "R1 a b {unknown}\n";
    throw std::runtime_error("is not there");
  };
  const std::string body = "V1 a 0 1\nR1 a b {half}\nC1 b 0 1u\nD1 b 0 dm\n.tran 1u 1m uic\n";
  const Json found =
      import_netlist("t\n.include \"models.lib\"\n.lib sections.lib slow\n" + body, nullptr, files);
  BOOST_TEST(found.at("system").at("parameters").at("r") == 2000.0);
  BOOST_TEST(found.at("system").at("elements")[3].at("saturation") == 1e-12);
  const auto refusal = [&](const std::string& text) {
    try {
      import_netlist("t\n" + text + ".tran 1u 1m\n", nullptr, files);
    } catch (const ExperimentError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  BOOST_TEST(
      refusal(".inc missing.lib\n").starts_with("line 2: the file missing.lib is not there"));
  BOOST_TEST(refusal(".inc bad.lib\n")
                 .starts_with("line 2: (bad.lib, line 1) unknown parameter \"unknown\""));
}

BOOST_AUTO_TEST_CASE(functions_nodes_and_laws) {
  std::vector<Problem> notes;
  const Json found = import_netlist(
      "t\n.func f(x, y) {x*y + 1}\n.param r={f(2, 3)}\n.global vdd\n"
      "V1 vdd 0 2\nX1 out part\n.subckt part o\nR1 vdd o {r}\n.ends\n"
      "B1 out 0 I=V(out)*V(out)*1m + V(vdd, out)*0\n"
      "E1 b 0 POLY(1) out 0 1 2 3\nR2 b 0 1\n"
      "E2 c 0 VALUE={V(out) > 1 ? 2 : time}\nR3 c 0 1\n"
      "S1 out 0 vdd 0 sw\n.model sw sw vt=5 ron=1 roff=1meg\nC1 out 0 1u\n.ac dec 1 1 1\n"
      ".tran 1u 1m\n",
      &notes);
  const Json& elements = found.at("system").at("elements");
  BOOST_TEST(found.at("system").at("parameters").at("r") == "(((2)*(3) + 1))");
  BOOST_TEST(elements[1].at("from") == "vdd");
  BOOST_TEST(elements[2].at("value") ==
             "potential_out*potential_out*0.001 + (potential_vdd - potential_out)*0");
  BOOST_TEST(elements[3].at("value") == "1 + 2*potential_out + 3*potential_out*potential_out");
  BOOST_TEST(elements[5].at("value") == "if(potential_out > 1, 2, t)");
  BOOST_TEST_REQUIRE(notes.size() == 1u);
  BOOST_TEST(notes[0].what.starts_with(".ac is passed over"));
  // The operating point: (2 - v)/7 = v²/1000 + v/1e6.
  const double v = found.at("initial").at("q_C1").get<double>() / 1e-6;
  BOOST_TEST(std::abs((2.0 - v) / 7.0 - v * v / 1000.0 - v / 1e6) < 1e-9);
  BOOST_CHECK_NO_THROW(read_experiment(found.dump()));
}

// A series resistance on a node of its own; the charge of the operating point.
BOOST_AUTO_TEST_CASE(diodes_with_charge_resistance_and_breakdown) {
  const Json found = import_netlist(
      "t\nV1 a 0 5\nR1 a b 1k\nD1 b 0 dm\nD2 0 b dz\n"
      ".model dm d rs=2 cjo=4p vj=0.8 m=0.4 tt=5n\n.model dz d bv=3 ibv=1m\n.tran 1n 1u\n");
  const Json& elements = found.at("system").at("elements");
  BOOST_TEST_REQUIRE(elements.size() == 5u);
  BOOST_TEST(elements[2].at("name") == "D1_rs");
  BOOST_TEST(elements[2].at("value") == 2.0);
  BOOST_TEST(elements[3].at("from") == elements[2].at("to"));
  BOOST_TEST(elements[3].at("capacitance") == 4e-12);
  BOOST_TEST(elements[4].at("breakdown") == 3.0);
  // i = 1e-14 (exp(v/0.02586492) - 1), (5 - v - 2 i)/1000 = i by fixed point: v = 0.6912, q = τ i + q_d(v).
  double v = 0.7, i = 0.0;
  for (int k = 0; k < 100; ++k) {
    i = (5.0 - v) / 1002.0;
    v = 0.02586492 * std::log(i / 1e-14 + 1.0);
  }
  const double f = 0.4, top = 0.4 * 0.8 / 0.8;  // fc = 0.5: the depletion ends at 0.4 V
  const double depletion = 4e-12 * 0.8 / 0.6 * (1.0 - std::pow(1.0 - top / 0.8, 0.6)) +
                           4e-12 / std::pow(0.5, 1.0 + f) *
                               ((1.0 - 0.5 * 1.4) * (v - top) + f / 1.6 * (v * v - top * top));
  BOOST_TEST(std::abs(found.at("initial").at("q_D1").get<double>() / (5e-9 * i + depletion) - 1.0) <
             1e-6);
  BOOST_CHECK_NO_THROW(read_experiment(found.dump()));
}

// A network needs a state: a circuit without capacitors and inductors gets one that stays 0.
BOOST_AUTO_TEST_CASE(circuits_without_states) {
  std::vector<Problem> notes;
  const Json found = import_netlist(
      "t\nV1 rest 0 SIN(0 1 1k)\nR1 rest b 1k\nD1 b 0 dm\n.model dm d\n.tran 1u 1m\n", &notes);
  BOOST_TEST(found.at("system").at("nodes") == Json({"0", "rest", "b", "rest_2"}));
  BOOST_TEST(found.at("initial") == Json({{"q_C_rest_2", 0}}));
  BOOST_TEST(!found.at("observe").contains("potential_rest_2"));
  BOOST_REQUIRE(notes.size() == 1u);
  BOOST_TEST(notes[0].where == "the netlist");
  BOOST_TEST(
      notes[0].what ==
      "nothing stores energy, and a network needs a state: C_rest_2 beside R_rest_2, on a node "
      "of their own, have one that stays 0");
}

BOOST_AUTO_TEST_CASE(what_is_wrong_with_the_network_is_told_by_line) {
  const std::string source = "V1 a 0 1\n";
  refused(source + "R1 a b {1k+}\nC1 b 0 1n",
          "line 3: \"1k+\" is no expression: expected a number, a name, \"-\" or \"(\", found end "
          "of formula");
  refused(source + "R1 a b 1k\nC1 b 0 1n\nr1 a b 2k",
          "line 5: the name r1 is that of line 3 again");
  refused(source + "R1 a b 1k\nC1 b 0 0",
          "line 4: the value of C1 is 0.0; expected a number greater than 0");
  refused(source + "R1 a b 1k\nC1 b 0 1n\nV2 a 0 2",
          "line 5: voltage sources V1 and V2 form a loop");
  refused(
      source + "R1 a b 1k\nC1 b 0 1n\nR2 c d 1",
      "line 5: the nodes \"c\" and \"d\" float: no element leads from there to the ground \"0\"");
  refused(source + "R1 a b 1k\nC1 b 0 1n\n.ic v(bb)=1",
          "line 5: unknown node \"bb\" (did you mean \"b\"?)");
  refused(source + "R1 a b 1k\nC1 b 0 1n\n.ic b=1", "line 5: expected .ic v(node)=value …");
  refused(source + "R1 a b 1k\nC1 b 0 1n\n.subckt s x y\nR1 x y 1",
          "line 5: this .subckt has no .ends; expected one after its elements");
  refused(source + "R1 a b 1k\nC1 b 0 1n\n.ends", "line 5: ends no .subckt; expected one before");
  refused(source + "R1 a b 1k\nC1 b 0 1n\nD1 b 0 dm\n.model dm d rs=1 ik=1p nz=2",
          "line 6: the parameters ik and nz of a model of the type d are not supported");
  refused(source + "R1 a b 1k\nC1 b 0 1n\nR2 a b rx ry=1", "line 5: unknown model \"rx\"");
  refused(source + "R1 a b 1k tx1=1\nC1 b 0 1n 5",
          "line 3: the parameter tx1 is not supported\n"
          "line 4: does not end before \"5\"; expected nothing there");
  refused(source + "X1 a s\nX2 a s\nX3 a s\n.subckt s x\nR1 x y 1k\nC1 y 0 0\nR2 x 0 {r}\n.ends",
          "line 9: unknown parameter \"r\"");
  refused(source + "X1 a s\nX2 a s\n.subckt s x\nR1 x y 1k\nC1 y 0 0\n.ends",
          "line 7: the value of x1_C1 is 0.0; expected a number greater than 0");
  refused(source + "X1 a s k=1\n.subckt s x\nR1 x 0 1k\n.ends\n.subckt s x\n.ends",
          "line 3: the subcircuit s has no parameter k\n"
          "line 7: the subcircuit s is that of line 4 again");
  refused(".param r={r+1}\n" + source + "C1 a 0 {r}", "line 2: unknown parameter \"r\"");
}

BOOST_AUTO_TEST_CASE(what_is_so_of_several_elements_is_noted_once) {
  std::vector<Problem> notes;
  import_netlist(
      "t\nV1 vdd 0 3\n.subckt inv i o vdd\nMN o i 0 0 nm W=2u L=1u\nMP o i vdd vdd pm W=4u "
      "L=1u\n.ends\n"
      "X1 a b vdd inv\nX2 b c vdd inv\nR1 a 0 1k\nC1 c 0 1p\n"
      ".model nm NMOS(TOX=20n)\n.model pm PMOS(TOX=20n)\n.tran 1n 1u uic\n",
      &notes);
  BOOST_TEST_REQUIRE(notes.size() == 1u);
  BOOST_TEST(notes[0].where == "lines 4 and 5");
  BOOST_TEST(notes[0].what.starts_with("the capacitance of the oxide is constant here"));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
