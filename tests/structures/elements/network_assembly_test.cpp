#include "courant/structures/elements/network_assembly.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/structures/elements/electrical.hpp"
#include "courant/structures/elements/mechanical.hpp"

namespace courant::elements {
// Mistakes that these cases have to notice:
//  * the second of two coupled inductors keeps its own energy besides (structures/elements/network_assembly.cpp, energy)
BOOST_AUTO_TEST_SUITE(network_assembly)

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
