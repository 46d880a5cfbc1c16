// The manifolds and discretization maps that an experiment can ask for.
#include "courant/systems/space.hpp"

#include <boost/test/unit_test.hpp>
#include <string>

#include "courant/systems/experiment.hpp"

namespace courant {
namespace {

// A free motion on the cotangent bundle of a base.
Json motion(const Json& base, const Json& coordinates, const std::string& hamiltonian) {
  return {{"system",
           {{"type", "hamiltonian"},
            {"manifold", {{"type", "cotangent-bundle"}, {"base", base}}},
            {"coordinates", coordinates},
            {"hamiltonian", hamiltonian}}},
          {"initial", Json::object()}};
}

// The problems of an experiment, a line each; nothing if there are none.
std::string problems(const Json& experiment) {
  try {
    read_experiment(experiment.dump());
  } catch (const ExperimentError& error) {
    return error.what();
  }
  return "";
}

std::shared_ptr<const Manifold> manifold_of(const Json& experiment) {
  return read_experiment(experiment.dump()).model.system->manifold();
}

// The map that a choice makes on the manifold of an experiment.
std::string map_of(const Json& choice, const Json& experiment) {
  Json whole = experiment;
  whole["method"] = {{"type", "discretize-first"}, {"discretization", choice}};
  whole["time"] = {{"step", 0.1}, {"end", 1}};
  Findings findings;
  const auto kind = discretization_kinds().read(JsonReader(choice, "/discretization", findings));
  findings.require_clean();
  return kind->make(manifold_of(whole))->name();
}

}  // namespace

BOOST_AUTO_TEST_SUITE(space)

BOOST_AUTO_TEST_CASE(each_kind_is_the_manifold_that_it_says) {
  const auto name = [](const Json& base, const char* coordinates) {
    return manifold_of(motion(base, {coordinates}, "0"))->name();
  };
  BOOST_TEST(name("euclidean", "x[3]") == "CotangentBundle(Euclidean(3))");
  BOOST_TEST(name("torus", "x[2]") == "CotangentBundle(Torus(2))");
  BOOST_TEST(name("sphere", "x[3]") == "CotangentBundle(Sphere(2, exponential))");
  BOOST_TEST(name({{"type", "sphere"}, {"retraction", "projective"}}, "x[2]") ==
             "CotangentBundle(Sphere(1, projective))");
  BOOST_TEST(name("hyperbolic", "x[3]") == "CotangentBundle(Hyperbolic(2))");
  BOOST_TEST(name("so3", "R[3][3]") == "CotangentBundle(SpecialOrthogonal3(exponential))");
  BOOST_TEST(name({{"type", "se3"}, {"retraction", "cayley"}}, "g[12]") ==
             "CotangentBundle(SpecialEuclidean3(cayley))");
  BOOST_TEST(name("stiefel", "X[4][2]") == "CotangentBundle(Stiefel(4, 2))");
  BOOST_TEST(name("symmetric-positive-definite", "X[6]") ==
             "CotangentBundle(SymmetricPositiveDefinite(3))");
}

BOOST_AUTO_TEST_CASE(momenta_are_named_factor_by_factor) {
  const Json product = {{"type", "product"}, {"factors", {"so3", "sphere", "euclidean"}}};
  const Experiment experiment = read_experiment(
      motion(product, {"R[3][3]", "xi[3]", "s"}, "p_R[2]^2 + p_xi[1] + p_s").dump());
  const auto& names = experiment.model.system->names().coordinates;
  BOOST_REQUIRE(names.size() == 20u);
  BOOST_TEST(names[12] == "s");
  BOOST_TEST(names[13] == "p_R[0]");
  BOOST_TEST(names[16] == "p_xi[0]");
  BOOST_TEST(names[19] == "p_s");

  const auto motions =
      read_experiment(motion("se3", {"R[3][3]", "r[3]"}, "p_R[0] + p_r[2]").dump());
  BOOST_TEST(motions.model.system->names().coordinates[15] == "p_r[0]");
}

BOOST_AUTO_TEST_CASE(coordinates_that_do_not_fit_are_problems) {
  BOOST_TEST(problems(motion("so3", {"R[9]"}, "0")) == "");
  BOOST_TEST(problems(motion("so3", {"R[8]"}, "0")) ==
             "/system/coordinates: name 11 numbers; expected 12, those of a point of "
             "CotangentBundle(SpecialOrthogonal3(exponential))");
  BOOST_TEST(problems(motion("stiefel", {"X[2][3]"}, "0")) ==
             "/system/manifold/base: the points of a Stiefel manifold are matrices with at least "
             "as many rows as columns; expected coordinates such as \"X[4][2]\"");
  BOOST_TEST(problems(motion("symmetric-positive-definite", {"X[4]"}, "0")) ==
             "/system/manifold/base: a lower triangle does not have 4 entries; expected n(n+1)/2 "
             "coordinates, such as \"X[6]\"");
  BOOST_TEST(problems(motion({{"type", "product"}, {"factors", {"so3"}}}, {"R[3][3]", "s"}, "0")) ==
             "/system/manifold/base/factors: are 1; expected one for each of the 2 names in "
             "\"coordinates\"");
  BOOST_TEST(problems(motion({{"type", "product"}, {"factors", {"so3"}}}, {"R[4]"}, "0")) ==
             "/system/manifold/base/factors/0: is SpecialOrthogonal3(exponential) with points of 9 "
             "numbers, but \"R\" has 4");
  BOOST_TEST(problems(motion("se3", {"R[3][3]", "a", "b", "c"}, "0")) ==
             "/system/coordinates: do not say what the momenta on SpecialEuclidean3(exponential) "
             "are called; expected one array for each factor, such as \"R[3][3]\"");
}

BOOST_AUTO_TEST_CASE(maps_are_those_of_the_factors) {
  const Json sphere = motion("sphere", {"x[3]"}, "0");
  const Json rotations = motion("so3", {"R[3][3]"}, "0");
  const Json both =
      motion({{"type", "product"}, {"factors", {"so3", "euclidean"}}}, {"R[3][3]", "s"}, "0");
  BOOST_TEST(map_of("exponential", sphere) == "CotangentLift(Theta(0.5))");
  BOOST_TEST(map_of("chordal", sphere) == "CotangentLift(Chordal)");
  BOOST_TEST(map_of("cayley", rotations) == "CotangentLift(CayleyMidpoint)");
  BOOST_TEST(map_of("cayley", both).starts_with("CotangentLift(Product"));
  BOOST_CHECK_THROW(map_of("cayley", sphere), std::invalid_argument);
  BOOST_CHECK_THROW(map_of("chordal", both), std::invalid_argument);
  BOOST_CHECK_THROW(
      map_of("exponential", motion({{"type", "so3"}, {"retraction", "cayley"}}, {"R[3][3]"}, "0")),
      std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
