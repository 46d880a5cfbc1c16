// Structures made of other structures, held against the linear algebra of their fibres.
#include <Eigen/Geometry>
#include <array>
#include <boost/test/unit_test.hpp>
#include <sstream>

#include "catalogue.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/structures/composed.hpp"
#include "courant/structures/dirac_interconnection.hpp"
#include "courant/structures/gauge_transformed.hpp"
#include "courant/structures/lie_poisson.hpp"
#include "courant/structures/poisson.hpp"
#include "courant/structures/presymplectic.hpp"
#include "courant/structures/product_structure.hpp"
#include "courant/structures/pullback.hpp"
#include "courant/structures/pushforward.hpp"
#include "courant/structures/rank_profile.hpp"

// Mistakes that these cases have to notice:
//  * a gauge transformation goes the wrong way
//  * flows of a shared port do not change sign
//  * a pull-back without the derivative of the map
//  * a null structure is used before it is refused
BOOST_AUTO_TEST_SUITE(derived_structures)

using namespace courant;

namespace {

constexpr double tolerance = 1e-11;

std::shared_ptr<const Manifold> R(Index n) { return std::make_shared<Euclidean>(n); }

ExprMatrix skew3(const ExprVector& x) {
  ExprVector a(3);
  a << x[1] * x[2], 1.0 + square(x[0]), sin(x[2]);
  return test::hat(a);
}

VectorXd random_point(const Manifold& M, unsigned seed) {
  std::mt19937 generator(seed);
  return M.random_point(generator);
}

// The bivector [J B; -Bᵀ 0] of an oscillator (q, p) whose port acts with strength q on p.
std::shared_ptr<const Poisson> oscillator_with_port() {
  return std::make_shared<Poisson>(R(3), [](const ExprVector& x) {
    ExprMatrix A = ExprMatrix::Zero(3, 3);
    A(0, 1) = 1.0;
    A(1, 2) = x[0];
    return ExprMatrix(A - ExprMatrix(A.transpose()));
  });
}

}  // namespace

BOOST_AUTO_TEST_CASE(gauge_transformations) {
  const auto D = std::make_shared<LiePoisson>(LieAlgebra::so3());
  const VectorXd x = VectorXd{{0.4, -0.8, 1.3}};
  const GaugeTransformed transformed(D, skew3);
  const MatrixXd B = values(skew3(constants(x)));
  BOOST_TEST(distance(transformed.linear(x), D->linear(x).gauge_transformed(B)) < tolerance);
  BOOST_TEST(distance(transformed.linear(x), D->linear(x)) > 1e-2);
  // By -B it goes back.
  const GaugeTransformed back(std::make_shared<GaugeTransformed>(D, skew3),
                              [](const ExprVector& y) { return ExprMatrix(-skew3(y)); });
  BOOST_TEST(distance(back.linear(x), D->linear(x)) < tolerance);
}

BOOST_AUTO_TEST_CASE(products) {
  const auto A = std::make_shared<LiePoisson>(LieAlgebra::so3());
  const auto B = std::make_shared<Presymplectic>(R(3), skew3);
  const ProductStructure both({A, B});
  const VectorXd a = VectorXd{{0.1, 0.5, -0.3}}, b = VectorXd{{0.4, -0.8, 1.3}};
  VectorXd x(6);
  x << a, b;
  BOOST_TEST(distance(both.linear(x), product(A->linear(a), B->linear(b))) < tolerance);
  BOOST_CHECK_THROW(
      ProductStructure({A, B}, std::make_shared<Product>(
                                   std::vector<std::shared_ptr<const Manifold>>{R(2), R(4)})),
      std::invalid_argument);
}

// A ∘ B at a point is the composition of the fibres.
BOOST_AUTO_TEST_CASE(compositions_are_those_of_the_fibres) {
  const auto A = oscillator_with_port(), B = oscillator_with_port();
  const Composed joined(A, R(2), B, R(2), 1);
  const VectorXd x = VectorXd{{0.7, 0.2, -1.1, 0.4}};
  const auto with_port = [](const VectorXd& y) {
    return VectorXd((VectorXd(3) << y, 0.0).finished());
  };
  const std::array<Index, 1> port{2};
  const LinearDirac expected =
      composition(A->linear(with_port(x.head(2))), port, B->linear(with_port(x.tail(2))), port);
  BOOST_TEST(distance(joined.linear(x), expected) < tolerance);
  BOOST_CHECK_THROW(Composed(A, R(3), B, R(2), 1), std::invalid_argument);
}

// The port of an oscillator has strength q. At q_A = q_B = 0 the port exchanges nothing, and the
// constraint q_A e_A + q_B e_B = 0 that the composition makes is gone: D is Dirac there too, but
// not smooth.
BOOST_AUTO_TEST_CASE(a_composition_jumps_where_its_rank_does) {
  const Composed joined(oscillator_with_port(), R(2), oscillator_with_port(), R(2), 1);
  std::vector<VectorXd> family;
  for (int k = -4; k <= 4; ++k) family.push_back(0.25 * k * VectorXd{{1.0, 0.3, -2.0, 0.8}});
  const RankProfile profile = rank_profile(joined, family);
  BOOST_TEST((profile.jumps == std::vector<std::size_t>{4}));
  BOOST_TEST(!profile.is_smooth());
  BOOST_TEST(profile.generic.covector_range == 3);
  BOOST_TEST(profile.at[4].covector_range == 4);
  for (const VectorXd& x : family) BOOST_TEST(joined.linear(x).is_dirac());
  std::ostringstream text;
  text << profile;
  BOOST_TEST(text.str().find("point 4") != std::string::npos);
  BOOST_TEST(text.str().find("the rank jumps") != std::string::npos);
  // Away from the point it is smooth.
  family.erase(family.begin() + 4);
  BOOST_TEST(rank_profile(joined, family).is_smooth());
}

// The graph of a bivector is smooth where its rank drops: a singular leaf, no jump.
BOOST_AUTO_TEST_CASE(a_singular_leaf_is_no_jump) {
  const LiePoisson D(LieAlgebra::so3());
  const std::vector<VectorXd> points{VectorXd{{1.0, 0.0, 0.0}}, VectorXd::Zero(3),
                                     VectorXd{{0.0, 2.0, 1.0}}};
  const RankProfile profile = rank_profile(D, points);
  BOOST_TEST(profile.is_smooth());
  BOOST_TEST((profile.singular == std::vector<std::size_t>{1}));
  BOOST_TEST(profile.at[1].vector_range == 0);
  BOOST_TEST(profile.generic.rank_of_form() == 2);
}

// φ^!(graph of ω) is the graph of φ*ω: a form of R³ on the sphere, and on SO(3) by R ↦ R e₂.
BOOST_AUTO_TEST_CASE(pullbacks) {
  const auto space = R(3);
  const std::shared_ptr<const Manifold> sphere = std::make_shared<Sphere>(2);
  const auto form = std::make_shared<Presymplectic>(space, skew3);
  const Pullback on_sphere(SmoothMap(sphere, space, [](const ExprVector& x) { return x; }), form);
  const VectorXd x = random_point(*sphere, 1);
  const MatrixXd basis = sphere->tangent_basis(x);
  BOOST_TEST(distance(on_sphere.linear(x), backward_image(basis, form->linear(x))) < tolerance);
  const MatrixXd omega = basis.transpose() * values(skew3(constants(x))) * basis;
  BOOST_TEST(distance(on_sphere.linear(x),
                      LinearDirac::graph_of_form(0.5 * (omega - omega.transpose()))) < tolerance);

  const std::shared_ptr<const Manifold> rotations = std::make_shared<SpecialOrthogonal3>();
  const SmoothMap axis(rotations, sphere, [](const ExprVector& R_) {
    ExprVector column(3);
    column << R_[2], R_[5], R_[8];
    return column;
  });
  const auto area = std::make_shared<Presymplectic>(
      sphere, [](const ExprVector& y) { return ExprMatrix(test::hat(y)); });
  const Pullback on_rotations(axis, area);
  const VectorXd rotation = random_point(*rotations, 2);
  // d/ds R exp(s ŵ) e₂ = R (w × e₂), and y · (Ra × Rb) with y = R e₂ is e₂ · (a × b): ω(v, w) =
  // vᵀ hat(e₂) w up to the sign of the rotation by 90°, the identity on it.
  const Eigen::Vector3d e2(0.0, 0.0, 1.0);
  MatrixXd expected(3, 3);
  for (Index i = 0; i < 3; ++i)
    for (Index j = 0; j < 3; ++j) {
      const Eigen::Vector3d a = Eigen::Vector3d::Unit(i).cross(e2),
                            b = Eigen::Vector3d::Unit(j).cross(e2);
      expected(i, j) = a.dot(e2.cross(b));
    }
  BOOST_TEST(distance(on_rotations.linear(rotation), LinearDirac::graph_of_form(expected)) <
             tolerance);
  BOOST_CHECK_THROW(Pullback(axis, form), std::invalid_argument);
}

// φ_!(graph of Λ) is the graph of φ_*Λ: reduction of T*SO(3) = SO(3) × R³, in the left-invariant
// frame, to so(3)*.
BOOST_AUTO_TEST_CASE(pushforwards) {
  const auto reduced = std::make_shared<LiePoisson>(LieAlgebra::so3());
  const auto canonical = test::structure_catalogue()[2].structure;  // on T*SO(3)
  const std::shared_ptr<const Manifold> M = canonical->manifold(), dual = reduced->manifold();
  const SmoothMap momentum(M, dual, [](const ExprVector& x) { return ExprVector(x.tail(3)); });
  const SmoothMap section(dual, M, [](const ExprVector& mu) {
    ExprVector x = ExprVector::Zero(12);
    x[0] = x[4] = x[8] = 1.0;
    x.tail(3) = mu;
    return x;
  });
  const Pushforward D(momentum, section, canonical);
  const VectorXd mu = VectorXd{{0.3, -0.5, 0.8}};
  BOOST_TEST(distance(D.linear(mu), reduced->linear(mu)) < tolerance);
  BOOST_TEST(distance(D.linear(mu),
                      LiePoisson(LieAlgebra::so3(), LiePoisson::Sign::plus).linear(mu)) > 0.1);
  BOOST_CHECK_THROW(Pushforward(momentum, momentum, canonical), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(what_is_missing_is_refused) {
  const auto D = std::make_shared<LiePoisson>(LieAlgebra::so3());
  const SmoothMap identity(D->manifold(), D->manifold(), [](const ExprVector& x) { return x; });
  BOOST_CHECK_THROW(GaugeTransformed(nullptr, skew3), std::invalid_argument);
  BOOST_CHECK_THROW(ProductStructure({D, nullptr}), std::invalid_argument);
  BOOST_CHECK_THROW(Composed(nullptr, R(2), D, R(2), 1), std::invalid_argument);
  BOOST_CHECK_THROW(Composed(D, R(2), nullptr, R(2), 1), std::invalid_argument);
  BOOST_CHECK_THROW(Pullback(identity, nullptr), std::invalid_argument);
  BOOST_CHECK_THROW(Pushforward(identity, identity, nullptr), std::invalid_argument);
}

// The unknowns (f, e) of a shared port are its flow and effort as A has them; B has (-f, e).
BOOST_AUTO_TEST_CASE(the_unknowns_of_a_composition_are_flow_and_effort_of_the_port) {
  const auto A = oscillator_with_port(), B = oscillator_with_port();
  const Composed joined(A, R(2), B, R(2), 1);
  const VectorXd x = VectorXd{{0.7, 0.2, -1.1, 0.4}}, alpha = VectorXd{{0.3, -0.8, 0.5, 0.6}};
  // Of each part q' = e_p, p' = -e_q + q e, f = -q e_p.
  const double e = 1.7;
  const VectorXd v = VectorXd{{-0.8, -0.3 + 0.7 * e, 0.6, -0.5 - 1.1 * e}};
  const double f = 0.7 * 0.8;
  const auto residual = [&](double flow, double effort) {
    return VectorXd(values(joined.membership(constants(x), constants(v), constants(alpha),
                                             constants(VectorXd{{flow, effort}}))));
  };
  // f_A = f solves the equations of A, and -f enters B, whose own flow is 1.1 · 0.6.
  const VectorXd r = residual(f, e);
  BOOST_TEST(r.head(3).norm() < 1e-15);
  BOOST_TEST(r.segment(3, 2).norm() < 1e-15);
  BOOST_TEST(std::abs(r[5] - (-f - 1.1 * 0.6)) < 1e-15);
  BOOST_TEST(std::abs(residual(-f, e)[2]) > 0.5);
  BOOST_TEST(std::abs(residual(f, -e)[1]) > 0.5);
}

BOOST_AUTO_TEST_SUITE_END()
