#include <boost/test/unit_test.hpp>

#include "courant/running/check.hpp"
#include "courant/tests/core/says.hpp"
#include "problems.hpp"
#include "run_in.hpp"

BOOST_AUTO_TEST_SUITE(reduced_runs)

using namespace courant;

namespace {

const Json rigid_body = Json::parse(R"json({
  "system": { "type": "euler-poincare", "algebra": "so3",
              "lagrangian": "(xi[0]^2 + 2*xi[1]^2 + 0.7*xi[2]^2)/2" },
  "initial": { "mu": [0.8, -0.5, 0.6] },
  "method": { "type": "reduced" },
  "time": { "step": 0.1, "end": 2 }
})json");

Json with(Json experiment, const std::string& pointer, const Json& value) {
  experiment[Json::json_pointer(pointer)] = value;
  return experiment;
}
}  // namespace

// The same top on T*SO(3) and on the dual of so(3) ⋉ R³, with the same steps.
BOOST_AUTO_TEST_CASE(heavy_top_reduced_and_not) {
  const test::Problem reduced = test::problem(test::experiment_file("heavy_top_reduced"));
  const test::Problem whole = test::problem(test::experiment_file("heavy_top_so3"));
  const VectorXd x = reduced.end({{"type", "reduced"}}, 5.0, 1000);
  const VectorXd y = whole.end(test::method_1("cayley"), 5.0, 1000);
  BOOST_TEST((x.tail(9) - y.head(9)).norm() < 1e-11);
  BOOST_TEST((x.head(3) - y.tail(3)).norm() < 1e-11);
  // Another map is another method of the same order.
  const VectorXd z =
      reduced.end({{"type", "reduced"}, {"discretization", "exponential"}}, 5.0, 1000);
  BOOST_TEST((x - z).norm() > 1e-8);
  BOOST_TEST((x - z).norm() < 1e-2);
  const Json fourth = {{"type", "reduced"}, {"order", 4}};
  const VectorXd exact = reduced.end(fourth, 5.0, 2000);
  BOOST_TEST(std::fabs(reduced.order({{"type", "reduced"}}, 5.0, exact, 0, {100, 200, 400, 800}) -
                       2.0) < 0.15);
}

BOOST_AUTO_TEST_CASE(check_measures_a_poisson_map) {
  const Json report = check_experiment(read_experiment(rigid_body.dump()));
  BOOST_TEST(report.at("passed").get<bool>());
  BOOST_TEST(report.at("method").at("structure_defect").get<double>() < 1e-9);
  const Json midpoint = check_experiment(
      read_experiment(with(rigid_body, "/method", {{"type", "discretize-first"}}).dump()));
  BOOST_TEST(midpoint.at("method").at("structure_defect").get<double>() > 1e-7);
}

// A hamiltonian system with the structure by name, and what acts on what.
BOOST_AUTO_TEST_CASE(structures_by_name) {
  const Json top = Json::parse(R"json({
    "system": { "type": "hamiltonian", "coordinates": ["P[3]", "G[3]"],
                "structure": { "type": "lie-poisson", "algebra": "so3", "representation":
                  [[[0, 0, 0], [0, 0, -1], [0, 1, 0]], [[0, 0, 1], [0, 0, 0], [-1, 0, 0]],
                   [[0, -1, 0], [1, 0, 0], [0, 0, 0]]] },
                "hamiltonian": "(P[0]^2 + P[1]^2/1.2 + P[2]^2/0.6)/2 + 0.1*G[0] + 0.2*G[1] + G[2]" },
    "initial": { "P": [0.3, -0.2, 2.0], "G": [0.19038, 0.61544, 0.76484] } })json");
  const VectorXd x = test::problem(top).end({{"type", "reduced"}}, 1.0, 100);
  Json reduced = test::experiment_file("heavy_top_reduced");
  reduced["initial"]["Gamma"] = {0.19038, 0.61544, 0.76484};
  const VectorXd y = test::problem(reduced).end({{"type", "reduced"}}, 1.0, 100);
  BOOST_TEST((x - y.head(6)).norm() < 1e-12);
}

BOOST_AUTO_TEST_CASE(what_does_not_fit_is_said) {
  const std::string other = problem_of_run(Json::parse(R"json({
    "system": { "type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "p_q^2/2" },
    "initial": { "q": 0, "p_q": 1 }, "method": "reduced", "time": { "step": 0.1, "end": 1 } })json"));
  BOOST_TEST(says(other, "/method: \"reduced\" is for Lie-Poisson structures"), other);
  const auto system = [](const char* key, const Json& value) {
    return problem_of_run(with(rigid_body, std::string("/system/") + key, value));
  };
  BOOST_TEST(says(system("attitude", {"R[3]"}),
                  "/system/attitude: names 3 numbers; expected 9, those of a point of "));
  BOOST_TEST(says(system("attitude", {"mu[3][3]"}), "/system/attitude"));
  Json plus = with(rigid_body, "/system/attitude", {"R[3][3]"});
  plus["system"]["sign"] = "plus";
  BOOST_TEST(says(problem_of_run(plus), "/system/attitude: is for left-invariant systems"));
  // so(3) in a basis of another length has its adjoint group; what has a centre, and no matrices, has none.
  Json basis = rigid_body;
  basis["system"].erase("algebra");
  basis["system"]["constants"] = {{{0, 0, 0}, {0, 0, 2}, {0, -2, 0}},
                                  {{0, 0, -2}, {0, 0, 0}, {2, 0, 0}},
                                  {{0, 2, 0}, {-2, 0, 0}, {0, 0, 0}}};
  BOOST_TEST(problem_of_run(basis) == "");
  basis["system"].erase("constants");
  basis["system"]["basis"] = {"X", "Y", "Z"};
  basis["system"]["brackets"] = {{"X,Y", "Z"}};
  BOOST_TEST(says(problem_of_run(basis),
                  "/method: no group is known for the Lie algebra g, by its matrices or those of "
                  "its adjoint representation; expected "
                  "an algebra with a name, or one of \"matrices\""));
  const std::string map = problem_of_run(with(rigid_body, "/method/discretization", "chordal"));
  BOOST_TEST(says(map, "/method: the discretization \"chordal\" is for spheres"), map);
}

BOOST_AUTO_TEST_SUITE_END()
