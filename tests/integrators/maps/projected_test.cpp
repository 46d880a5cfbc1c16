#include "courant/integrators/maps/projected.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/integrators/maps/chordal.hpp"
#include "courant/integrators/maps/laws.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/measurement.hpp"
#include "courant/tests/integrators/example_systems.hpp"

BOOST_AUTO_TEST_SUITE(projected)

using namespace courant;
using Eigen::Vector3d;

namespace {

using Submanifold = std::shared_ptr<const ImplicitSubmanifold>;

Submanifold surface(const std::string& name, const std::function<Expr(const ExprVector&)>& c) {
  return std::make_shared<ImplicitSubmanifold>(
      name, std::make_shared<Euclidean>(3),
      [c](const ExprVector& x) { return ExprVector(ExprVector::Constant(1, c(x))); }, 1);
}

Submanifold unit_sphere() {
  return surface("UnitSphere", [](const ExprVector& x) { return x.squaredNorm() - 1.0; });
}

Expr ellipsoid_equation(const ExprVector& x) {
  return square(x[0]) + square(x[1]) / 2.0 + square(x[2]) / 4.0 - 1.0;
}

// Curved in both senses: radius 2 of the core circle, 0.8 of the tube.
Submanifold torus_surface() {
  return surface("TorusSurface", [](const ExprVector& x) {
    return square(sqrt(square(x[0]) + square(x[1])) - 2.0) + square(x[2]) - 0.64;
  });
}

std::shared_ptr<const Projected> on(const Submanifold& S, double theta = 0.5) {
  return std::make_shared<Projected>(S, std::make_shared<Theta>(S->surrounding(), theta));
}

// A map with another projector, given as what is done to each of R⁻ and R⁺.
class WithProjector final : public DiscretizationMap {
 public:
  using Projection = std::function<ExprVector(const ExprVector&)>;
  WithProjector(const Submanifold& S, Projection P)
      : DiscretizationMap("WithProjector", S), map_(S->surrounding()), P_(std::move(P)) {}
  bool has_inverse() const override { return false; }
  int order() const override { return 2; }
  bool is_symmetric() const override { return true; }

 private:
  PointPair<Expr> do_forward(const ExprVector& x, const ExprVector& v) const override {
    const auto [first, second] = map_.forward(x, v);
    return {P_(first), P_(second)};
  }
  Theta map_;
  Projection P_;
};

bool fails(const DiscretizationMap& map, const std::string& law) {
  for (const LawResult& result : check_discretization_map(map, {.points = 1}))
    if (!result.passed() && result.law.starts_with(law)) return true;
  return false;
}

}  // namespace

// P(x ± v/2) on {‖x‖² = 1} is (x ± v/2)/‖x ± v/2‖.
BOOST_AUTO_TEST_CASE(on_the_sphere_it_is_chordal) {
  const auto S = unit_sphere();
  const auto map = on(S);
  const auto sphere = std::make_shared<Sphere>(2, Sphere::projective());
  const Chordal chordal(sphere);
  std::mt19937 generator(3);
  for (const double length : {0.0, 1e-8, 1e-3, 0.4, 2.0, 6.0}) {
    const VectorXd x = sphere->random_point(generator);
    const VectorXd v = sphere->random_tangent(x, length, generator);
    const auto [a0, a1] = map->forward(x, v);
    const auto [b0, b1] = chordal.forward(x, v);
    BOOST_TEST((a0 - b0).norm() + (a1 - b1).norm() < 1e-14, "length " << length);
    if (length > 0.5) continue;
    const auto [y, w] = map->inverse(b0, b1);  // by Newton's method; Chordal's is closed
    BOOST_TEST((y - x).norm() + (w - v).norm() < 1e-13, "length " << length);
    for (const double theta : {0.0, 0.3}) {
      const auto [c0, c1] = on(S, theta)->forward(x, v);
      const auto [d0, d1] = Theta(sphere, theta).forward(x, v);
      BOOST_TEST((c0 - d0).norm() + (c1 - d1).norm() < 1e-14, "theta " << theta);
    }
  }
}

// A great circle: geodesics of the sphere stay on it, so that P has nothing to do.
BOOST_AUTO_TEST_CASE(on_a_totally_geodesic_submanifold_it_is_the_surrounding_map) {
  const auto sphere = std::make_shared<Sphere>(2);
  const auto S = std::make_shared<ImplicitSubmanifold>(
      "GreatCircle", sphere, [](const ExprVector& x) { return ExprVector(x.head(1) - x.tail(1)); },
      1);
  const auto geodesic = std::make_shared<Theta>(sphere);
  const Projected map(S, geodesic);
  std::mt19937 generator(4);
  for (const double length : {1e-4, 0.7, 2.5}) {
    const VectorXd x = S->random_point(generator);
    const VectorXd v = S->random_tangent(x, length, generator);
    const auto [a0, a1] = map.forward(x, v);
    const auto [b0, b1] = geodesic->forward(x, v);
    BOOST_TEST((a0 - b0).norm() + (a1 - b1).norm() < 1e-14);
  }
}

// What the class comment says: on S to 1e-12 within the injectivity radius, and not anywhere.
BOOST_AUTO_TEST_CASE(points_lie_on_the_submanifold) {
  for (const auto& S : {surface("Ellipsoid", ellipsoid_equation), torus_surface()}) {
    std::mt19937 generator(5);
    double largest = 0.0;
    for (const double theta : {0.0, 0.5}) {
      const auto map = on(S, theta);
      for (int i = 0; i < 20; ++i) {
        const VectorXd x = S->random_point(generator);
        const auto [x0, x1] =
            map->forward(x, S->random_tangent(x, S->injectivity_radius(x), generator));
        largest = std::max({largest, S->point_defect(x0), S->point_defect(x1)});
      }
    }
    BOOST_TEST(largest < 1e-12, S->name() << ": " << largest);
    BOOST_TEST_MESSAGE(S->name() << ": off by " << largest);
  }
  const auto S = unit_sphere();
  const auto far = on(S)->forward(Vector3d(1, 0, 0), Vector3d(0, 100, 0));
  BOOST_TEST(S->point_defect(far.second) > 1e-3);
}

BOOST_AUTO_TEST_CASE(proposition_7_3) {
  for (const auto& S : {unit_sphere(), torus_surface()})
    for (const double theta : {0.0, 0.5})
      for (const LawResult& result : check_discretization_map(*on(S, theta), {.points = 2}))
        BOOST_TEST(result.passed(), result);
}

BOOST_AUTO_TEST_CASE(a_p_that_is_no_projector_onto_the_submanifold) {
  const auto S = unit_sphere();
  const auto P = [&](const ExprVector& y) { return S->projection(y); };
  BOOST_TEST(all_passed(check_discretization_map(WithProjector(S, P), {.points = 1})));
  // No P at all, and one that gets near.
  const WithProjector none(S, [](const ExprVector& y) { return y; });
  BOOST_TEST(fails(none, "D3 R⁻ and R⁺ lie on M"));
  const WithProjector near(
      S, [](const ExprVector& y) { return ExprVector(y * (1.5 - 0.5 * y.squaredNorm())); });
  BOOST_TEST(fails(near, "D3 R⁻ and R⁺ lie on M"));
  // Onto S, but not the identity there.
  const WithProjector turned(S, [&](const ExprVector& y) {
    return S->projection(
        (ExprVector(3) << y[0] + 1e-6 * y[1], y[1] - 1e-6 * y[0], y[2]).finished());
  });
  BOOST_TEST(!fails(turned, "D3 R⁻ and R⁺ lie on M"));
  BOOST_TEST(fails(turned, "D1"));
}

// ẋ = ∇c × ∇H on the ellipsoid by Method 1, against the classical Runge–Kutta method in R³.
BOOST_AUTO_TEST_CASE(method_1_on_an_ellipsoid_has_its_order) {
  const auto S = surface("Ellipsoid", ellipsoid_equation);
  const auto field = [](const auto& x) {
    // c = x² + y²/2 + z²/4 - 1, H = x²/2 + z + 0.3 z²
    return (std::decay_t<decltype(x)>(3) << x[1] * (1.0 + 0.6 * x[2]),
            0.5 * x[2] * x[0] - 2.0 * x[0] * (1.0 + 0.6 * x[2]), -x[1] * x[0])
        .finished();
  };
  const auto system = std::make_shared<examples::FormulaSystem>(
      S, 0, 3, [&](const ExprVector& x, const ExprVector& v, const ExprVector&, const Expr&) {
        return ExprVector(v - field(x));
      });
  const VectorXd x0 = S->project(Vector3d(0.5, 0.7, 1.1));
  const auto reference = [&] {
    VectorXd x = x0;
    constexpr int kSteps = 2000;
    const double h = 1.0 / kSteps;
    for (int i = 0; i < kSteps; ++i) {
      const VectorXd a = field(x), b = field(VectorXd(x + h / 2 * a)),
                     c = field(VectorXd(x + h / 2 * b)), d = field(VectorXd(x + h * c));
      x += h / 6 * (a + 2.0 * b + 2.0 * c + d);
    }
    return x;
  }();
  BOOST_TEST(S->point_defect(reference) < 1e-12);  // the field is tangent to S
  for (const double theta : {0.5, 0.0}) {
    const auto map = on(S, theta);
    const DiscretizeFirst method(system, map);
    BOOST_TEST(method.order() == (theta == 0.5 ? 2 : 1));
    std::vector<double> steps, errors;
    double off = 0.0;
    for (const int count : {10, 20, 40, 80, 160}) {
      const VectorXd end = method.advance({.x = x0}, 1.0 / count, count).x;
      steps.push_back(1.0 / count);
      errors.push_back((end - reference).norm());
      off = std::max(off, S->point_defect(end));
    }
    const double slope = log_log_slope(steps, errors, 1e-13);
    BOOST_TEST_MESSAGE("theta " << theta << ": slope " << slope << ", off by " << off);
    BOOST_TEST(std::abs(slope - method.order()) < 0.15, "theta " << theta << ": " << slope);
    BOOST_TEST(off < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(errors) {
  const auto S = unit_sphere();
  BOOST_CHECK_THROW(Projected(nullptr, std::make_shared<Theta>(S->surrounding())),
                    std::invalid_argument);
  BOOST_CHECK_THROW(Projected(S, nullptr), std::invalid_argument);
  BOOST_CHECK_THROW(Projected(S, std::make_shared<Theta>(std::make_shared<Euclidean>(4))),
                    std::invalid_argument);
  BOOST_CHECK_THROW(S->projection(ExprVector::Zero(2)), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
