#include "courant/integrators/maps/formula_map.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/integrators/maps/laws.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/sphere.hpp"

// Mistakes that these cases have to notice:
//  * D2 is measured by R⁺ alone, or not at all
//  * the stage of a map is always the middle
BOOST_AUTO_TEST_SUITE(formula_map)

using namespace courant;

namespace {

using V = const ExprVector&;

const auto line = std::make_shared<Euclidean>(1);
const auto sphere = std::make_shared<Sphere>(2);

// x + factor v
FormulaMap::Map shifted(double factor) {
  return [factor](V x, V v) { return ExprVector(x + Expr(factor) * v); };
}
// (x + factor v)/‖…‖
FormulaMap::Map normalised(double factor) {
  return [factor](V x, V v) {
    const ExprVector y = x + Expr(factor) * v;
    return ExprVector(y / sqrt(y.squaredNorm()));
  };
}

std::string refusal(const std::shared_ptr<const Manifold>& M,
                    const FormulaMap::Formulas& formulas) {
  try {
    FormulaMap(M, formulas);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace

// With what they claim: the map (2) of the sphere, θ = 0.3 on a line, and one that stretches v with x.
BOOST_AUTO_TEST_CASE(keep_every_law) {
  const FormulaMap chordal(
      sphere,
      {.minus = normalised(-0.5),
       .plus = normalised(0.5),
       .point = [](V a, V b) { return ExprVector((a + b) / sqrt((a + b).squaredNorm())); },
       .vector =
           [](V a, V b) { return ExprVector(Expr(2.0) * (b - a) / sqrt((a + b).squaredNorm())); }});
  BOOST_TEST(chordal.is_symmetric());
  BOOST_TEST(chordal.order() == 2);
  const FormulaMap theta(line,
                         {.minus = shifted(-0.3),
                          .plus = shifted(0.7),
                          .point = [](V a, V b) { return ExprVector(a + Expr(0.3) * (b - a)); },
                          .vector = [](V a, V b) { return ExprVector(b - a); }});
  BOOST_TEST(!theta.is_symmetric());
  BOOST_TEST(theta.order() == 1);
  BOOST_TEST(theta.stage_time() == 0.3, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(theta.has_inverse());
  const FormulaMap bent(
      line, {.minus = [](V x, V v) { return ExprVector(x - Expr(0.5) * v + x[0] * v[0] * v); },
             .plus = [](V x, V v) { return ExprVector(x + Expr(0.5) * v + x[0] * v[0] * v); }});
  BOOST_TEST(bent.is_symmetric());
  BOOST_TEST(!bent.has_inverse());
  for (const FormulaMap* map : {&chordal, &theta, &bent})
    for (const LawResult& result : check_discretization_map(*map))
      BOOST_TEST(result.passed(), result);
}

BOOST_AUTO_TEST_CASE(what_is_none_is_refused) {
  const FormulaMap::Map constant = [](V x, V) {
    return ExprVector(x + ExprVector::Ones(x.size()));
  };
  BOOST_TEST(refusal(line, {.minus = constant, .plus = shifted(1.0)}).find("law D1,") !=
             std::string::npos);
  BOOST_TEST(refusal(line, {.minus = shifted(-0.5), .plus = shifted(0.6)}).find("law D2,") !=
             std::string::npos);
  BOOST_TEST(refusal(sphere, {.minus = shifted(-0.5), .plus = shifted(0.5)})
                 .find("what should lead to Sphere(2") != std::string::npos);
  BOOST_TEST(refusal(line, {.minus = shifted(-0.5),
                            .plus = shifted(0.5),
                            .point = [](V a, V b) { return ExprVector(Expr(0.5) * (a + b)); },
                            .vector = [](V a, V b) { return ExprVector(Expr(0.9) * (b - a)); }})
                 .find("law D3,") != std::string::npos);
  BOOST_TEST(refusal(line, {.minus = shifted(-0.5), .plus = {}}).find("a function is missing") !=
             std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
