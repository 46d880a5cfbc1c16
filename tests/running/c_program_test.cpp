#include "courant/running/c_program.hpp"

#include <bit>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>
#include <sstream>

#include "c_runs.hpp"
#include "courant/core/words/message.hpp"
#include "courant/running/c_program_text.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * a step of redundant equations is written, and solved as if it were regular
//    (running/c_functions.cpp)
//  * a title ends the comment that it is in (running/c_functions.cpp)
//  * the fifth stage of Dormand and Prince in C is another one
//    (integrators/methods/explicit_runge_kutta.cpp)
//  * a composition in C is its middle method (integrators/methods/composition.cpp)
//  * steps in C choose the degrees of their predictions at other times
//    (integrators/step/predictor.cpp)
//  * programs know no second attempt (running/c_program/looks.c)
//  * programs end on the bits that their own way leads to (running/c_program/looks.c)
//  * a curve that Newton's method does not begin is given up (running/c_program/looks.c)
//  * programs measure displacements in one basis by those of another (running/c_program/looks.c)
//  * programs find velocities in the first units alone (running/c_program/field.c)
//  * programs without exponentials hold what is for these
//  * a second attempt ends on the bits that its curve leads to (integrators/step/step_solver.cpp)
//  * programs take the first of the columns for the longest (running/c_program/longest_column.c)
//  * programs let points leave the space (running/c_program/round_off.c)
//  * programs keep the combination of directions of the first step (running/c_program/turning.c)
//  * programs look for conormals near one reference alone (running/c_program/turning.c)
//  * programs project once, whatever the directions become (running/c_program/projected_part.c)
//  * programs make bases orthonormal to first order (running/c_program/orthonormal.c)
//  * programs measure velocities in the basis of the point before (running/c_rows.cpp)
//  * the basis of the velocities that programs measure goes on where an epoch begins
//    (running/c_rows.cpp)
BOOST_AUTO_TEST_SUITE(c_programs)

namespace {

using test::CRun;
using test::rows_of_run;
using test::run_c;

Json experiment_named(const std::string& name) {
  return Json::parse(read_text("experiments/" + name + ".json"), nullptr, true, true);
}

void check_same_bytes(const std::string& name, const Json& experiment) {
  const TemporaryFolder folder;
  const CRun program = run_c(folder, experiment);
  BOOST_TEST(program.compiler == "", name);
  BOOST_TEST(program.status == 0, name << ": " << program.err);
  const std::string rows = rows_of_run(folder, experiment);
  BOOST_TEST(std::count(rows.begin(), rows.end(), '\n') > 2, name);
  BOOST_TEST((program.out == rows), name << ": other bytes");
}

std::string refusal(const Json& experiment) {
  try {
    c_program(read_experiment(experiment.dump()));
  } catch (const ExperimentError& error) {
    return error.problems().front().where + ": " + error.problems().front().what;
  }
  return "";
}

const Json oscillator = Json::parse(R"json({
  "title": "A title with a */ in it, \"quotes\" and ??/",
  "system": { "type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "(p_q^2 + q^4)/2" },
  "initial": { "q": 1, "p_q": 0 },
  "method": { "type": "discretize-first" },
  "time": { "step": 0.03, "end": 30 },
  "observe": { "speed": "q'" },
  "output": { "units": { "q": "m" } }
})json");

}  // namespace

// Regular and with constraints; energies through ports; substeps; steps that evaluate a field; spaces with equations of
// their own, and with bases; directions that change.
BOOST_AUTO_TEST_CASE(programs_write_the_bytes_of_runs) {
  for (const char* name :
       {"point_vortices", "point_vortices_hamiltonian", "point_vortices_lagrangian_method1",
        "discrete_gradient_ports", "discrete_gradient_holonomic", "port_hamiltonian_open",
        "kepler_order_8", "point_vortices_rk2", "rigid_body", "geodesic_so3", "spherical_pendulum",
        "pendulum_cartesian", "chaplygin_sleigh", "suslov_euler_poincare"})
    check_same_bytes(name, experiment_named(name));
  check_same_bytes("oscillator", oscillator);
}

// With the bytes after it: what is forgotten there is forgotten by both.
BOOST_AUTO_TEST_CASE(programs_forget_where_runs_do) {
  Json vortices = experiment_named("point_vortices_hamiltonian");
  vortices["time"] = {{"step", 0.1}, {"end", 450}};  // an epoch is 4096 steps
  vortices["output"] = {{"every", 50}};
  check_same_bytes("vortices", vortices);
  for (const char* type : {"rk2", "rk4", "dopri5", "rkf78", "discretize-first"}) {
    Json experiment = oscillator;
    experiment["method"] = {{"type", type}};
    experiment["output"]["epoch"] = 37;
    check_same_bytes(type, experiment);
  }
  Json constrained = experiment_named("point_vortices");
  constrained["time"] = {{"step", 0.2}, {"end", 60}};
  constrained["output"] = {{"epoch", 70}};
  constrained.erase("expect");
  check_same_bytes("Method 2", constrained);
  constrained["method"]["order"] = 4;
  check_same_bytes("Method 2 of order 4", constrained);
  // Bases and directions are made afresh there, wherever the state is.
  for (const auto& [name, epoch] :
       {std::pair("rigid_body", 37), std::pair("geodesic_sphere", 23),
        std::pair("heavy_top_constrained", 19), std::pair("suslov_euler_poincare", 13)}) {
    Json curved = experiment_named(name);
    curved.erase("expect");
    curved["output"]["epoch"] = epoch;
    check_same_bytes(name, curved);
  }
  Json velocity = experiment_named("rigid_body");
  velocity.erase("expect");
  velocity["observe"] = {{"turn", "xi[0]' + xi[2]'"}};
  velocity["time"] = {{"step", 0.07}, {"end", 21}};
  velocity["output"] = {{"epoch", 37}};
  check_same_bytes("velocities on a sphere", velocity);
  for (const char* name : {"pendulum_cartesian", "spherical_pendulum_constrained"}) {
    Json composed = experiment_named(name);
    composed.erase("expect");
    composed["output"]["epoch"] = 41;
    composed["method"]["order"] = 4;
    check_same_bytes(name, composed);
  }
  Json free = oscillator;
  free["method"] = {{"type", "constrain-first"}};
  free["output"]["epoch"] = 100;
  check_same_bytes("Method 2 without constraints", free);
  for (const int order : {2, 8}) {
    Json halves = oscillator;
    halves["method"]["discretization"] = "verlet";
    halves["method"]["order"] = order;
    halves["output"]["epoch"] = 100;
    check_same_bytes("verlet", halves);
  }
  Json composed = oscillator;
  composed["method"]["order"] = 6;
  composed["output"]["epoch"] = 100;
  check_same_bytes("order 6", composed);
}

BOOST_AUTO_TEST_CASE(starts_that_people_use_are_exported_too) {
  Json at_rest = oscillator;
  at_rest["initial"] = {{"q", 0}, {"p_q", 0}};
  check_same_bytes("at rest", at_rest);
  Json in_si = oscillator;
  in_si["system"]["hamiltonian"] = "p_q^2/(2*1e-27) + 1e3*q^2/2";
  in_si["initial"] = {{"q", 1e-10}, {"p_q", 0}};
  in_si["time"] = {{"step", 1e-16}, {"end", 3e-14}};
  check_same_bytes("atoms", in_si);
  Json forced = oscillator;
  forced["system"]["hamiltonian"] = "p_q^2/2 - cos(q) - q*sin(3*t)";
  forced["time"]["start"] = 2.5;
  forced["time"]["end"] = 32.5;
  check_same_bytes("forced", forced);
}

// The fewest digits that read back, in all sizes, and next to powers of two.
BOOST_AUTO_TEST_CASE(numbers_are_written_as_the_library_does) {
  std::vector<double> numbers = {0.0, -0.0, 1.0, 0.1, -0.3, 1e5, 123456.0, 1e6, 1e22, 1e23, 5e-324};
  for (int exponent = -1074; exponent < 1024; ++exponent) {
    const double power = std::ldexp(1.0, exponent);
    for (const double number :
         {power, -std::nextafter(power, 0.0), std::nextafter(power, 2 * power)})
      numbers.push_back(number);
  }
  for (int exponent = -30; exponent < 30; ++exponent)
    for (const double digits : {1.0, 3.0, 12.0, 1.0 / 3.0, 1234567.0})
      numbers.push_back(digits * std::pow(10.0, exponent));
  std::mt19937_64 generator(1);
  for (int i = 0; i < 20'000; ++i) {
    const auto number = std::bit_cast<double>(generator());
    if (std::isfinite(number)) numbers.push_back(number);
  }
  std::ostringstream source, expected;
  source << "#include <math.h>\n#include <stdio.h>\n#include <stdlib.h>\n#include <string.h>\n"
            "static long step_number = 0;\n"
         << c_program_text::numbers() << "static const double numbers[] = {";
  for (const double number : numbers) {
    source << std::hexfloat << number << ",\n";
    expected << exact_text(number) << '\n';
  }
  source << "};\nint main(int count, char **words) {\n  int i;\n"
            "  if (count > 1) fail(words[1]);\n"
            "  for (i = 0; i < "
         << std::to_string(numbers.size())
         << "; ++i) {\n    write_number(numbers[i]);\n    putchar('\\n');\n  }\n  return 0;\n}\n";
  const TemporaryFolder folder;
  const CRun program = run_c(folder, source.str());
  BOOST_TEST(program.compiler == "");
  BOOST_TEST(program.status == 0);
  std::istringstream found(program.out), right(expected.str());
  int wrong = 0;
  for (std::string a, b; std::getline(right, b);)
    if (!std::getline(found, a) || a != b)
      if (++wrong < 5) BOOST_TEST(a == b);
  BOOST_TEST(wrong == 0);
}

// It says what it is.
BOOST_AUTO_TEST_CASE(the_head_explains_the_program) {
  const std::string source = c_program(read_experiment(oscillator.dump()));
  for (const char* words :
       {"/* A title with a * / in it", "Written by courant ", "cc -std=c99 -O2 -ffp-contract=off",
        "discretize-first", "2 equations for 2 unknowns", "x = (q, p_q)", "int main(void)",
        "\"t,q [m],p_q,H,speed\""})
    BOOST_TEST(source.find(words) != std::string::npos, words);
}

// A diode begins to conduct within a step, which Newton's method does not solve at once: the program goes along smaller
// steps to its solution, as a run goes along its curve, and both end on the same bits. A velocity is not found at once
// either, at rest with transistors.
BOOST_AUTO_TEST_CASE(steps_and_velocities_are_found_in_second_attempts) {
  Json rectifier = experiment_named("network_rectifier");
  rectifier.erase("expect");
  rectifier["time"]["end"] = 0.0109;  // from 0.01076 on it blocks
  check_same_bytes("rectifier that blocks", rectifier);
  rectifier["time"] = {{"step", 1e-4}, {"end", 1e-2}};
  check_same_bytes("rectifier in long steps", rectifier);
  Json amplifier = experiment_named("network_transistor_amplifier");
  amplifier.erase("expect");
  amplifier["time"]["end"] = 4e-3;
  check_same_bytes("amplifier", amplifier);
}

// What looks at exponentials is written where there are some.
BOOST_AUTO_TEST_CASE(programs_hold_what_they_may_need) {
  const auto approaches = [](const Json& experiment) {
    return c_program(read_experiment(experiment.dump())).find("static int approach(") !=
           std::string::npos;
  };
  BOOST_TEST(approaches(experiment_named("network_rectifier")));
  BOOST_TEST(!approaches(oscillator));
}

// A step that needs more than Newton's method ends the program before its row.
BOOST_AUTO_TEST_CASE(what_is_left_to_a_run_ends_the_program) {
  Json runaway = oscillator;
  runaway["system"] = {
      {"type", "implicit"}, {"coordinates", {"x"}}, {"equations", {"x' - 1 - x^2"}}};
  runaway["initial"] = {{"x", 0}};
  runaway["time"] = {{"step", 0.4}, {"end", 4}};
  runaway.erase("observe");
  runaway.erase("output");
  const TemporaryFolder folder;
  const CRun program = run_c(folder, runaway);
  BOOST_TEST(program.compiler == "");
  BOOST_TEST(program.status == 3);
  BOOST_TEST(program.err.find("step ") == 0u, program.err);
  BOOST_TEST(program.err.find("`courant run` may know another way") != std::string::npos);
  const std::string rows = rows_of_run(folder, runaway);
  BOOST_TEST(rows.find(program.out) == 0u);
}

BOOST_AUTO_TEST_CASE(what_has_no_program_is_refused_by_name) {
  BOOST_TEST(refusal(experiment_named("heavy_top_reduced")).find("/method: cannot be exported: ") ==
             0u);
  BOOST_TEST(
      refusal(experiment_named("geodesic_stiefel")).find("operations, which takes a compiler") !=
      std::string::npos);
  BOOST_TEST(refusal(experiment_named("toda_lattice")) ==
             "/method: cannot be exported: solves 200 equations together; expected at most 63 in "
             "a program in C");
  BOOST_TEST(refusal(experiment_named("rolling_disk")).find("least squares") != std::string::npos);
  BOOST_TEST(refusal(experiment_named("martinet_abnormal")).find("/method: is missing") == 0u);
  Json between = oscillator;
  between["output"] = {{"at", {0.1}}};
  BOOST_TEST(refusal(between).find("/output/at: ") == 0u);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
