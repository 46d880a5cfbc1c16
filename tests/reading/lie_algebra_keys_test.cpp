#include "courant/reading/lie_algebra_keys.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/structures/dirac_system.hpp"
#include "courant/structures/lie_poisson.hpp"
#include "experiment_problems.hpp"

// Mistakes that these cases have to notice:
//  * a bracket that is given as [F, E] has the sign of [E, F] (reading/lie_algebra_keys.cpp)
BOOST_AUTO_TEST_SUITE(lie_algebra_keys_test)

using namespace courant;

namespace {

Json experiment_of(const Json& algebra) {
  Json experiment = Json::parse(R"json({
    "system": { "type": "euler-poincare", "hamiltonian": "dot(mu, mu)/2" },
    "initial": { "mu": [1, 2, 3] }
  })json");
  experiment["system"].update(algebra);
  return experiment;
}

std::vector<MatrixXd> constants_of(const Json& algebra) {
  const Experiment experiment = read_experiment(experiment_of(algebra).dump());
  const auto system = std::dynamic_pointer_cast<const DiracSystem>(experiment.model.system);
  return std::dynamic_pointer_cast<const LiePoisson>(system->structure())->algebra().constants();
}

std::string problem_of(const Json& algebra) { return problems(experiment_of(algebra)); }

const Json sl2 = {{"basis", {"H", "E", "F"}},
                  {"brackets", {{"H,E", "2*E"}, {"F, H", "2*F"}, {"E,F", "H"}}}};

}  // namespace

// sl(2) by its name, by brackets and by matrices.
BOOST_AUTO_TEST_CASE(one_algebra_in_three_ways) {
  const auto by_name = constants_of({{"algebra", "sl"}, {"n", 2}});
  const auto by_brackets = constants_of(sl2);
  const auto by_matrices =
      constants_of({{"matrices", Json::parse("[[[1,0],[0,-1]], [[0,1],[0,0]], [[0,0],[1,0]]]")}});
  for (std::size_t k = 0; k < 3; ++k) {
    BOOST_TEST((by_brackets[k] - by_name[k]).norm() == 0.0);
    BOOST_TEST((by_matrices[k] - by_name[k]).norm() == 0.0);
  }
  BOOST_TEST(by_name[1](0, 1) == 2.0);   // [H, E] = 2 E
  BOOST_TEST(by_name[2](0, 2) == -2.0);  // [H, F] = -2 F
  BOOST_TEST(by_name[0](1, 2) == 1.0);   // [E, F] = H
}

BOOST_AUTO_TEST_CASE(names_of_the_literature) {
  // [e_0, e_1] = e_2: e_2 is the centre.
  const auto heisenberg = constants_of({{"algebra", "heisenberg"}, {"n", 1}});
  BOOST_TEST(heisenberg[2](0, 1) == 1.0);
  BOOST_TEST(heisenberg[0].norm() + heisenberg[1].norm() == 0.0);
  const auto se2 = constants_of({{"algebra", "se2"}});
  BOOST_TEST(se2[2](0, 1) == 1.0);
  BOOST_TEST(se2[1](0, 2) == -1.0);
  const auto su2 = constants_of({{"algebra", "su2"}}), so3 = LieAlgebra::so3().constants();
  for (std::size_t k = 0; k < 3; ++k) BOOST_TEST((su2[k] - so3[k]).norm() == 0.0);
}

BOOST_AUTO_TEST_CASE(what_is_wrong_is_told) {
  const auto with = [](const char* pair, const Json& value) {
    Json algebra = sl2;
    algebra["brackets"][pair] = value;
    return problem_of(algebra);
  };
  BOOST_TEST(problem_of(sl2) == "");
  BOOST_TEST(with("H,E", "2*F") ==
             "/system/brackets: the Jacobi identity fails by 2 for H and E; expected 0.");
  BOOST_TEST(
      with("E,H", "2*E").find("/system/brackets/E,H: is given twice, in one order or the other") !=
      std::string::npos);
  BOOST_TEST(with("E,E", 0).find("/system/brackets/E,E: is the bracket of no pair") !=
             std::string::npos);
  BOOST_TEST(with("E,G", "H").find("/system/brackets/E,G: is the bracket of no pair") !=
             std::string::npos);
  BOOST_TEST(with("H,E", "E*E").find("is not linear in the basis") != std::string::npos);
  BOOST_TEST(with("H,E", "1 + E").find("is not linear in the basis") != std::string::npos);
  BOOST_TEST(with("H,E", "2*G").find("/system/brackets/H,E: column 3: unknown name \"G\"") !=
             std::string::npos);
  BOOST_TEST(problem_of({{"brackets", {{"H,E", "E"}}}})
                 .find("/system/brackets: need names; expected \"basis\"") != std::string::npos);
  BOOST_TEST(problem_of(Json::object()).find("/system: has no Lie algebra; expected one of") !=
             std::string::npos);
  BOOST_TEST(problem_of({{"algebra", "so3"}, {"matrices", Json::parse("[[[1]]]")}})
                 .find("/system: has several Lie algebras; expected one of") != std::string::npos);
  BOOST_TEST(problem_of({{"algebra", "sl"}}).find("/system/algebra: needs its size") !=
             std::string::npos);
  BOOST_TEST(problem_of({{"algebra", "sl"}, {"n", 1}}).find("n is 1; expected n ≥ 2") !=
             std::string::npos);
  BOOST_TEST(problem_of({{"matrices", Json::parse("[[[0,1],[0,0]], [[0,0],[1,0]]]")}})
                 .find("/system/matrices: the commutator of the matrices 0 and 1 is") !=
             std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
