#include "courant/running/energy_watch.hpp"

#include <boost/test/unit_test.hpp>

#include "run_in.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * short steps from a state beside the constraints have the last word on the energy
//  * late in a run nothing but such steps has a word
//  * a step whose parts lead to other energies goes on
//  * what a circuit stores when it is switched on is compared with nothing
//  * the energy of velocities that round-off made is looked at
BOOST_AUTO_TEST_SUITE(energy_watch_test)

namespace {

Json mechanical(const Json& coordinates, const char* potential, const Json& holonomic,
                const Json& initial, double step) {
  return {{"system",
           {{"type", "mechanical"},
            {"coordinates", coordinates},
            {"potential", potential},
            {"holonomic", holonomic}}},
          {"initial", initial},
          {"method", {{"type", "discretize-first"}}},
          {"time", {{"step", step}, {"end", 1}}}};
}

}  // namespace

// Method 1 leaves its states beside the constraints by its order, and shorter steps from such a state go
// from one side to the other. From the start H converges: to what it is where it is conserved, and
// where a wire that turns does work.
BOOST_AUTO_TEST_CASE(what_steps_beside_the_constraints_do_to_the_energy_is_no_finding) {
  const std::vector<Json> problems = {
      mechanical({"x", "y"}, "y", {"x^2 + y^2 - 1", "2*x^2 + 2*y^2 - 2"},
                 {{"x", 1}, {"y", 0}, {"x'", 0}, {"y'", 0}}, 0.01),
      mechanical({"x1", "y1", "x2", "y2"}, "9.81*(y1+y2)",
                 {"x1^2 + y1^2 - 1", "(x2-x1)^2 + (y2-y1)^2 - 1"},
                 {{"x1", 1},
                  {"y1", 0},
                  {"x2", 2},
                  {"y2", 0},
                  {"x1'", 0},
                  {"y1'", 0},
                  {"x2'", 0},
                  {"y2'", 0}},
                 0.002),
      mechanical({"x", "y"}, "0", {"x*sin(1.3*t) - y*cos(1.3*t)"}, {{"x", 1}, {"y", 0}, {"x'", 0}},
                 0.01)};
  for (const Json& problem : problems) {
    const TemporaryFolder folder;
    const RunOutcome outcome = run_in(folder, problem);
    BOOST_TEST((outcome.status == RunStatus::completed));
    for (const std::string& warning : outcome.summary.warnings) BOOST_TEST(warning == "");
  }
}

// H of a parametrised particle and of Jacobi's action is 0 by homogeneity: what is left of it is round-off,
// which no shorter step makes less.
BOOST_AUTO_TEST_CASE(round_off_of_an_energy_that_is_zero_is_no_finding) {
  const auto gauge = [](const Json& coordinates, const char* L, const Json& initial, double step) {
    return Json{
        {"system", {{"type", "lagrangian"}, {"coordinates", coordinates}, {"lagrangian", L}}},
        {"initial", initial},
        {"method", {{"type", "constrain-first"}}},
        {"time", {{"step", step}, {"end", 1}}}};
  };
  const std::vector<Json> problems = {
      gauge({"s", "x"}, "x'^2/(2*s') - s'*x^2/2", {{"s", 0}, {"x", 1}, {"s'", 1}, {"x'", 0.3}},
            0.05),
      gauge({"a", "b", "c"}, "sqrt((3 - (a-b)^2 - (b-c)^2)*((a'-b')^2 + (b'-c')^2 + (c'-a')^2))",
            {{"a", 0.5}, {"b", 0.2}, {"c", -0.6}, {"a'", 0.4}, {"b'", 0.7}, {"c'", -1.1}}, 0.02)};
  for (const Json& problem : problems) {
    const TemporaryFolder folder;
    const RunOutcome outcome = run_in(folder, problem);
    BOOST_TEST((outcome.status == RunStatus::completed));
    for (const std::string& warning : outcome.summary.warnings)
      BOOST_TEST(warning.find("H has changed") == std::string::npos, warning);
  }
}

// A step over a singularity of the energy ends at an H that its parts do not have.
BOOST_AUTO_TEST_CASE(a_run_ends_where_the_energy_breaks) {
  const Json fall = {
      {"system",
       {{"type", "hamiltonian"}, {"coordinates", {"x"}}, {"hamiltonian", "p_x^2/2-1/x^2"}}},
      {"initial", {{"x", 1}, {"p_x", 0}}},
      {"method", "rk4"},
      {"time", {{"step", 0.01}, {"end", 2}}}};
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, fall);
  BOOST_TEST((outcome.status == RunStatus::failed));
  // x² = 1 - 2 t²
  BOOST_TEST(outcome.summary.steps >= 70);
  BOOST_TEST(outcome.summary.steps <= 72);
  BOOST_TEST(outcome.message.find("led to H = ") != std::string::npos, outcome.message);
}

// The same with friction, which is a port: what went through it is little.
BOOST_AUTO_TEST_CASE(a_run_with_ports_ends_where_the_energy_breaks) {
  const Json fall = {{"system",
                      {{"type", "port-hamiltonian"},
                       {"coordinates", {"x", "p"}},
                       {"hamiltonian", "p^2/2-1/x^2"},
                       {"J", {{0, 1}, {-1, 0}}},
                       {"R", {{0, 0}, {0, 0.05}}}}},
                     {"initial", {{"x", 1}, {"p", 0}}},
                     {"method", "rk4"},
                     {"time", {{"step", 0.01}, {"end", 2}}}};
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, fall);
  BOOST_TEST((outcome.status == RunStatus::failed));
  BOOST_TEST(outcome.message.find("led to H = ") != std::string::npos, outcome.message);
}

// A doubler of Cockcroft and Walton, from nothing: in its second step a diode begins to conduct, and 10⁻¹⁴ J are stored of
// 3·10⁻¹¹ J that the source supplied. At the end ngspice 42 has 18.3727 V (reltol 1e-6, steps of 0.1 µs).
BOOST_AUTO_TEST_CASE(a_circuit_that_is_switched_on_goes_on) {
  const auto diode = [](const char* name, const char* from, const char* to) {
    return Json{{"type", "diode"},
                {"name", name},
                {"from", from},
                {"to", to},
                {"saturation", 1e-14},
                {"emission", 1},
                {"thermal_voltage", 0.02586492},
                {"leak", 1e-12}};
  };
  const auto linear = [](const char* type, const char* name, const char* from, const char* to,
                         const Json& value) {
    return Json{{"type", type}, {"name", name}, {"from", from}, {"to", to}, {"value", value}};
  };
  const Json doubler = {
      {"system",
       {{"type", "network"},
        {"nodes", {"0", "in", "a", "out"}},
        {"elements",
         {linear("voltage-source", "V1", "in", "0", "10*sin(2*pi*10000*t)"),
          linear("capacitor", "C1", "in", "a", 1e-7), diode("D1", "0", "a"),
          diode("D2", "a", "out"), linear("capacitor", "C2", "out", "0", 1e-7),
          linear("resistor", "RL", "out", "0", 1e5)}}}},
      {"initial", {{"q_C1", 0}, {"q_C2", 0}}},
      {"method",
       {{"type", "discretize-first"}, {"discretization", "midpoint"}, {"damping", "l-stable"}}},
      {"time", {{"step", 5e-7}, {"end", 0.002}, {"halvings", 10}}}};
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, doubler);
  BOOST_TEST((outcome.status == RunStatus::completed), outcome.message);
  BOOST_TEST(std::abs(final_value(outcome, "q_C2") / 1e-7 - 18.3727) < 0.005);
}

// Nothing moves a linkage and a molecule without forces from rest: the momenta that Newton's method leaves are 10⁻⁴⁷ and
// 10⁻⁸⁴, and H is their square.
BOOST_AUTO_TEST_CASE(the_energy_of_what_stands_still_is_no_finding) {
  const auto at_rest = [](Json system, Json initial, double step, double end) {
    system["type"] = "mechanical";
    initial["rest"] = true;
    return Json{{"system", std::move(system)},
                {"initial", std::move(initial)},
                {"start", "nearest"},
                {"method", "constrain-first"},
                {"time", {{"step", step}, {"end", end}}}};
  };
  std::vector<Json> problems = {
      at_rest({{"coordinates", {"a", "b", "c"}},
               {"holonomic",
                {"0.2*cos(a)+0.5*cos(b)-0.4*cos(c)-0.55", "0.2*sin(a)+0.5*sin(b)-0.4*sin(c)"}}},
              {{"a", 1}, {"b", 40}, {"c", -90}}, 0.01, 0.1),
      at_rest(
          {{"coordinates", {"x", "y"}}, {"metric", 2.657e-26}, {"holonomic", "x^2+y^2-(1e-10)^2"}},
          {{"x", 7e-11}, {"y", -8e-11}}, 1e-16, 1e-14)};
  problems[0]["hold"] = {"a"};
  for (const Json& problem : problems) {
    const TemporaryFolder folder;
    const RunOutcome outcome = run_in(folder, problem);
    BOOST_TEST((outcome.status == RunStatus::completed), outcome.message);
    for (const std::string& warning : outcome.summary.warnings)
      BOOST_TEST(warning.find("H has changed") == std::string::npos, warning);
  }
}

// Friction takes from H of equations, which say nothing of ports, and Method 1 leaves its states beside the constraint:
// steps of a third take as much, late in the run as well.
BOOST_AUTO_TEST_CASE(friction_is_no_finding) {
  const Json bob = {
      {"system",
       {{"type", "implicit"},
        {"parameters", {{"m", 0.5}, {"M", 1}, {"l", 0.8}, {"k", 0.1}, {"g", 9.81}}},
        {"coordinates", {"x", "y", "th", "u", "v", "w"}},
        {"unknowns", {"lam"}},
        {"equations",
         {"x' - u", "y' - v", "th' - w",
          "(M + m)*u' + m*l*cos(th)*w' - m*l*sin(th)*w^2 - lam*x + k*u",
          "(M + m)*v' + m*l*sin(th)*w' + m*l*cos(th)*w^2 + (M + m)*g + lam + k*v",
          "m*l*cos(th)*u' + m*l*sin(th)*v' + m*l^2*w' + m*g*l*sin(th)", "y - x^2/2"}},
        {"energy",
         "(M + m)/2*(u^2 + v^2) + m*l*w*(u*cos(th) + v*sin(th)) + m*l^2*w^2/2 + (M + m)*g*y - "
         "m*g*l*cos(th)"}}},
      {"initial", {{"x", 0.6}, {"y", 0.18}, {"th", 1.2}, {"u", 0}, {"v", 0}, {"w", 0}}},
      {"method", "discretize-first"},
      {"time", {{"step", 0.002}, {"end", 5}}}};
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, bob);
  BOOST_TEST((outcome.status == RunStatus::completed));
  for (const std::string& warning : outcome.summary.warnings) BOOST_TEST(warning == "");
}

// An oscillator by Heun's method: x + i p is multiplied by 1 + i h - h²/2 in a step, H by 1 + h⁴/4, which the order explains.
// After 100 steps of 0.6 H is 24 times what it was; with steps of 0.1 it is 1.02 times that.
BOOST_AUTO_TEST_CASE(an_energy_that_leaves_its_terms_is_said_though_the_order_explains_it) {
  const auto warnings = [](const char* hamiltonian, double step) {
    const TemporaryFolder folder;
    const RunOutcome outcome = run_in(
        folder, {{"system",
                  {{"type", "hamiltonian"}, {"coordinates", {"x"}}, {"hamiltonian", hamiltonian}}},
                 {"initial", {{"x", 1}, {"p_x", 1}}},
                 {"method", "rk2"},
                 {"time", {{"step", step}, {"end", 60}}}});
    BOOST_TEST((outcome.status == RunStatus::completed));
    return outcome.summary.warnings;
  };
  // From 1, and from -0.5 to 22.5.
  for (const char* hamiltonian : {"p_x^2/2 + x^2/2", "p_x^2/2 + x^2/2 - 3/2"}) {
    const std::vector<std::string> said = warnings(hamiltonian, 0.6);
    BOOST_TEST_REQUIRE(said.size() == 1u);
    BOOST_TEST(said[0].find("in steps of a third: that is the error of steps of 0.6.") !=
                   std::string::npos,
               said[0]);
    BOOST_TEST(warnings(hamiltonian, 0.1).empty());
  }
  // What a force that depends on t makes of H is none.
  BOOST_TEST(warnings("p_x^2/2 + x^2/2 - x*sin(t)", 0.1).empty());
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
