#include <boost/test/unit_test.hpp>

#include "../reading/experiment_problems.hpp"
#include "run_in.hpp"

// Mistakes that these cases have to notice:
//  * resistors that give energy are taken (reading/read_port_hamiltonian.cpp)
//  * resistance need not be symmetric (reading/read_port_hamiltonian.cpp)
BOOST_AUTO_TEST_SUITE(read_port_hamiltonian_test)

using namespace courant;

namespace {

// A damped oscillator: R = [[0, 0], [0, d]], driven through one port.
Json damped(const Json& R) {
  return {{"system",
           {{"type", "port-hamiltonian"},
            {"parameters", {{"d", 0.5}}},
            {"coordinates", {"q", "p"}},
            {"J", {{0, 1}, {-1, 0}}},
            {"R", R},
            {"B", {0, 1}},
            {"hamiltonian", "(p^2 + q^2)/2"},
            {"ports", "open"},
            {"inputs", {"sin(t) - 2*y"}}}},
          {"initial", {{"q", 1}, {"p", 0.5}}}};
}

}  // namespace

// q' = p, p' = -q - d p + u with u = sin t - 2 p: resistors take, inputs see time and output.
BOOST_AUTO_TEST_CASE(resistors_and_feedback) {
  const Experiment experiment = read_experiment(damped({{0, 0}, {0, "d"}}).dump());
  const ImplicitSystem& system = *experiment.model.system;
  const double q = 0.3, p = -0.7, t = 0.9, u = std::sin(t) - 2.0 * p;
  const VectorXd x = VectorXd{{q, p}}, v = VectorXd{{p, -q - 0.5 * p + u}};
  BOOST_TEST(system.residual(x, v, VectorXd::Constant(1, u), t).norm() < 1e-15);
  BOOST_TEST(system.residual(x, v, VectorXd::Constant(1, u), 0.0).norm() > 0.1);
  BOOST_TEST(system.residual(x, v, VectorXd::Constant(1, -u), t).norm() > 0.1);
}

// Ports with names, and feedthrough: u_motor = sin t - 2 y_motor with y_motor = p + 3 u_motor, and y
// is a word of observables.
BOOST_AUTO_TEST_CASE(named_ports_and_feedthrough) {
  Json description = damped({{0, 0}, {0, "d"}});
  description["system"]["port_names"] = {"motor"};
  description["system"]["D"] = {{3}};
  description["system"]["inputs"] = {"sin(t) - 2*y_motor"};
  description["observe"] = {{"power", "u_motor*y_motor"}, {"y_motor", "y_motor"}};
  const Experiment experiment = read_experiment(description.dump());
  const ImplicitSystem& system = *experiment.model.system;
  BOOST_TEST((system.names().auxiliary == std::vector<std::string>{"u_motor"}));
  const double q = 0.3, p = -0.7, t = 0.9, u = (std::sin(t) - 2.0 * p) / 7.0;
  const VectorXd x = VectorXd{{q, p}}, v = VectorXd{{p, -q - 0.5 * p + u}};
  BOOST_TEST(system.residual(x, v, VectorXd::Constant(1, u), t).norm() < 1e-15);
  const SymbolTable symbols = experiment.model.symbols(constants(x), constants(v),
                                                       ExprVector::Constant(1, Expr(u)), Expr(t));
  BOOST_TEST(std::abs(symbols.find("y_motor")->values[0].value() - (p + 3.0 * u)) < 1e-15);

  description["system"]["port_names"] = {"motor", "brake"};
  BOOST_TEST(problems(description)
                 .find("/system/port_names: has 2 names; expected one for each of "
                       "the 1 columns of B") != std::string::npos);
  // A coordinate y is no output.
  Json with_y = damped({{0, 0}, {0, "d"}});
  with_y["system"]["coordinates"] = {"y", "p"};
  with_y["system"]["hamiltonian"] = "(p^2 + y^2)/2";
  with_y["initial"] = {{"y", 1}, {"p", 0}};
  BOOST_TEST(problems(with_y) == "");
}

// An R that would give energy is refused, at whatever points it does so.
BOOST_AUTO_TEST_CASE(resistors_that_give_energy_are_refused) {
  BOOST_TEST(problems(damped({{0, 0}, {0, "d"}})) == "");
  BOOST_TEST(problems(damped(Json::parse(R"([["q^2", "q*p"], ["q*p", "p^2"]])"))) == "");
  for (const Json& R : {Json{{0, 0}, {0, "-d"}}, Json{{1, 2}, {2, 1}}, Json{{"q", 0}, {0, 1}}})
    BOOST_TEST(problems(damped(R)).find("/system/R: is not positive semidefinite") == 0u,
               R.dump() << ": " << problems(damped(R)));
  BOOST_TEST(problems(damped({{1, 0.5}, {-0.5, 1}})).find("/system/R: is not symmetric") == 0u,
             problems(damped({{1, 0.5}, {-0.5, 1}})));
}

BOOST_AUTO_TEST_SUITE_END()
