#include "courant/running/observed_quantities.hpp"

#include <boost/test/unit_test.hpp>

#include "problems.hpp"

namespace courant::test {
// Mistakes that these cases have to notice:
//  * the hidden constraint has no column
BOOST_AUTO_TEST_SUITE(observed_quantities)

namespace {

ObservedQuantities observed(const Problem& problem) { return {problem.experiment, problem.ladder}; }

}  // namespace

// Coordinates, the energy, what is asked for, the constraint and its first derivative: in this order.
BOOST_AUTO_TEST_CASE(the_numbers_of_a_row) {
  const Problem pendulum = problem(Json::parse(R"json({
    "system": { "type": "mechanical", "coordinates": ["x", "y"], "potential": "y",
                "holonomic": ["x^2 + y^2 - 1"] },
    "initial": { "x": 1, "y": 0, "p_x": 0, "p_y": 0 },
    "method": { "type": "constrain-first", "discretization": "midpoint" },
    "time": { "step": 0.1, "end": 1 },
    "observe": { "far": "x + 10*y" }
  })json"));
  const ObservedQuantities row = observed(pendulum);
  const std::vector<std::string> names = {"x", "y", "p_x", "p_y", "H", "far"};
  BOOST_TEST_REQUIRE(row.names.size() >= names.size() + 2);
  for (std::size_t i = 0; i < names.size(); ++i) BOOST_TEST(row.names[i] == names[i]);
  BOOST_TEST(row.coordinate_count == 4u);
  BOOST_TEST(row.first_constraint == 6u);
  BOOST_TEST(row.written_count == 8u);
  BOOST_TEST(row.H.value() == 4);
  BOOST_TEST(row.names[6] == "constraint[0]");
  BOOST_TEST(!row.balance.has_value());
  BOOST_TEST(!row.account);

  const Function all("row", row.inputs, row.quantities);
  const VectorXd x = Eigen::Vector4d(0.5, 2.0, 3.0, -1.0), none = VectorXd::Zero(8);
  std::vector<const double*> in(row.inputs.size(), none.data());
  VectorXd velocities = none;
  velocities.head(2) = x.tail(2);
  in[0] = x.data();
  in[1] = in[2] = velocities.data();
  VectorXd values(all.output_size());
  all.value(in.data(), values.data());
  BOOST_TEST(values[0] == 5.0 + 2.0);                   // p²/2 + y
  BOOST_TEST(values[1] == 20.5);                        // far
  BOOST_TEST(std::abs(values[2]) == 0.25 + 4.0 - 1.0);  // the constraint
  BOOST_TEST(std::abs(values[3]) == 2.0 * 0.5);         // d/dt of it: 2 (x p_x + y p_y)
}

// What velocities decide is measured with those of the vector field.
BOOST_AUTO_TEST_CASE(velocities_are_those_of_the_field) {
  const Problem fall = problem(Json::parse(R"json({
    "system": { "type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "p_q^2/4 + q" },
    "initial": { "q": 0, "p_q": 1 },
    "method": { "type": "rk4" }, "time": { "step": 0.1, "end": 1 },
    "observe": { "speed": "q'" }
  })json"));
  BOOST_TEST(observed(fall).field.has_value());
  BOOST_TEST(observed(fall).is_field);
}

// Ports have an account, and its balance a place in the row.
BOOST_AUTO_TEST_CASE(ports_have_an_account) {
  const Problem damped = problem(Json::parse(R"json({
    "system": { "type": "port-hamiltonian", "coordinates": ["q", "p"], "J": [[0, 1], [-1, 0]],
                "R": [[0, 0], [0, 0.5]], "hamiltonian": "(q^2 + p^2)/2" },
    "initial": { "q": 1, "p": 0 },
    "method": { "type": "discretize-first", "discretization": "midpoint" },
    "time": { "step": 0.1, "end": 1 }
  })json"));
  const ObservedQuantities row = observed(damped);
  BOOST_TEST((row.account != nullptr));
  BOOST_TEST_REQUIRE(row.balance.has_value());
  BOOST_TEST(row.names[static_cast<std::size_t>(*row.balance)] == "balance");
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant::test
