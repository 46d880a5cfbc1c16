#include "courant/integrators/methods/discrete_differential.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <memory>
#include <random>

#include "courant/core/expressions/derivative.hpp"
#include "courant/integrators/maps/cayley_midpoint.hpp"
#include "courant/integrators/maps/chordal.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/structures/generating_family.hpp"

// Mistakes that these cases have to notice:
//  * the energy is not exact
//  * units do not count
BOOST_AUTO_TEST_SUITE(discrete_differential_test)

using namespace courant;

namespace {

using Formula = std::function<Expr(const ExprVector&)>;

const std::vector<std::shared_ptr<const DiscreteDifferential>>& differentials() {
  static const std::vector<std::shared_ptr<const DiscreteDifferential>> all = {
      std::make_shared<GonzalezDifferential>(), std::make_shared<AveragedDifferential>(),
      std::make_shared<ItohAbeDifferential>()};
  return all;
}

// α(x̄, v) of E with a map, the function of a step.
class Discrete {
 public:
  Discrete(const DiscretizationMap& map, const DiscreteDifferential& differential, const Formula& E,
           VectorXd units = VectorXd())
      : map_(map), E_(E) {
    const Manifold& M = *map.manifold();
    if (units.size() == 0) units = VectorXd::Ones(M.tangent_dimension());
    const ExprVector x = graph_.variables("x", M.ambient_dimension());
    const ExprVector v = graph_.variables("v", M.tangent_dimension());
    const ExprVector w = graph_.variables("w", M.tangent_dimension());
    const ExprMatrix projector = M.tangent_projector(x);
    const auto ends = map.forward(x, ExprVector(projector * w));
    const ExprVector alpha =
        projector.transpose() * ExprVector(differential({.w = w,
                                                         .end = E(ends.second),
                                                         .start = E(ends.first),
                                                         .v = v,
                                                         .is_symmetric = map.is_symmetric()},
                                                        units));
    value_ = Function("alpha", {{"x", x}, {"v", v}}, alpha, {.differentiate = {"v"}});
  }
  VectorXd operator()(const VectorXd& x, const VectorXd& v) const { return value_({x, v}); }
  MatrixXd jacobian(const VectorXd& x, const VectorXd& v) const { return value_.jacobian({x, v}); }

  double difference(const VectorXd& x, const VectorXd& v) const {
    const auto ends = map_.forward(x, v);
    return E_(constants(ends.second)).value() - E_(constants(ends.first)).value();
  }
  double size(const VectorXd& x) const { return std::abs(E_(constants(x)).value()); }

 private:
  const DiscretizationMap& map_;
  Formula E_;
  Graph graph_;
  Function value_;
};

VectorXd differential(const Manifold& M, const Formula& E, const VectorXd& x) {
  const Hamiltonian H(std::shared_ptr<const Manifold>(&M, [](const Manifold*) {}),
                      [&](const ExprVector& at, const Expr&) { return E(at); });
  return values(H.differential(constants(x), ExprVector(0), 0.0));
}

struct Place {
  std::string name;
  std::shared_ptr<const DiscretizationMap> map;
  Formula E;
};

// Functions without symmetries, on a vector space, a sphere and a group.
std::vector<Place> places() {
  const auto space = std::make_shared<Euclidean>(3);
  const auto sphere = std::make_shared<Sphere>(2);
  const auto rotations = std::make_shared<SpecialOrthogonal3>();
  const Formula of_three = [](const ExprVector& x) {
    return exp(0.7 * x[0] * x[1]) + cos(x[2] + x[0]) + square(square(x[1])) * x[2] +
           sqrt(2.0 + square(x[2])) / (1.5 + x[0]) + log(3.0 + x[1]);
  };
  const Formula of_nine = [](const ExprVector& R) {
    return R[8] + 0.3 * R[1] * R[5] + square(R[3]) * R[0];
  };
  return {{"midpoint", std::make_shared<Theta>(space), of_three},
          {"theta = 0", std::make_shared<Theta>(space, 0.0), of_three},
          {"theta = 0.3", std::make_shared<Theta>(space, 0.3), of_three},
          {"chordal", std::make_shared<Chordal>(sphere), of_three},
          {"midpoint on S²", std::make_shared<Theta>(sphere), of_three},
          {"midpoint on SO(3)", std::make_shared<Theta>(rotations), of_nine},
          {"cayley", std::make_shared<CayleyMidpoint>(rotations), of_nine}};
}

}  // namespace

// C1, for long and short v, along axes, and where components of v are zero.
BOOST_AUTO_TEST_CASE(c1_the_difference_is_exact) {
  std::mt19937 generator(3);
  for (const Place& place : places())
    for (const auto& kind : differentials()) {
      const Discrete alpha(*place.map, *kind, place.E);
      const Manifold& M = *place.map->manifold();
      const VectorXd x = M.random_point(generator);
      std::vector<VectorXd> directions = {M.random_tangent(x, 0.6, generator),
                                          M.tangent_basis(x).matrix().col(0) * 0.6,
                                          VectorXd::Zero(M.tangent_dimension())};
      for (const VectorXd& direction : directions)
        for (const double s : {1.0, -1.0, 1e-2, 1e-5}) {
          const VectorXd v = s * direction, a = alpha(x, v);
          BOOST_TEST(a.allFinite());
          BOOST_TEST(std::abs(a.dot(v) - alpha.difference(x, v)) <= 2e-14 * (1.0 + alpha.size(x)),
                     place.name << ", " << kind->name() << ": " << a.dot(v) << ", expected "
                                << alpha.difference(x, v));
          BOOST_TEST((M.tangent_projector(x).transpose() * a - a).norm() < 1e-13);
        }
    }
}

// C2, and that short v lose no digits: α - dE is of first order in v at most, however short v is.
BOOST_AUTO_TEST_CASE(c2_the_limit_is_the_differential) {
  std::mt19937 generator(4);
  for (const Place& place : places())
    for (const auto& kind : differentials()) {
      const Discrete alpha(*place.map, *kind, place.E);
      const Manifold& M = *place.map->manifold();
      const VectorXd x = M.random_point(generator), v = M.random_tangent(x, 1.0, generator);
      const VectorXd dE = differential(M, place.E, x);
      BOOST_TEST((alpha(x, 0.0 * v) - dE).norm() <= 1e-14 * (1.0 + dE.norm()));
      for (const double s : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 1e-100, 1e-200, 1e-320}) {
        BOOST_TEST((alpha(x, s * v) - dE).norm() <= (10.0 * s + 2e-14) * (1.0 + dE.norm()),
                   place.name << ", " << kind->name() << ", s = " << s << ": "
                              << (alpha(x, s * v) - dE).norm());
        BOOST_TEST(alpha.jacobian(x, s * v).allFinite());
      }
    }
}

// Symmetric differentials with a symmetric map are even in v, that of Itoh and Abe is not.
BOOST_AUTO_TEST_CASE(symmetry_as_claimed) {
  std::mt19937 generator(5);
  for (const Place& place : places()) {
    if (!place.map->is_symmetric()) continue;
    for (const auto& kind : differentials()) {
      const Discrete alpha(*place.map, *kind, place.E);
      const Manifold& M = *place.map->manifold();
      const VectorXd x = M.random_point(generator), v = M.random_tangent(x, 0.5, generator);
      const double asymmetry = (alpha(x, v) - alpha(x, -v)).norm();
      if (kind->is_symmetric())
        BOOST_TEST(asymmetry < 1e-13, place.name << ", " << kind->name());
      else
        BOOST_TEST(asymmetry > 1e-4, place.name << ", " << kind->name());
    }
  }
}

// By hand for E = x² y from (x₀, y₀) to (x₁, y₁) on R².
BOOST_AUTO_TEST_CASE(by_hand) {
  const auto plane = std::make_shared<Euclidean>(2);
  const Formula E = [](const ExprVector& x) { return square(x[0]) * x[1]; };
  const Theta midpoint(plane), start(plane, 0.0);
  const VectorXd x0{{0.3, -0.7}}, x1{{0.9, 0.4}}, v = x1 - x0, middle = 0.5 * (x0 + x1);
  const double change = 0.81 * 0.4 + 0.09 * 0.7;
  const VectorXd dE{{2.0 * 0.6 * -0.15, 0.36}};
  // c = (ΔE - ⟨dE, v⟩) / vᵀ G v
  const VectorXd units{{1.0, 3.0}}, G{{1.0, 1.0 / 9.0}};
  const double c = (change - dE.dot(v)) / v.dot(G.cwiseProduct(v));
  const VectorXd gonzalez = dE + c * G.cwiseProduct(v);
  BOOST_TEST((Discrete(midpoint, GonzalezDifferential(), E, units)(middle, v) - gonzalez).norm() <
             1e-15);
  // ∫ 2 x y dt and ∫ x² dt along the segment.
  const VectorXd averaged{{2.0 * (0.6 * -0.15 + 0.6 * 1.1 / 12.0), 0.36 + 0.36 / 12.0}};
  BOOST_TEST((Discrete(midpoint, AveragedDifferential(), E, units)(middle, v) - averaged).norm() <
             1e-15);
  // (x₁² y₀ - x₀² y₀) / (x₁ - x₀), (x₁² y₁ - x₁² y₀) / (y₁ - y₀), with either map.
  const VectorXd itoh_abe{{-0.7 * 1.2, 0.81}};
  BOOST_TEST((Discrete(midpoint, ItohAbeDifferential(), E)(middle, v) - itoh_abe).norm() < 1e-15);
  BOOST_TEST((Discrete(start, ItohAbeDifferential(), E)(x0, v) - itoh_abe).norm() < 1e-15);
}

// Of a quadratic function the midpoint map leaves nothing to correct: the formula is dE(x̄).
BOOST_AUTO_TEST_CASE(quadratic_functions_have_their_differential) {
  const auto plane = std::make_shared<Euclidean>(2);
  const Formula E = [](const ExprVector& x) { return square(x[0]) + 3.0 * x[0] * x[1] - x[1]; };
  const Theta midpoint(plane);
  const VectorXd x{{0.3, -0.7}};
  for (const auto& kind : {differentials()[0], differentials()[1]}) {
    const Discrete alpha(midpoint, *kind, E);
    BOOST_TEST((alpha(x, VectorXd{{5.0, 2.0}}) - VectorXd{{0.6 - 2.1, -0.1}}).norm() < 1e-15);
    BOOST_TEST(alpha.jacobian(x, VectorXd{{5.0, 2.0}}).norm() == 0.0);
  }
}

// In other units the covector is the same in these units.
BOOST_AUTO_TEST_CASE(units_of_measurement_do_not_matter) {
  const auto plane = std::make_shared<Euclidean>(2);
  const VectorXd units{{1e-9, 1e6}};
  const Formula E = [](const ExprVector& x) { return sin(x[0]) * exp(x[1]); };
  const Formula scaled = [&](const ExprVector& x) {
    return sin(x[0] / units[0]) * exp(x[1] / units[1]);
  };
  const Theta midpoint(plane);
  const VectorXd x{{0.3, -0.7}}, v{{0.8, 0.5}};
  for (const auto& kind : differentials()) {
    const VectorXd expected = Discrete(midpoint, *kind, E)(x, v);
    const VectorXd found =
        Discrete(midpoint, *kind, scaled, units)(x.cwiseProduct(units), v.cwiseProduct(units));
    BOOST_TEST((found.cwiseProduct(units) - expected).norm() < 1e-14);
  }
}

BOOST_AUTO_TEST_SUITE_END()
