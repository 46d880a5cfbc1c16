#include "courant/structures/elements/network_assembly.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

#include "courant/structures/elements/electrical.hpp"
#include "courant/structures/elements/mechanical.hpp"
#include "courant/structures/elements/thermofluid.hpp"
#include "courant/structures/elements/transducers.hpp"
#include "courant/structures/elements/transistors.hpp"

namespace courant::elements {
// Mistakes that these cases have to notice:
//  * a law has the variables of the first element of the network (structures/elements/element.cpp, bound)
//  * the states of an element are counted from 0 (structures/elements/network_assembly.cpp, add)
//  * the second of two coupled inductors keeps its own energy besides (structures/elements/network_assembly.cpp, energy)
BOOST_AUTO_TEST_SUITE(network_assembly)

namespace {

using Kind = NetworkBranch::Kind;

// All currents and voltages, as numbers.
class Meter final : public NetworkVariables {
 public:
  Meter(const VectorXd& currents, const VectorXd& voltages, const VectorXd& x)
      : currents_(constants(currents)), voltages_(constants(voltages)), x_(constants(x)) {}

  Expr current(Index branch) const override { return currents_[branch]; }
  Expr voltage(Index branch) const override { return voltages_[branch]; }
  const ExprVector& x() const override { return x_; }
  const Expr& t() const override { return t_; }

 private:
  ExprVector currents_, voltages_, x_;
  Expr t_ = 0.25;
};

// What the laws of an element give between two others, whose branch and state come before its own.
std::vector<double> laws_of(const Element& element, const VectorXd& currents,
                            const VectorXd& voltages) {
  NetworkAssembly assembly;
  assembly.add("before", capacitor(1.0), {1, 0});
  std::vector<Index> nodes;
  for (Index k = 0; k < element.terminal_count(); ++k) nodes.push_back(k + 1);
  assembly.add("E", element, nodes);
  VectorXd all_currents(currents.size() + 1), all_voltages(currents.size() + 1);
  all_currents << 1e3, currents;
  all_voltages << -1e3, voltages;
  const Meter meter(all_currents, all_voltages, VectorXd::Constant(assembly.state_count(), 7.0));
  std::vector<double> values;
  for (std::size_t k = 1; k < assembly.branches().size(); ++k)
    if (assembly.branches()[k].law) values.push_back(assembly.branches()[k].law(meter).value());
  return values;
}

void check_laws(const Element& element, const VectorXd& currents, const VectorXd& voltages,
                const std::vector<double>& expected) {
  const std::vector<double> found = laws_of(element, currents, voltages);
  BOOST_TEST_REQUIRE(found.size() == expected.size());
  for (std::size_t k = 0; k < found.size(); ++k)
    BOOST_TEST(std::abs(found[k] - expected[k]) < 1e-12 * (1.0 + std::abs(expected[k])));
}

}  // namespace

// By hand, at i = (2, 3, …) and v = (5, 11, …).
BOOST_AUTO_TEST_CASE(laws_of_elements) {
  const VectorXd i1{{2.0}}, v1{{5.0}}, i2{{2.0, 3.0}}, v2{{5.0, 11.0}};
  const Law at_t = [](const Variables& own) { return 4.0 * own.t(); };
  check_laws(resistor(100.0), i1, v1, {200.0});
  check_laws(resistor_of_voltage([](const Variables& own) { return square(own.voltage(0)); }), i1,
             v1, {25.0});
  check_laws(heating(resistor(100.0)), i2, v2, {200.0, -2.0 * 5.0 / 11.0});
  check_laws(ideal_transformer(0.5), i2, v2, {5.5, -1.0});
  check_laws(gyrator(10.0), i2, v2, {30.0, -20.0});
  check_laws(voltage_source(at_t), i1, v1, {1.0});
  check_laws(current_source(3.0), i1, v1, {3.0});
  check_laws(electrical_switch(constant(1.0), 0.5, 1e9), i1, v1, {1.0});
  check_laws(electrical_switch(constant(0.0), 0.5, 1e9), i1, v1, {2e9});
  check_laws(diode({.saturation = 1e-3, .scale = 2.0}, {}), i1, v1, {1e-3 * std::expm1(2.5)});
  check_laws(damper(domains::rotation, constant(4.0)), i1, v1, {20.0});
  check_laws(friction(domains::translation, 6.0, 2.0), i1, v1, {6.0 * std::tanh(2.5)});
  check_laws(gear(3.0), i2, v2, {33.0, -6.0});
  check_laws(motor(0.1, domains::rotation), i2, v2, {1.1, -0.2});
  check_laws(pipe(constant(7.0)), i1, v1, {14.0});
  check_laws(thermal_conductor(constant(2.0)), i2, VectorXd{{400.0, 300.0}},
             {2.0 * 100.0 / 400.0, -2.0 * 100.0 / 300.0});
  check_laws(heat_source(constant(60.0)), i1, VectorXd{{300.0}}, {-0.2});
}

BOOST_AUTO_TEST_CASE(energies_of_elements) {
  const auto energy = [](const Element& element, const VectorXd& own) {
    NetworkAssembly assembly;
    assembly.add("before", mass(2.0), {9});
    std::vector<Index> nodes;
    for (Index k = 0; k < element.terminal_count(); ++k) nodes.push_back(k + 1);
    assembly.add("E", element, nodes);
    VectorXd x(own.size() + 1);
    x << 4.0, own;
    return assembly.energy()(constants(x), 0.0).value() - 4.0;
  };
  const VectorXd three{{3.0}};
  BOOST_TEST(energy(capacitor(0.5), three) == 9.0);
  BOOST_TEST(energy(inductor(4.0), three) == 9.0 / 8.0);
  BOOST_TEST(energy(spring(4.0), three) == 18.0);
  BOOST_TEST(energy(torsion_spring(4.0), three) == 18.0);
  BOOST_TEST(energy(inertia(3.0), three) == 1.5);
  BOOST_TEST(energy(inertance(3.0), three) == 1.5);
  BOOST_TEST(std::abs(energy(tank(2.0, 1000.0, 10.0), three) - 1000.0 * 10.0 * 9.0 / 4.0) < 1e-9);
  BOOST_TEST(std::abs(energy(heat_capacity(2.0, 300.0), three) - 600.0 * std::exp(1.5)) < 1e-9);
  const Element magnet = electromagnet(
      [](const ExprVector& own, const ExprVector&, const Expr&) { return 1.0 + own[1]; });
  BOOST_TEST(energy(magnet, VectorXd{{3.0, 1.0}}) == 9.0 / 4.0);
}

// A source charges a capacitor through a resistor: i = (V - q/C)/R.
BOOST_AUTO_TEST_CASE(a_circuit_is_a_system) {
  NetworkAssembly circuit;
  circuit.add("V", voltage_source(5.0), {1, 0});
  circuit.add("R", resistor(100.0), {1, 2});
  circuit.add("C", capacitor(1e-3), {2, 0});
  const std::shared_ptr<const Network> system = circuit.network();
  BOOST_TEST(system->names().coordinates == std::vector<std::string>{"q_C"},
             boost::test_tools::per_element());
  BOOST_TEST(system->names().auxiliary == (std::vector<std::string>{"i_V", "i_R"}),
             boost::test_tools::per_element());
  BOOST_TEST(system->node_count() == 3);
  const double q = 2e-3, i = (5.0 - q / 1e-3) / 100.0;
  const auto residual = [&](double rate) {
    return system->residual(VectorXd{{q}}, VectorXd{{rate}}, VectorXd{{-i, i}}, 0.0).norm();
  };
  BOOST_TEST(residual(i) < 1e-15);
  BOOST_TEST(residual(2.0 * i) > 1e-3);
}

// 𝓛 = (2 2; 2 8): ½ φᵀ 𝓛⁻¹ φ = (8 φ₁² - 4 φ₁ φ₂ + 2 φ₂²)/24.
BOOST_AUTO_TEST_CASE(coupled_inductors_share_an_energy) {
  NetworkAssembly coils;
  coils.add("A", inductor(2.0), {1, 0});
  coils.add("B", inductor(3.0), {2, 0});
  coils.add("C", inductor(8.0), {3, 0});
  BOOST_TEST(coils.couple("C", "A", 0.5));
  const auto energy = [&](const VectorXd& x) { return coils.energy()(constants(x), 0.0).value(); };
  BOOST_TEST(std::abs(energy(VectorXd{{1.0, 3.0, -2.0}}) - 2.5) < 1e-15);
  // Each pair may be coupled so, all three may not.
  BOOST_TEST(!coils.couple("A", "C", 0.5));
  BOOST_TEST(coils.has_positive_inductances());
  BOOST_TEST(coils.couple("A", "B", 0.9));
  BOOST_TEST(coils.couple("B", "C", -0.9));
  BOOST_TEST(!coils.has_positive_inductances());
  BOOST_CHECK_THROW(coils.network(), std::invalid_argument);
}

// Between joined terminals there is no branch; a p-n-p has its branches the other way.
BOOST_AUTO_TEST_CASE(transistors_have_the_branches_of_their_terminals) {
  const auto branches = [](const Element& element, const std::vector<Index>& nodes) {
    NetworkAssembly assembly;
    assembly.add("Q", element, nodes);
    std::vector<std::string> all;
    for (const NetworkBranch& branch : assembly.branches())
      all.push_back(branch.name + " " + std::to_string(branch.from) + std::to_string(branch.to));
    return all;
  };
  const JunctionCharge none, charge{.capacitance = 1e-12};
  BOOST_TEST(branches(bipolar_transistor({}, charge, none, false), {1, 2, 3}) ==
                 (std::vector<std::string>{"Q_be 23", "Q_bc 21", "Q_be_charge 23"}),
             boost::test_tools::per_element());
  BOOST_TEST(branches(bipolar_transistor({}, none, charge, true), {1, 2, 3}) ==
                 (std::vector<std::string>{"Q_be 32", "Q_bc 12", "Q_bc_charge 12"}),
             boost::test_tools::per_element());
  BOOST_TEST(branches(bipolar_transistor({}, charge, charge, false, {0, 1, 1}), {1, 2, 2}) ==
                 (std::vector<std::string>{"Q_bc 21", "Q_bc_charge 21"}),
             boost::test_tools::per_element());
  BOOST_TEST(branches(mos_transistor({}, false, {0, 1, 2, 2}), {1, 2, 3, 3}) ==
                 (std::vector<std::string>{"Q_ds 13", "Q_gs 23"}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(what_does_not_fit_is_refused) {
  NetworkAssembly assembly;
  assembly.add("R", resistor(1.0), {1, 0});
  BOOST_CHECK_THROW(assembly.add("R", resistor(1.0), {1, 0}), std::invalid_argument);
  BOOST_CHECK_THROW(assembly.add("S", resistor(1.0), {1}), std::invalid_argument);
  BOOST_CHECK_THROW(assembly.add("S", resistor(1.0), {1, -1}), std::invalid_argument);
  BOOST_CHECK_THROW(assembly.add("S", resistor(1.0), {1, 1}), std::invalid_argument);
  BOOST_CHECK_THROW(assembly.add("M", mass(1.0), {1, 0}), std::invalid_argument);
  BOOST_CHECK_THROW(assembly.couple("R", "R", 0.5), std::invalid_argument);
  BOOST_CHECK_THROW(assembly.couple("R", "L", 0.5), std::invalid_argument);
  BOOST_TEST(assembly.branches().size() == 1u);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant::elements
