#include "courant/reading/element_parts.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/reading/experiment.hpp"
#include "courant/structures/network.hpp"
#include "experiment_problems.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * the value of a spring is its compliance
BOOST_AUTO_TEST_SUITE(element_parts_test)

namespace {

// A network of these elements between the node a and the ground 0.
Model network_of(const char* elements) {
  const Json experiment = {
      {"system", {{"type", "network"}, {"nodes", {"0", "a"}}, {"elements", Json::parse(elements)}}},
      {"initial", Json::object()}};
  return read_experiment(experiment.dump()).model;
}

double energy(const Model& model, double x) {
  return model.system
      ->energy(constants(VectorXd{{x}}), ExprVector::Zero(model.system->auxiliary_size()), 0.0)
      ->value();
}

// By their values, energies and laws; the value of a spring is its stiffness.
BOOST_AUTO_TEST_CASE(energies_of_storages) {
  const auto capacitor = [](const char* law) {
    return std::string(R"([{"type":"capacitor","name":"C","from":"a","to":"0",)") + law +
           R"(},{"type":"resistor","name":"R","from":"a","to":"0","value":1}])";
  };
  for (const char* law : {R"("value":4)", R"("energy":"q_C^2/8")", R"("voltage":"q_C/4")"})
    BOOST_TEST(energy(network_of(capacitor(law).c_str()), 3.0) == 9.0 / 8.0,
               boost::test_tools::tolerance(1e-14));
  const auto spring = [](const char* law) {
    return std::string(R"([{"type":"spring","name":"k","from":"a","to":"0",)") + law +
           R"(},{"type":"damper","name":"d","from":"a","to":"0","value":1}])";
  };
  for (const char* law : {R"("value":4)", R"("energy":"2*x_k^2")", R"("force":"4*x_k")"})
    BOOST_TEST(energy(network_of(spring(law).c_str()), 3.0) == 18.0,
               boost::test_tools::tolerance(1e-14));
}

// 2 V drive 0.4 A through 5 Ω; what the resistance and the source take the capacitor gives.
BOOST_AUTO_TEST_CASE(sources_and_resistances) {
  const Model model = network_of(
      R"([{"type":"capacitor","name":"C","from":"a","to":"0","value":0.5},
          {"type":"resistor","name":"R","from":"a","to":"0","value":5},
          {"type":"current-source","name":"I","from":"a","to":"0","value":"3*t"}])");
  BOOST_TEST_REQUIRE((model.system->names().auxiliary == std::vector<std::string>{"i_R", "v_I"}));
  const VectorXd q{{1.0}}, unknowns{{0.4, 2.0}};
  const auto residual = [&](double rate, double t) {
    return model.system->residual(q, VectorXd{{rate}}, unknowns, t).norm();
  };
  BOOST_TEST(residual(-0.4 - 3.0 * 0.1, 0.1) < 1e-15);
  BOOST_TEST(residual(-0.4, 0.1) > 0.1);
}

}  // namespace

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
