#include "courant/structures/generating_family.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/dirac_system.hpp"
#include "courant/structures/laws.hpp"
#include "courant/structures/poisson.hpp"

// Mistakes that these cases have to notice:
//  * the energy of a Lagrangian with the wrong sign
//  * nothing determines the normal part of a velocity
//  * the differential is not brought to the frame
//  * derivatives of large energies are differences of rounding errors (structures/laws.cpp)
BOOST_AUTO_TEST_SUITE(generating_family)

using namespace courant;

namespace {

// A Lagrangian on R² without symmetry, singular (linear in w₁).
Expr lagrangian(const ExprVector& q, const ExprVector& w) {
  return 0.5 * exp(q[1]) * square(w[0]) + sin(q[0]) * w[1] - square(q[0]) * q[1];
}

// 𝓘_{TQ}: (q, p, μ_q, μ_p) ↦ (q, μ_p, -μ_q, p) on vectors of 4 × 2 entries (equation (5)).
ExprVector tulczyjew(const ExprVector& point) {
  ExprVector image(8);
  image << point.head(2), point.tail(2), -point.segment(4, 2), point.segment(2, 2);
  return image;
}

// The canonical form of a cotangent bundle with base coordinates first: dx ∧ dy on R⁴ × R⁴.
MatrixXd canonical_form() {
  MatrixXd omega = MatrixXd::Zero(8, 8);
  omega.topRightCorner(4, 4).setIdentity();
  omega.bottomLeftCorner(4, 4) = -MatrixXd::Identity(4, 4);
  return omega;
}

}  // namespace

// An antisymplectomorphism of T*T*Q and T*TQ.
BOOST_AUTO_TEST_CASE(equation_5) {
  Graph graph;
  const ExprVector point = graph.variables("point", 8);
  const MatrixXd derivative = values(jacobian(tulczyjew(point), point).dense());
  BOOST_TEST((derivative.transpose() * canonical_form() * derivative + canonical_form()).norm() ==
             0.0);
}

// 𝓛 = 𝓘⁻¹(Im dL) is what the family generates, with P_q = -∂L/∂q; and it is Lagrangian in T*T*Q.
BOOST_AUTO_TEST_CASE(lagrangian_submanifold) {
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(2));
  const Lagrangian family(
      M, [](const ExprVector& q, const ExprVector& w, const Expr&) { return lagrangian(q, w); });
  Graph graph;
  const ExprVector qw = graph.variables("qw", 4);
  const ExprVector dL = gradient(lagrangian(qw.head(2), qw.tail(2)), qw);
  ExprVector x(4);  // over (q, w): p = ∂L/∂w, where ∂_λE = 0
  x << qw.head(2), dL.tail(2);
  ExprVector element(8);
  element << x, family.differential(x, qw.tail(2), 0.0);
  ExprVector expected(8);  // dL as a point (q, w, ∂_qL, ∂_wL) of T*TQ
  expected << qw, dL;
  const VectorXd at = VectorXd{{0.4, -0.3, 1.1, 0.6}};
  const auto number = [&](const ExprVector& y) {
    return VectorXd(values(substitute(y, qw, constants(at))));
  };
  BOOST_TEST((number(tulczyjew(element)) - number(expected)).norm() < 1e-15);
  BOOST_TEST(number(family.stationarity(x, qw.tail(2), 0.0)).norm() < 1e-15);

  const ExprMatrix tangent = jacobian(element, qw).dense();
  MatrixXd T(8, 4);
  for (Index k = 0; k < 4; ++k) T.col(k) = number(ExprVector(tangent.col(k)));
  BOOST_TEST(decide_rank(T).rank == 4);
  BOOST_TEST((T.transpose() * canonical_form() * T).norm() < 1e-14);
  // With P_q = -∂L/∂w, as printed, it is not.
  ExprVector printed = element;
  printed.segment(4, 2) = -dL.tail(2);
  const ExprMatrix other = jacobian(printed, qw).dense();
  for (Index k = 0; k < 4; ++k) T.col(k) = number(ExprVector(other.col(k)));
  BOOST_TEST((T.transpose() * canonical_form() * T).norm() > 0.1);
}

BOOST_AUTO_TEST_CASE(morse_family) {
  // L = ½ m w² e^{q} - k q²: 𝓛 = {(-∂_qL, w) : p = ∂_wL} with P_q = -∂L/∂q (docs/errata.md).
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(1));
  const Lagrangian family(M, [](const ExprVector& q, const ExprVector& w, const Expr&) {
    return 0.5 * 1.3 * square(w[0]) * exp(q[0]) - 0.6 * square(q[0]);
  });
  const double q = 0.3, p = 0.7, w = -0.4;
  const ExprVector x = constants((VectorXd(2) << q, p).finished());
  const ExprVector lambda = constants(VectorXd::Constant(1, w));
  const VectorXd differential = values(family.differential(x, lambda, 0.0));
  BOOST_TEST(differential[0] == -(0.65 * w * w * std::exp(q) - 1.2 * q),
             boost::test_tools::tolerance(1e-15));
  BOOST_TEST(differential[1] == w);
  BOOST_TEST(values(family.stationarity(x, lambda, 0.0))[0] == p - 1.3 * w * std::exp(q),
             boost::test_tools::tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(energy_of_a_degenerate_lagrangian_is_its_hamiltonian) {
  // L = ⟨α(q), w⟩ - H(q): E_L = H(q) for every w and p, on and off M_0.
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(2));
  const auto H = [](const ExprVector& q) { return square(q[0]) + 0.3 * square(square(q[1])); };
  const Lagrangian family(M, [&H](const ExprVector& q, const ExprVector& w, const Expr&) {
    return q[0] * w[1] - H(q);
  });
  const VectorXd x = (VectorXd(4) << 0.2, -0.8, 5.0, 6.0).finished();
  const VectorXd w = (VectorXd(2) << 3.0, -2.0).finished();
  BOOST_TEST(family.energy(constants(x), constants(w), 0.0).value() == H(constants(x)).value(),
             boost::test_tools::tolerance(1e-14));
}

// λ of a Lagrangian is the velocity; of others nothing is known.
BOOST_AUTO_TEST_CASE(parameters_are_guessed_from_the_velocity) {
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(2));
  const VectorXd x = VectorXd::Zero(4);
  const VectorXd v = (VectorXd(4) << 0.3, -2.0, 5.0, 7.0).finished();
  const auto lagrangian = std::make_shared<Lagrangian>(
      M, [](const ExprVector&, const ExprVector& w, const Expr&) { return w.squaredNorm(); });
  BOOST_TEST((lagrangian->parameter_guess(x, v) - v.head(2)).norm() == 0.0);
  const Hamiltonian hamiltonian(M, [](const ExprVector& y, const Expr&) { return y[0]; });
  BOOST_TEST(hamiltonian.parameter_guess(x, v).size() == 0);

  const DiracSystem system(std::make_shared<CanonicalSymplectic>(M), lagrangian);
  BOOST_TEST((system.auxiliary_guess(x, v) - v.head(2)).norm() == 0.0);
  BOOST_TEST((system.auxiliary_guess(x, VectorXd()) - VectorXd::Zero(2)).norm() == 0.0);
  BOOST_CHECK_THROW(system.auxiliary_guess(x, x.head(3)), std::invalid_argument);
}

namespace {

// E(x, λ) = c x λ + λ³/3 + x²/2 + d |x - 0.301| on the line: ∂_λE = c x + λ², and
// ∂_λ(∂_xE, ∂_λE) = (c, 2λ) has rank 0 at λ = 0 if c = 0.
class Cubic final : public GeneratingFamily {
 public:
  explicit Cubic(double coupling, double kink = 0.0)
      : GeneratingFamily(std::make_shared<Euclidean>(1), 1), coupling_(coupling), kink_(kink) {}
  std::optional<bool> is_morse() const override { return true; }

 private:
  Expr do_value(const ExprVector& x, const ExprVector& lambda, const Expr&) const override {
    const Expr cube = lambda[0] * lambda[0] * lambda[0] / 3.0;
    return coupling_ * x[0] * lambda[0] + cube + 0.5 * square(x[0]) + kink_ * abs(x[0] - 0.301);
  }
  double coupling_, kink_;
};

bool passes(const GeneratingFamily& family, const FamilyPoint& at, const std::string& law) {
  for (const LawResult& result : check_generating_family(family, std::span(&at, 1)))
    if (result.law.starts_with(law)) return result.passed();
  return false;
}

}  // namespace

BOOST_AUTO_TEST_CASE(laws_hold) {
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Sphere>(2));
  std::mt19937 generator(4);
  std::vector<FamilyPoint> points;
  for (int i = 0; i < 3; ++i) {
    const VectorXd x = M->random_point(generator);
    points.push_back({x, M->base()->random_tangent(M->position(x), 0.7, generator)});
  }
  const Lagrangian singular(
      M, [](const ExprVector& q, const ExprVector& w, const Expr&) { return q[0] * w[1] - q[2]; });
  const Lagrangian regular(M, [](const ExprVector& q, const ExprVector& w, const Expr& t) {
    return 0.5 * w.squaredNorm() - q[2] * cos(t);
  });
  for (const Lagrangian* family : {&singular, &regular}) {
    const auto results = check_generating_family(*family, points);
    BOOST_TEST(results.size() == 2U);
    for (const LawResult& result : results) BOOST_TEST(result.passed(), result);
  }
  const Hamiltonian hamiltonian(M, [](const ExprVector& x, const Expr&) { return x[0] * x[4]; });
  for (FamilyPoint& point : points) point.lambda.resize(0);
  for (const LawResult& result : check_generating_family(hamiltonian, points))
    BOOST_TEST(result.passed(), result);
}

BOOST_AUTO_TEST_CASE(laws_reject_what_is_planted) {
  const FamilyPoint at{VectorXd::Zero(1), VectorXd::Zero(1)};
  BOOST_TEST(passes(Cubic(1.0), at, "G2"));
  BOOST_TEST(!passes(Cubic(0.0), at, "G2"));  // no Morse family, though it says so
  const FamilyPoint near_a_kink{VectorXd::Constant(1, 0.3), VectorXd::Zero(1)};
  BOOST_TEST(passes(Cubic(1.0), near_a_kink, "G1"));
  BOOST_TEST(!passes(Cubic(1.0, 1e-3), near_a_kink, "G1"));
}

// The Earth around the Sun in SI units: on steps of 10⁻² m an energy of 10³³ J changes by its rounding.
BOOST_AUTO_TEST_CASE(laws_hold_where_energies_are_large) {
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(2));
  const double m = 5.97e24, GM = 1.327e20;
  const Hamiltonian kepler(M, [=](const ExprVector& x, const Expr&) {
    return (square(x[2]) + square(x[3])) / (2.0 * m) - GM * m / sqrt(square(x[0]) + square(x[1]));
  });
  const FamilyPoint perihelion{Eigen::Vector4d(1.471e11, 0.0, 0.0, 3.0287e4 * m), VectorXd(0)};
  BOOST_TEST(passes(kepler, perihelion, "G1"));
}

BOOST_AUTO_TEST_CASE(claims_of_a_family_and_of_its_system) {
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(1));
  const auto lagrangian = std::make_shared<Lagrangian>(
      M, [](const ExprVector&, const ExprVector& w, const Expr&) { return w.squaredNorm(); });
  const auto canonical = std::make_shared<CanonicalSymplectic>(M);
  BOOST_TEST(DiracSystem(canonical, lagrangian).is_lagrangian().value_or(false));
  // The same form as a bivector is not known to be canonical; damping makes a system of another
  // kind.
  const auto bivector = std::make_shared<Poisson>(M, [](const ExprVector&) {
    ExprMatrix J = ExprMatrix::Zero(2, 2);
    J(0, 1) = 1.0, J(1, 0) = -1.0;
    return J;
  });
  BOOST_TEST(!DiracSystem(bivector, lagrangian).is_lagrangian().has_value());
}

BOOST_AUTO_TEST_CASE(wrong_sizes_are_refused) {
  const Hamiltonian family(std::make_shared<Euclidean>(2),
                           [](const ExprVector& x, const Expr&) { return x[0]; });
  BOOST_CHECK_THROW(family.value(ExprVector::Zero(3), ExprVector(0), 0.0), std::invalid_argument);
}

// On T*S² with w ∈ R³: the family is a Morse family (rank k = 3 of ∂_λ(∂_xE, ∂_λE)), so that w is
// determined, and tangent; without the term for its normal part the rank would be 2.
BOOST_AUTO_TEST_CASE(velocities_are_tangent_where_they_have_more_components_than_dimensions) {
  const auto sphere = std::make_shared<Sphere>(2);
  const auto M = std::make_shared<CotangentBundle>(sphere);
  const Lagrangian family(M, [](const ExprVector& q, const ExprVector& w, const Expr&) {
    return 0.5 * w.squaredNorm() + 0.3 * w[0] * w[1] - q[2];
  });
  std::mt19937 generator(6);
  const VectorXd x = M->random_point(generator);
  Graph graph;
  const ExprVector w = graph.variables("w", 3);
  ExprVector both(9);
  both << family.differential(constants(x), w, 0.0), family.stationarity(constants(x), w, 0.0);
  const ExprVector entries = jacobian(both, w).dense().reshaped();
  const MatrixXd by_w =
      values(substitute(entries, w, ExprVector::Zero(3))).reshaped(both.size(), 3);
  BOOST_TEST(decide_rank(by_w).rank == 3);
  // Stationarity is linear in w here.
  const MatrixXd A = by_w.bottomRows(3);
  const VectorXd at_zero =
      values(substitute(family.stationarity(constants(x), w, 0.0), w, ExprVector::Zero(3)));
  const VectorXd solution = CompleteOrthogonalDecomposition(A).solve(-at_zero);
  BOOST_TEST(std::abs(solution.dot(M->position(x))) < 1e-14);
  BOOST_TEST(solution.norm() > 1e-3);
}

// On SO(3) the covector is in the frame: ⟨dH, e_i⟩ = d/ds H(R_x(s e_i)), s = 0.
BOOST_AUTO_TEST_CASE(differential_is_in_the_frame_of_the_manifold) {
  const auto G = std::make_shared<SpecialOrthogonal3>();
  const auto energy = [](const ExprVector& x, const Expr& t) {
    return x[0] * x[5] + square(x[7]) + t * x[1];
  };
  const Hamiltonian family(G, energy);
  std::mt19937 generator(3);
  const VectorXd x = G->random_point(generator);
  const VectorXd dH = values(family.differential(constants(x), ExprVector(0), Expr(0.7)));
  BOOST_TEST(dH.size() == 3);
  for (Index i = 0; i < 3; ++i) {
    Graph graph;
    const ExprVector s = graph.variables("s", 1);
    const ExprVector step = s[0] * constants(VectorXd::Unit(3, i));
    const ExprVector slope = gradient(energy(G->retract(constants(x), step), Expr(0.7)), s);
    BOOST_TEST(dH[i] == values(substitute(slope, s, ExprVector::Zero(1)))[0],
               boost::test_tools::tolerance(1e-13));
  }
}

// On a sphere in R³ velocities have a normal part, which the Lagrangian does not know: it is zero where
// the family is stationary.
BOOST_AUTO_TEST_CASE(normal_parts_of_velocities_vanish) {
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Sphere>(2));
  const Lagrangian family(M, [](const ExprVector& q, const ExprVector& w, const Expr&) {
    return 0.5 * w.squaredNorm() - q[2];
  });
  const VectorXd q = VectorXd{{0.6, 0.0, 0.8}}, p = VectorXd{{0.0, 1.3, 0.0}};
  for (const double normal : {0.0, 0.7, -2.0}) {
    const VectorXd w = p + normal * q;
    ExprVector x(6);
    x << constants(q), constants(p);
    const VectorXd stationarity = values(family.stationarity(x, constants(w), 0.0));
    BOOST_TEST(std::fabs(q.dot(stationarity) - normal) < 1e-14);
    BOOST_TEST((stationarity - normal * q).norm() < 1e-14);
  }
}

BOOST_AUTO_TEST_SUITE_END()
