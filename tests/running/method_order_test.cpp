#include <boost/test/unit_test.hpp>

#include "problems.hpp"

// The key `order` of methods.
BOOST_AUTO_TEST_SUITE(method_order)

using namespace courant;

namespace {

const Json kPendulum = {
    {"system",
     {{"type", "hamiltonian"}, {"coordinates", {"q"}}, {"hamiltonian", "p_q^2/2 - cos(q)"}}},
    {"initial", {{"q", 0.7}, {"p_q", 0.4}}}};

// x' = p, y' = q, z' = y x' by a multiplier: see experiments/nonholonomic_order_8.json.
Json nonholonomic() {
  Json experiment = test::experiment_file("nonholonomic_order_8");
  for (const char* key : {"method", "time", "observe", "expect", "output"}) experiment.erase(key);
  return experiment;
}

std::string refusal(const Json& experiment, const Json& method) {
  try {
    test::problem(experiment).prepare(method, 0.1);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace

BOOST_AUTO_TEST_CASE(orders_from_json) {
  const test::Problem free = test::problem(kPendulum), held = test::problem(nonholonomic());
  for (const int order : {2, 4, 6, 8}) {
    const auto method_1 = free.prepare({{"type", "discretize-first"}, {"order", order}}, 0.1);
    BOOST_TEST(method_1.integrator->order() == order);
    BOOST_TEST((method_1.integrator->is_symplectic() == true));
    const auto method_2 = held.prepare({{"type", "constrain-first"}, {"order", order}}, 0.1);
    BOOST_TEST(method_2.integrator->order() == order);
  }
  BOOST_TEST(free.prepare({{"type", "discretize-first"}}, 0.1).integrator->order() == 2);
}

BOOST_AUTO_TEST_CASE(orders_that_cannot_be_had_are_refused) {
  const Json skewed = {{"type", "theta"}, {"theta", 0.3}};
  const auto begins = [](const std::string& text, const std::string& start) {
    BOOST_TEST(text.find(start) == 0u, text);
  };
  begins(refusal(kPendulum, {{"type", "discretize-first"}, {"order", 3}}),
         "/method/order: is 3; expected 2, 4, 6 or 8");
  for (const char* type : {"discretize-first", "constrain-first"})
    for (const int order : {2, 4})
      begins(refusal(kPendulum, {{"type", type}, {"discretization", skewed}, {"order", order}}),
             "/method/order: is " + std::to_string(order) +
                 ", but the method is not symmetric, and of order 1");
  begins(refusal(nonholonomic(), {{"type", "discretize-first"}, {"order", 4}}),
         "/method/order: is 4, but on a system with constraints");
  begins(refusal(kPendulum, {{"type", "discretize-first"}, {"order", 4}, {"start", "rk2"}}),
         "/method/start: is \"rk2\"");
}

BOOST_AUTO_TEST_SUITE_END()
