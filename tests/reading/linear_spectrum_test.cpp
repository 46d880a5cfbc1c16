#include "courant/reading/linear_spectrum.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "courant/reading/experiment.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(linear_spectrum)

namespace {

Json element(const char* type, const char* name, const char* from, const char* to, double value) {
  return {{"type", type}, {"name", name}, {"from", from}, {"to", to}, {"value", value}};
}

double decay_of(const Json& nodes, const Json& elements) {
  const Experiment experiment = read_experiment_document(
      {{"system", {{"type", "network"}, {"nodes", nodes}, {"elements", elements}}},
       {"initial", Json::object()}});
  return fastest_decay(*experiment.model.system,
                       VectorXd::Zero(experiment.model.vocabulary.coordinates.size()));
}

}  // namespace

BOOST_AUTO_TEST_CASE(of_a_resistor_beside_a_capacitor) {
  const double decay = decay_of({"a", "0"}, {element("resistor", "R", "a", "0", 1e3),
                                             element("capacitor", "C", "a", "0", 1e-6)});
  BOOST_TEST(decay == 1e3, boost::test_tools::tolerance(1e-12));
}

// A Butterworth low pass of order 7 has its poles on a circle, of a radius 2π times its frequency; the elements are those of the tables
// for 50 Ω and 10 MHz. In these units the QZ algorithm alone does not converge.
BOOST_AUTO_TEST_CASE(of_a_low_pass) {
  const double omega = 2.0 * std::numbers::pi * 1e7, R = 50.0;
  Json elements = {element("resistor", "RS", "n1", "0", R),
                   element("resistor", "RL", "n4", "0", R)};
  const std::vector<std::string> along = {"n1", "n2", "n3", "n4"};
  for (int k = 1; k <= 7; ++k) {
    const double g = 2.0 * std::sin((2 * k - 1) * std::numbers::pi / 14.0);
    const auto place = static_cast<std::size_t>((k - 1) / 2);
    const std::string name = (k % 2 == 1 ? "C" : "L") + std::to_string(k);
    elements.push_back(
        k % 2 == 1 ? element("capacitor", name.c_str(), along[place].c_str(), "0", g / (R * omega))
                   : element("inductor", name.c_str(), along[place].c_str(),
                             along[place + 1].c_str(), g * R / omega));
  }
  // The pole on the real axis decays fastest.
  BOOST_TEST(decay_of({"n1", "n2", "n3", "n4", "0"}, elements) == omega,
             boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
