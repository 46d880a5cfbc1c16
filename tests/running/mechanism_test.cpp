// Mechanisms: the same by joint and by absolute coordinates, with the reactions, energies and redundancies that they have.
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/running/ladder_report.hpp"
#include "problems.hpp"
#include "run_in.hpp"

// Mistakes that these cases have to notice:
//  * a multiplier's sign, or the point that its torque is about (structures/joint_reactions.cpp)
//  * a redundant condition is another joint's, or counted twice (running/ladder_report.cpp)
//  * dampers that give energy, forces of springs that are not those of their potential (structures/mechanism.cpp)
//  * numbers of a mechanism do not follow its parameters (reading/mechanism_model.cpp)
//  * coordinates that nobody gave begin at 0, which no rotation is (reading/initial_values.cpp)
//  * a search that comes to no point in its own units outweighs one that did in those of the experiment
//    (running/consistent_start.cpp)
BOOST_AUTO_TEST_SUITE(mechanism)

using namespace courant;
using test::experiment_file;
using test::Problem;

namespace {

Json four_bar(const char* coordinates) {
  Json experiment = experiment_file("mechanism_four_bar");
  experiment["system"]["coordinates"] = coordinates;
  experiment.erase("hold");
  experiment["observe"] = Json::object();
  for (const char* name : {"coupler.x", "coupler.y", "coupler.w[2]", "T", "V", "A'"})
    experiment["observe"][std::string("o") + std::to_string(experiment["observe"].size())] = name;
  for (const char* joint : {"A", "B", "C", "D"})
    for (const char* part : {"f_%[0]", "f_%[1]", "m_%[2]"}) {
      std::string formula = part;
      formula.replace(formula.find('%'), 1, joint);
      experiment["observe"][std::string("r") + std::to_string(experiment["observe"].size())] =
          formula;
    }
  experiment["time"] = {{"step", 0.001}, {"end", 0.1}};
  experiment.erase("expect");
  experiment["output"] = {{"every", 1}};
  return experiment;
}

std::vector<std::pair<std::string, double>> observed(const Json& experiment) {
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, experiment);
  std::vector<std::pair<std::string, double>> all;
  for (const auto& [name, quantity] : outcome.summary.observables)
    if (experiment["observe"].contains(name)) all.emplace_back(name, quantity.final);
  return all;
}

}  // namespace

// The reactions at joints in the plane of the linkage are determined: nothing is redundant there.
BOOST_AUTO_TEST_CASE(both_kinds_of_coordinates_move_alike) {
  const auto joint = observed(four_bar("joint")), absolute = observed(four_bar("absolute"));
  BOOST_TEST(joint.size() == 18U);
  BOOST_TEST_REQUIRE(joint.size() == absolute.size());
  for (std::size_t i = 0; i < joint.size(); ++i) {
    BOOST_TEST(joint[i].first == absolute[i].first);
    // Both are of order 2, with h = 10⁻³ and angular velocities of about 5.
    BOOST_TEST(
        std::abs(joint[i].second - absolute[i].second) < 2e-4 * (1.0 + std::abs(joint[i].second)),
        joint[i].first << " " << joint[i].second << " " << absolute[i].second);
  }
}

BOOST_AUTO_TEST_CASE(redundant_conditions_are_of_the_joint_that_closes_the_loop) {
  const auto redundant = [](const Json& experiment) {
    const Problem found = test::problem(experiment);
    BOOST_TEST((found.ladder.verdict == Verdict::regular));
    BOOST_TEST(found.ladder.degrees_of_freedom == 2);
    Json list = Json::array();
    const auto report = ladder_report(found.ladder, *found.experiment.model.system);
    for (const auto& [joint, conditions, of] : report.end->redundant_joints)
      list.push_back({joint, conditions, of});
    BOOST_TEST(Json(to_json(report))["redundant"].size() == list.size());
    return list.dump();
  };
  BOOST_TEST(redundant(four_bar("joint")) == R"([["C",3,5]])");
  BOOST_TEST(redundant(four_bar("absolute")) == R"([["C",3,5]])");
  BOOST_TEST(redundant(experiment_file("mechanism_bennett")) == R"([["D",3,5]])");
  BOOST_TEST(redundant(experiment_file("mechanism_slider_crank")) == "[]");
}

// The other bodies go where the crank leaves them.
BOOST_AUTO_TEST_CASE(a_crank_is_set_in_absolute_coordinates) {
  Json experiment = experiment_file("mechanism_four_bar_absolute");
  experiment["initial"] = {{"A", 0.5}, {"rest", true}};
  const Problem linkage = test::problem(experiment);
  BOOST_TEST((linkage.ladder.verdict == Verdict::regular), linkage.ladder.reason);
  BOOST_TEST(linkage.ladder.moves.empty());
}

// A rotation that is given by its vector, and velocities along the axes of the body.
BOOST_AUTO_TEST_CASE(a_rotation_vector_is_a_start) {
  Json experiment = Json::parse(R"({"system": {"type": "mechanism", "gravity": [0, 0, -9.81],
    "bodies": {"b": {"mass": 1, "center": [0, 0, 0.3], "inertia": [0.1, 0.1, 0.05, 0, 0, 0]}},
    "joints": {"A": {"type": "spherical", "parent": "ground", "child": "b"}}},
    "initial": {"A[0]": 0.5, "A[1]": 0, "A[2]": 0, "b.w[2]": 30, "b.w[0]": 0, "b.w[1]": 0}})");
  const VectorXd expected{
      {1, 0, 0, 0, std::cos(0.5), -std::sin(0.5), 0, std::sin(0.5), std::cos(0.5), 0, 0, 1.5}};
  BOOST_TEST((test::problem(experiment).ladder.point.x - expected).norm() < 1e-12);
  experiment["initial"] = {{"A", {0.5, 0, 0}}, {"b.w", {0, 0, 30}}};
  BOOST_TEST((test::problem(experiment).ladder.point.x - expected).norm() < 1e-12);
  experiment["initial"] = {{"A", {0.5, 0}}};
  BOOST_CHECK_THROW(test::problem(experiment), ExperimentError);
  experiment["initial"] = "rest";
  BOOST_TEST(test::problem(experiment).ladder.point.x ==
             (VectorXd{{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}}));
}

// Two cranks on perpendicular axes and a coupler between balls, which lie in a line where nothing has moved: the coupler is 0.2
// too short to reach the second one there, and its ends are at one place where that stands upright.
BOOST_AUTO_TEST_CASE(links_in_a_line_come_together) {
  Json experiment = Json::parse(R"({"system": {"type": "mechanism",
    "bodies": {"in": {"mass": 1, "center": [0.1, 0, 0], "inertia": [0.01, 0.01, 0.01, 0, 0, 0]},
               "coupler": {"mass": 1, "inertia": [0.01, 0.01, 0.01, 0, 0, 0]},
               "out": {"mass": 1, "center": [0.15, 0, 0], "inertia": [0.01, 0.01, 0.01, 0, 0, 0]}},
    "joints": {"A": {"type": "revolute", "parent": "ground", "child": "in", "axis": [0, 0, 1]},
               "S": {"type": "spherical", "parent": "in", "child": "coupler", "origin": {"xyz": [0.2, 0, 0]}},
               "D": {"type": "revolute", "parent": "ground", "child": "out", "origin": {"xyz": [0.6, 0, 0]}, "axis": [0, 1, 0]},
               "E": {"type": "spherical", "parent": "coupler", "child": "out", "origin": {"xyz": [0.5, 0, 0]},
                     "child_origin": {"xyz": [0.3, 0, 0]}}}},
    "initial": {"A": 0, "rest": true}})");
  const Problem linkage = test::problem(experiment);
  BOOST_TEST((linkage.ladder.verdict == Verdict::regular), linkage.ladder.reason);
  BOOST_TEST(linkage.ladder.degrees_of_freedom == 4);
  // A, R_S, D.
  BOOST_TEST(linkage.ladder.point.x[0] == 0.0);
  BOOST_TEST(std::abs(std::cos(linkage.ladder.point.x[10])) < 1e-12);
}

// A joint's load is the weight, and the moment of a weight ahead of a joint that a spring or a motor holds.
BOOST_AUTO_TEST_CASE(a_held_beam_weighs_on_its_joint) {
  const auto load = [](const char* joint, const char* coordinates = "joint") {
    Json experiment = Json::parse(R"({"system": {"type": "mechanism", "gravity": [0, 0, -9.81],
      "bodies": {"beam": {"mass": 2, "center": [0.5, 0, 0], "inertia": [0.1, 0.1, 0.1, 0, 0, 0]},
                 "load": {"mass": 3, "inertia": [0.1, 0.1, 0.1, 0, 0, 0]}},
      "joints": {"A": {"type": "revolute", "parent": "ground", "child": "beam", "origin": {"xyz": [0.1, 0, 0]}, "axis": [0, 1, 0]},
                 "B": {"type": "fixed", "parent": "beam", "child": "load", "origin": {"xyz": [1, 0.2, 0]}}}},
      "initial": "rest", "method": "constrain-first", "time": {"step": 0.001, "end": 0.001},
      "observe": {"o0": "f_A[0]", "o1": "f_A[1]", "o2": "f_A[2]", "o3": "m_A[0]", "o4": "m_A[1]", "o5": "m_A[2]", "o6": "f_B[2]"}})");
    experiment["system"]["joints"]["A"].update(Json::parse(joint));
    experiment["system"]["coordinates"] = coordinates;
    const TemporaryFolder folder;
    VectorXd found(7);
    Index i = 0;
    for (const auto& [name, quantity] : run_in(folder, experiment).summary.observables)
      if (name.starts_with("o")) found[i++] = quantity.initial;
    return found;
  };
  const double g = 9.81;
  const VectorXd expected{{0, 0, 5 * g, 3 * g * 0.2, -(2 * g * 0.5 + 3 * g), 0, 3 * g}};
  // The motor turns about y, against the weight.
  BOOST_TEST((load(R"j({"torque": "-9.81*4"})j") - expected).norm() < 1e-10);
  BOOST_TEST((load(R"j({"stiffness": 100, "rest": "-9.81*4/100"})j") - expected).norm() < 1e-10);
  BOOST_TEST((load(R"j({"torque": "-9.81*4"})j", "absolute") - expected).norm() < 1e-10);
  BOOST_TEST((load(R"j({"type": "fixed"})j", "absolute") - expected).norm() < 1e-10);
}

BOOST_AUTO_TEST_SUITE_END()
