#include "courant/running/structure_description.hpp"

#include <boost/test/unit_test.hpp>

#include "problems.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * open ports are a Dirac structure as closed ones are
BOOST_AUTO_TEST_SUITE(structure_description_test)

namespace {

struct Described {
  explicit Described(const char* file)
      : problem(test::problem(test::experiment_file(file))),
        structure(*problem.experiment.model.system->structure()) {
    const VectorXd& x = problem.ladder.point.x;
    points = {x, VectorXd(1.1 * x)};
  }
  Json json() const {
    return structure_description("inner", structure, points,
                                 problem.experiment.model.system->names().coordinates);
  }

  test::Problem problem;
  const DiracStructure& structure;
  std::vector<VectorXd> points;
};

}  // namespace

BOOST_AUTO_TEST_CASE(the_graph_of_a_symplectic_form) {
  const Json json = Described("pendulum").json();
  BOOST_TEST((json["ports"] == "inner"));
  BOOST_TEST((json["dimension"] == 2));
  BOOST_TEST((json["manifold_dimension"] == 2));
  BOOST_TEST((json["rank_of_F"] == 2));
  BOOST_TEST((json["rank_of_form"] == 2));
  BOOST_TEST((json["casimirs"] == 0));
  BOOST_TEST((json["dirac"] == true));
  BOOST_TEST((json["integrable"] == true));
  BOOST_TEST((json["integrability"] == "Courant's condition at 2 of 2 points"));
  BOOST_TEST(json["rank_jumps_at"].empty());
  BOOST_TEST((json["pair"]["F"].size() == 2u));
}

// With open ports a structure is larger than a Dirac structure, with closed ones it is one.
BOOST_AUTO_TEST_CASE(open_ports_and_closed_ones) {
  const test::Problem problem = test::problem(test::experiment_file("port_hamiltonian_open"));
  const std::vector<VectorXd> points = {problem.ladder.point.x};
  const auto& structures = problem.experiment.model.structures;
  BOOST_TEST_REQUIRE(structures.size() == 2u);
  const auto& coordinates = problem.experiment.model.system->names().coordinates;
  const Json open = structure_description("", *structures[0].second, points, coordinates);
  BOOST_TEST((open["dimension"] == 3));
  BOOST_TEST((open["dirac"] == false));
  BOOST_TEST((open["coisotropic"] == true));
  BOOST_TEST(open["integrable"].is_null());
  BOOST_TEST((open["integrability"] == "not defined: D is not a Dirac structure"));
  BOOST_TEST(
      (structure_description("", *structures[1].second, points, coordinates)["dirac"] == true));
  for (const auto& [name, structure] : structures) {
    const std::vector<LawResult> laws = proposition_7_1(*structure, points);
    BOOST_TEST_REQUIRE(laws.size() == 1u);
    BOOST_TEST(laws[0].passed());
  }
  const Described canonical("pendulum");
  BOOST_TEST(proposition_7_1(canonical.structure, canonical.points).empty());
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
