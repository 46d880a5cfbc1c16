// The discretization maps that an experiment can ask for.
#include <boost/test/unit_test.hpp>
#include <stdexcept>

#include "courant/integrators/maps/discretization_map.hpp"
#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/matrix_group.hpp"
#include "courant/manifolds/product.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/reading/method_kinds.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(discretization_kinds_test)

namespace {

using ManifoldPointer = std::shared_ptr<const Manifold>;

const ManifoldPointer sphere = std::make_shared<Sphere>(2);
const ManifoldPointer rotations = std::make_shared<SpecialOrthogonal3>();
const ManifoldPointer both = std::make_shared<Product>(
    std::vector<ManifoldPointer>{rotations, std::make_shared<Euclidean>(1)});

// The map that a choice makes on M.
std::string map_of(const Json& choice, const ManifoldPointer& M) {
  Findings findings;
  const auto kind = discretization_kinds().read(JsonReader(choice, "/discretization", findings));
  findings.require_clean();
  return kind->make(M)->name();
}

std::string problem_of(const Json& choice, const ManifoldPointer& M) {
  try {
    map_of(choice, M);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace

BOOST_AUTO_TEST_CASE(maps_are_those_of_the_factors) {
  BOOST_TEST(map_of("exponential", sphere) == "Theta(0.5)");
  BOOST_TEST(map_of("chordal", sphere) == "Chordal");
  BOOST_TEST(map_of("spherical-midpoint", sphere) == "SphericalMidpoint");
  BOOST_TEST(map_of("cayley", rotations) == "CayleyMidpoint");
  BOOST_TEST(map_of("cayley", both).starts_with("Product"));
  BOOST_TEST(map_of({{"type", "theta"}, {"theta", 0.25}}, both) == "Theta(0.25)");
}

BOOST_AUTO_TEST_CASE(on_cotangent_bundles_they_are_lifted) {
  for (const auto& [choice, base] : {std::pair("exponential", sphere), std::pair("chordal", sphere),
                                     std::pair("cayley", rotations)})
    BOOST_TEST(map_of(choice, std::make_shared<CotangentBundle>(base)) ==
               "CotangentLift(" + map_of(choice, base) + ")");
}

BOOST_AUTO_TEST_CASE(maps_that_a_manifold_does_not_have_are_refused) {
  BOOST_TEST(problem_of("cayley", sphere)
                 .starts_with("the discretization \"cayley\" is for so3, se3, so and groups of "
                              "matrices that leave a "
                              "form invariant, but the configurations are on Sphere(2"));
  BOOST_TEST(
      problem_of("chordal", both).starts_with("the discretization \"chordal\" is for spheres"));
  BOOST_TEST(problem_of("projected", sphere)
                 .starts_with("the discretization \"projected\" is for implicit submanifolds"));
  const auto by_cayley = std::make_shared<SpecialOrthogonal3>(SpecialOrthogonal3::cayley());
  BOOST_TEST(problem_of("exponential", by_cayley)
                 .starts_with("the discretization \"exponential\" is for manifolds with the "
                              "exponential retraction"));
}

BOOST_AUTO_TEST_CASE(maps_by_formulas) {
  const auto line = std::make_shared<Euclidean>(1);
  const auto formula = [](const char* minus, const char* plus) {
    return Json{{"type", "formula"}, {"minus", {minus}}, {"plus", {plus}}};
  };
  BOOST_TEST(map_of(formula("x[0] - v[0]/2", "x[0] + v[0]/2"), line) == "FormulaMap");
  BOOST_TEST(problem_of(formula("x[0] - v[0]/2", "x[0] + v[0]"), line)
                 .starts_with("the discretization \"formula\" is no discretization map of "
                              "Euclidean(1): d/ds (R⁺ - R⁻)"));
  BOOST_TEST(problem_of(formula("x[0] - w[0]/2", "x[0] + v[0]/2"), line) ==
             "the discretization \"formula\": in \"x[0] - w[0]/2\", column 8: unknown name \"w\"");
  BOOST_TEST(problem_of(formula("x[0] - v[0]/2", "x[0] + v[0]/2"), sphere).find("expected") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(maps_of_groups_of_matrices) {
  const auto plane = std::make_shared<MatrixGroup>(MatrixAlgebra::se2());
  const auto volume = std::make_shared<MatrixGroup>(MatrixAlgebra::sl(3));
  BOOST_TEST(map_of("cayley", plane) == "GroupMidpoint(cayley)");
  BOOST_TEST(map_of("second-kind", volume) == "GroupMidpoint(second-kind)");
  BOOST_TEST(problem_of("cayley", volume).find("groups of matrices that leave a form invariant") !=
             std::string::npos);
  BOOST_TEST(problem_of("second-kind", rotations).find("is for groups of matrices") !=
             std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
