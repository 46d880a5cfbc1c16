#include "courant/running/symmetry_check.hpp"

#include <boost/test/unit_test.hpp>
#include <fstream>

#include "courant/running/check.hpp"
#include "courant/tests/core/says.hpp"
#include "problems.hpp"
#include "run_in.hpp"

// Mistakes that these cases have to notice:
//  * what is no symmetry is accepted
//  * momenta have no column (running/observed_quantities.cpp)
BOOST_AUTO_TEST_SUITE(symmetry_check)

using namespace courant;

namespace {

const Json kepler = Json::parse(R"json({
  "system": { "type": "hamiltonian", "coordinates": ["x", "y"],
              "hamiltonian": "(p_x^2 + p_y^2)/2 - 1/sqrt(x^2 + y^2)" },
  "initial": { "x": 0.4, "y": 0, "p_x": 0, "p_y": 2 },
  "method": { "type": "discretize-first" },
  "time": { "step": 0.01, "end": 1 },
  "symmetries": { "L": { "x": "-y", "y": "x" } }
})json");

// Three masses between springs with the forces of Toda's lattice, in velocities and masses of SI.
const Json chain = Json::parse(R"json({
  "system": { "type": "mechanical", "coordinates": ["q[3]"], "metric": [2, 3, 5],
              "potential": "sum(i, 0, 1, exp(q[i] - q[i+1]) + q[i+1] - q[i])" },
  "initial": { "q": [0, 0.5, -0.2], "q'": [0.7, -0.1, 0.3] },
  "method": { "type": "constrain-first" },
  "time": { "step": 0.05, "end": 10 },
  "symmetries": { "P": { "q": [1, 1, 1] } },
  "observe": { "by_velocities": "2*q[0]' + 3*q[1]' + 5*q[2]'" },
  "expect": [{ "observable": "P", "max_drift": 1e-13 }]
})json");

const Json disk = Json::parse(R"json({
  "system": { "type": "mechanical", "coordinates": ["x", "y", "phi", "theta"],
              "metric": [5, 5, 0.05, 0.1],
              "nonholonomic": ["x' - 0.2*cos(phi)*theta'", "y' - 0.2*sin(phi)*theta'"] },
  "initial": { "x": 0, "y": 0, "phi": 0, "theta": 0, "phi'": 0.9, "theta'": 8 },
  "method": { "type": "constrain-first", "projector": "momentum" },
  "time": { "step": 0.01, "end": 2 },
  "symmetries": { "turn": { "phi": 1 }, "shift": { "x": 1 } }
})json");

std::string problem_of(const Json& experiment) {
  try {
    const test::Problem read = test::problem(experiment);
    check_symmetries(read.experiment, read.ladder);
  } catch (const ExperimentError& error) {
    return error.what();
  }
  return "";
}
Json with(Json experiment, const std::string& pointer, const Json& value) {
  experiment[Json::json_pointer(pointer)] = value;
  return experiment;
}
}  // namespace

BOOST_AUTO_TEST_CASE(momenta_are_observed) {
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, kepler);
  const QuantityRecord* L = outcome.summary.observable("L");
  BOOST_REQUIRE(L != nullptr);
  BOOST_TEST(std::fabs(L->initial - 0.8) < 1e-15);
  BOOST_TEST(L->max_drift < 1e-13);
  BOOST_REQUIRE(outcome.summary.symmetries.size() == 1u);
  BOOST_TEST(outcome.summary.symmetries[0].second.is_conserved);
  std::ifstream file(folder / "run" / "trajectory.csv");
  std::string heads;
  std::getline(file, heads);
  BOOST_TEST(heads == "t,x,y,p_x,p_y,H,L");
  const RunSummary again = read_run_summary(to_json(outcome.summary));
  BOOST_REQUIRE(again.symmetries.size() == 1u);
  BOOST_TEST(again.symmetries[0].first == "L");
  BOOST_TEST(again.symmetries[0].second.is_conserved);
}

BOOST_AUTO_TEST_CASE(translations_of_a_chain) {
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, chain);
  BOOST_TEST(outcome.as_expected());
  const double sum = outcome.summary.observable("by_velocities")->initial;
  BOOST_TEST(std::fabs(outcome.summary.observable("P")->initial - sum) < 1e-14);
}

BOOST_AUTO_TEST_CASE(untrue_symmetries_are_one_clear_line) {
  const std::string shift = problem_of(with(kepler, "/symmetries", {{"T", {{"x", 1}}}}));
  BOOST_TEST(says(shift, "/symmetries/T: is no symmetry: the energy is not invariant, but off by "),
             shift);
  BOOST_TEST(says(shift, " at x = ("), shift);
  BOOST_TEST(!says(shift, "\n"), shift);
  const std::string one = problem_of(with(chain, "/symmetries", {{"P", {{"q[1]", 1}}}}));
  BOOST_TEST(says(one, "/symmetries/P: is no symmetry: the energy"), one);
  Json pendulum = test::experiment_file("spherical_pendulum");
  pendulum["expect"] = Json::array();
  const std::string off = problem_of(with(pendulum, "/symmetries", {{"P", {{"x", {1, 0, 0}}}}}));
  BOOST_TEST(says(off, "/symmetries/P: is no symmetry: the generator is not tangent to Sphere(2"),
             off);
  // A run does not begin.
  const TemporaryFolder folder;
  BOOST_CHECK_THROW(run_in(folder, with(kepler, "/symmetries", {{"T", {{"x", 1}}}})),
                    ExperimentError);
}

BOOST_AUTO_TEST_CASE(mistakes_of_the_declaration) {
  const auto said = [&](const Json& symmetries) {
    return problem_of(with(kepler, "/symmetries", symmetries));
  };
  BOOST_TEST(says(said({{"L", {{"z", 1}}}}), "/symmetries/L/z: key, "));
  BOOST_TEST(says(said({{"L", {{"p_x", 1}}}}), "/symmetries/L/p_x: key, "));
  BOOST_TEST(says(said({{"L", {{"x", "-p_y"}}}}), "unknown name \"p_y\""));
  BOOST_TEST(says(said({{"L", {{"x", {1, 2}}}}}), "has 2 formulas; expected 1 for \"x\""));
  BOOST_TEST(says(said({{"L", Json::object()}}), "/symmetries/L: moves nothing"));
  BOOST_TEST(says(said({{"L z", {{"x", 1}}}}), "/symmetries/L z: key, "));
  BOOST_TEST(says(said({{"x", {{"x", 1}}}}), "/symmetries/x: key, "));
  BOOST_TEST(says(said({{"H", {{"x", 1}}}}), "/symmetries/H: key, "));
  BOOST_TEST(says(problem_of(with(kepler, "/observe", {{"L", "x"}})), "/observe/L: key, "));
  Json flat = kepler;
  flat["system"] =
      Json::parse(R"json({"type": "hamiltonian", "coordinates": ["x", "y", "p_x", "p_y"],
    "hamiltonian": "x", "structure": {"type": "two-form", "matrix": "canonical"}})json");
  BOOST_TEST(says(problem_of(flat), "/symmetries: need a cotangent bundle"), problem_of(flat));
  BOOST_TEST(says(problem_of(with(chain, "/symmetries", {{"P", {{"q", {1, 1, 1}}, {"q[0]", 1}}}})),
                  "given twice"));
}

BOOST_AUTO_TEST_CASE(reactions_are_said_in_words) {
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, disk);
  const auto& found = outcome.summary.symmetries;
  BOOST_REQUIRE(found.size() == 2u);
  BOOST_TEST(found[0].second.is_conserved);
  BOOST_TEST(found[0].second.remark.empty());
  BOOST_TEST(!found[1].second.is_conserved);
  BOOST_TEST(says(found[1].second.remark,
                  "shift is not expected to be conserved: the energy is invariant, but along the "
                  "symmetry there acts the reaction of \"x' - 0.2*cos(phi)*theta'\""),
             found[1].second.remark);
  BOOST_TEST(outcome.summary.observable("turn")->max_drift < 1e-14);
  BOOST_TEST(outcome.summary.observable("shift")->max_drift > 1.0);
}

// On rotations by the matrix R' of a turn of space, and by components in the body.
BOOST_AUTO_TEST_CASE(generators_on_a_group) {
  Json top = test::experiment_file("heavy_top_so3");
  top["system"]["parameters"]["I"] = {1.0, 1.0, 0.6};
  top["system"]["parameters"]["w"] = {0.0, 0.0, 1.0};
  top["symmetries"]["axis"] = {{"v_R", {0, 0, 1}}};
  top["time"]["end"] = 0.05;
  top["expect"] = Json::array();
  BOOST_TEST(problem_of(top) == "", problem_of(top));
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, top);
  BOOST_TEST(std::fabs(outcome.summary.observable("axis")->initial - 2.0) < 4e-15);
  BOOST_TEST(outcome.summary.observable("axis")->max_drift < 1e-13);
  top["system"]["parameters"]["I"] = {1.0, 1.2, 0.6};
  BOOST_TEST(says(problem_of(top), "/symmetries/axis: is no symmetry: the energy"));
}

// Quadratic momenta are kept by equivariant maps; the explicit method and the map that knows
// nothing of rotations do not keep them.
BOOST_AUTO_TEST_CASE(check_says_whether_the_method_keeps_them) {
  const auto kept = [](const Json& experiment) {
    return check_experiment(read_experiment(experiment.dump())).at("symmetries").at(0);
  };
  const Json midpoint = kept(kepler);
  BOOST_TEST(midpoint.at("conserved").get<bool>());
  BOOST_TEST(midpoint.at("kept").get<bool>());
  BOOST_TEST(midpoint.at("drift").get<double>() < 1e-14);
  const Json rk2 = kept(with(kepler, "/method", {{"type", "rk2"}}));
  BOOST_TEST(rk2.at("conserved").get<bool>());
  BOOST_TEST(!rk2.at("kept").get<bool>());
  BOOST_TEST(rk2.at("drift").get<double>() > 1e-8);
  Json without = kepler;
  without.erase("method");
  without.erase("time");
  BOOST_TEST(kept(without).at("kept").is_null());
}

BOOST_AUTO_TEST_SUITE_END()
