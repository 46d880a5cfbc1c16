// The manifolds and discretization maps that an experiment can ask for.
#include "courant/reading/space.hpp"

#include <boost/test/unit_test.hpp>
#include <string>

#include "courant/reading/experiment.hpp"
#include "experiment_problems.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(space)

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
  BOOST_TEST(name("so", "X[4][4]") == "CotangentBundle(SpecialOrthogonal(4))");
  BOOST_TEST(name("stiefel", "X[4][2]") == "CotangentBundle(Stiefel(4, 2))");
  BOOST_TEST(name("symmetric-positive-definite", "X[6]") ==
             "CotangentBundle(SymmetricPositiveDefinite(3))");
}

BOOST_AUTO_TEST_CASE(groups_of_matrices) {
  const auto name = [](const Json& base, const Json& coordinates) {
    return manifold_of(motion(base, coordinates, "0"))->name();
  };
  BOOST_TEST(name("se2", {"R[2][2]", "r[2]"}) ==
             "CotangentBundle(MatrixGroup(se(2), exponential))");
  BOOST_TEST(name({{"type", "su2"}, {"retraction", "cayley"}}, {"q[4]"}) ==
             "CotangentBundle(MatrixGroup(su(2), cayley))");
  BOOST_TEST(name({{"type", "heisenberg"}, {"retraction", "second-kind"}}, {"x[2]", "y[2]", "z"}) ==
             "CotangentBundle(MatrixGroup(heisenberg(2), second-kind))");
  BOOST_TEST(name("sl", {"X[3][3]"}) == "CotangentBundle(MatrixGroup(sl(3), exponential))");
  BOOST_TEST(name("gl", {"X[2][2]"}) == "CotangentBundle(MatrixGroup(gl(2), exponential))");
  BOOST_TEST(name("sp", {"X[4][4]"}) == "CotangentBundle(MatrixGroup(sp(4), exponential))");
  BOOST_TEST(name("galilei", {"X[5][5]"}) == "CotangentBundle(MatrixGroup(galilei, exponential))");
  const Json line = {{"type", "matrix-group"},
                     {"basis", Json::parse("[[[1,0],[0,0]], [[0,1],[0,0]]]")}};
  BOOST_TEST(name(line, {"g[2][2]"}) == "CotangentBundle(MatrixGroup(g, exponential))");
  const auto names = read_experiment(motion("se2", {"R[2][2]", "r[2]"}, "p_R^2 + p_r[1]").dump())
                         .model.system->names()
                         .coordinates;
  BOOST_TEST(names[6] == "p_R");
  BOOST_TEST(names[8] == "p_r[1]");

  const auto problem = [](const Json& base, const char* coordinates) {
    return problems(motion(base, {coordinates}, "0"));
  };
  BOOST_TEST(problem({{"type", "sl"}, {"retraction", "cayley"}}, "X[3][3]")
                 .find("the Cayley transform of sl(3) leaves the group") != std::string::npos);
  BOOST_TEST(problem("sp", "X[3][3]")
                 .find("square matrices with an even number of rows; expected "
                       "coordinates such as \"X[4][4]\"") != std::string::npos);
  BOOST_TEST(problem("heisenberg", "x[4]").find("does not have 4 numbers") != std::string::npos);
  BOOST_TEST(
      problem(line, "g[3][3]").find("has matrices of 4 entries, but the coordinates are 9") !=
      std::string::npos);
  Json given = {{"type", "matrix-group"}, {"basis", Json::parse("[[[1,0],[0,-2]]]")}};
  BOOST_TEST(problem(given, "g[2][2]").find("of 3 equations of the group 1 is not found") !=
             std::string::npos);
  given["equations"] = {"g[0][0]^2*g[1][1] - 1"};
  BOOST_TEST(problem(given, "g[2][2]") == "");
  given["equations"] = {"g[0][0]^2*g[1][1] - 2"};
  BOOST_TEST(problem(given, "g[2][2]").find("the equations are off by") != std::string::npos);
  given["equations"] = {"h - 2"};
  BOOST_TEST(problem(given, "g[2][2]").find("unknown name \"h\"") != std::string::npos);
  given.erase("equations");
  given["basis"] = Json::parse("[[[0,1],[0,0]], [[0,0],[1,0]]]");
  BOOST_TEST(problem(given, "g[2][2]").find("closed under brackets") != std::string::npos);
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
  BOOST_TEST(problems(motion("so", {"X[2][3]"}, "0")) ==
             "/system/manifold/base: the points of SO(n) are square matrices; expected coordinates "
             "such as \"X[4][4]\"");
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

BOOST_AUTO_TEST_CASE(velocities_over_a_tangent_bundle) {
  const auto names = [](const Json& manifold, const Json& coordinates) {
    const Json experiment = {{"system",
                              {{"type", "implicit"},
                               {"manifold", manifold},
                               {"coordinates", coordinates},
                               {"equations", {"0"}}}},
                             {"initial", Json::object()}};
    return read_experiment(experiment.dump()).model.system->names().coordinates;
  };
  const auto rotations = names({{"type", "tangent-bundle"}, {"base", "so3"}}, {"R[3][3]"});
  BOOST_REQUIRE(rotations.size() == 12u);
  BOOST_TEST(rotations[9] == "v_R[0]");
  const auto twice =
      names({{"type", "cotangent-bundle"}, {"base", {{"type", "tangent-bundle"}, {"base", "so3"}}}},
            {"R[3][3]"});
  BOOST_REQUIRE(twice.size() == 18u);
  BOOST_TEST(twice[9] == "v_R[0]");
  BOOST_TEST(twice[12] == "p_R[0]");
  BOOST_TEST(twice[15] == "p_v_R[0]");
}

// The sphere as a submanifold of R³, and a circle of it.
BOOST_AUTO_TEST_CASE(submanifolds_by_equations) {
  const Json sphere = {{"type", "implicit-submanifold"}, {"equations", {"dot(x, x) - r^2"}}};
  const auto with = [](const Json& base, const Json& coordinates = {"x[3]"}) {
    Json experiment = motion(base, coordinates, "0");
    experiment["system"]["parameters"] = {{"r", 2}};
    experiment["system"]["definitions"] = {{"height", "x[2]"}, {"energy", "p_x[0]"}};
    return experiment;
  };
  const auto M = manifold_of(with(sphere));
  BOOST_TEST(M->name() == "CotangentBundle(ImplicitSubmanifold(Euclidean(3), 1))");
  BOOST_TEST(M->dimension() == 4);
  VectorXd x(6);
  x << 0, 1.2, 1.6, 1, 0.8, -0.6;
  BOOST_TEST(M->point_defect(x) < 1e-15);
  x[2] = 1.7;
  BOOST_TEST(M->point_defect(x) > 0.1);

  const Json circle = {
      {"type", "implicit-submanifold"}, {"surrounding", "sphere"}, {"equations", {"height - 1/2"}}};
  BOOST_TEST(manifold_of(with(circle))->dimension() == 2);
  BOOST_TEST(map_of({{"type", "projected"}, {"map", "chordal"}}, with(circle)) ==
             "CotangentLift(Projected(Chordal))");
  BOOST_CHECK_THROW(map_of("projected", motion("sphere", {"x[3]"}, "0")), std::invalid_argument);

  const auto changed = [&](const char* key, const Json& value) {
    Json base = sphere;
    base[key] = value;
    return problems(with(base));
  };
  const std::string place = "/system/manifold/base";
  BOOST_TEST(changed("equations", {"x[0]^2 + 1"}) ==
             place +
                 "/equations: have no zero that could be found in Euclidean(3); expected "
                 "equations that hold somewhere, with independent gradients there");
  BOOST_TEST(changed("equations", {"(x[0] - 1)^2"}) == changed("equations", {"x[0]^2 + 1"}));
  BOOST_TEST(changed("equations", {"x[0]", "x[1]", "x[2]"}) ==
             place +
                 "/equations: are 3; expected 1 to 2, fewer than the dimension of "
                 "Euclidean(3)");
  BOOST_TEST(changed("equations", {"energy"}) ==
             place + "/equations/0: column 1: unknown name \"energy\"");
  BOOST_TEST(changed("surrounding", "so3") ==
             place +
                 ": is in SpecialOrthogonal3(exponential) with points of 9 numbers, but the "
                 "coordinates are 3");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
