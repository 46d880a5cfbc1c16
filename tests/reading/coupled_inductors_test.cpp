#include "courant/reading/coupled_inductors.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/structures/elements/electrical.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * couplings of three inductors that cannot be are taken
BOOST_AUTO_TEST_SUITE(coupled_inductors_test)

namespace {

NetworkElement inductor(const std::string& name, double inductance) {
  return {.type = "inductor",
          .name = name,
          .pointer = "/" + name,
          .element = elements::inductor(inductance),
          .terminals = {{"a", ""}, {"", ""}}};
}

NetworkElement mutual(const std::string& first, const std::string& second, double value,
                      bool is_coupling) {
  return {.type = "mutual-inductance",
          .name = "K_" + first + second,
          .pointer = "/K_" + first + second,
          .mutual = NetworkElement::Mutual{{first, second}, "", value, is_coupling}};
}

elements::NetworkAssembly assembly_of(const std::vector<NetworkElement>& elements) {
  elements::NetworkAssembly assembly;
  for (const NetworkElement& element : elements)
    if (!element.mutual) assembly.add(element.name, element.element, {1, 0});
  return assembly;
}

std::string problem_of(const std::vector<NetworkElement>& elements) {
  Findings findings;
  elements::NetworkAssembly assembly = assembly_of(elements);
  BOOST_TEST(!couple(elements, assembly, findings));
  BOOST_TEST_REQUIRE(findings.problems().size() == 1u);
  return findings.problems()[0].where + ": " + findings.problems()[0].what;
}

}  // namespace

// 𝓛 = (2 2; 2 8): ½ φᵀ 𝓛⁻¹ φ = (8 φ₁² - 4 φ₁ φ₂ + 2 φ₂²)/24; the other inductor has φ²/6.
BOOST_AUTO_TEST_CASE(fluxes_of_coupled_inductors_share_an_energy) {
  for (const bool is_coupling : {true, false}) {
    Findings findings;
    const std::vector<NetworkElement> elements = {
        inductor("A", 2), inductor("B", 3), inductor("C", 8),
        mutual("A", "C", is_coupling ? 0.5 : 2.0, is_coupling)};
    elements::NetworkAssembly assembly = assembly_of(elements);
    BOOST_TEST_REQUIRE(couple(elements, assembly, findings));
    const auto energy = [&](const VectorXd& flux) {
      return assembly.energy()(constants(flux), 0.0).value();
    };
    BOOST_TEST(std::abs(energy(VectorXd{{1.0, 0.0, 1.0}}) - 0.25) < 1e-15);
    BOOST_TEST(std::abs(energy(VectorXd{{1.0, 3.0, -2.0}}) - 2.5) < 1e-15);
  }
  Findings findings;
  elements::NetworkAssembly none = assembly_of({inductor("A", 2)});
  BOOST_TEST(couple({inductor("A", 2)}, none, findings));
}

BOOST_AUTO_TEST_CASE(couplings_that_cannot_be_are_problems) {
  const NetworkElement a = inductor("A", 1), b = inductor("B", 1), c = inductor("C", 1);
  BOOST_TEST(problem_of({a, b, mutual("A", "D", 0.5, true)}) ==
             "/K_AD/inductors: \"D\" is no inductor that is given by its value; expected the names "
             "of two such inductors");
  BOOST_TEST(problem_of({a, b, mutual("A", "A", 0.5, true)}) ==
             "/K_AA/inductors: \"A\" is both of them; expected the names of two such inductors");
  BOOST_TEST(problem_of({a, b, mutual("A", "B", 1.0, true)})
                 .starts_with("/K_AB: couples the inductors A and B too closely"));
  // Each pair may be coupled so, all three may not.
  BOOST_TEST(problem_of({a, b, c, mutual("A", "B", 0.9, true), mutual("B", "C", 0.9, true),
                         mutual("C", "A", -0.9, true)})
                 .starts_with("/K_CA: with the other mutual inductances"));
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
