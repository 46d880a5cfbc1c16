// The structures that matrix fields describe, by the definitions of the paper.
#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>
#include <random>

#include "catalogue.hpp"
#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/implicit_submanifold.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/closed_port_hamiltonian.hpp"
#include "courant/structures/dirac_system.hpp"
#include "courant/structures/distribution.hpp"
#include "courant/structures/lie_poisson.hpp"
#include "courant/structures/open_port_hamiltonian.hpp"
#include "courant/structures/poisson.hpp"
#include "courant/structures/presymplectic.hpp"
#include "courant/structures/rank_profile.hpp"
#include "courant/structures/restricted_bivector.hpp"
#include "courant/structures/restricted_two_form.hpp"

// Mistakes that these cases have to notice:
//  * the sign of the multiplier in Theorem 2.4
//  * the sign of the multipliers in Theorem 2.5 and of closed ports
//  * the sign of the multipliers of F ⊕ F° by one-forms
//  * the sign of the coefficients of F ⊕ F° by fields
//  * the sign of ω in the graph of a form
//  * the sign of Λ in the graph of a bivector
//  * open ports act with the wrong sign
//  * the two Lie-Poisson structures are exchanged
//  * the torsion of a frame is forgotten (structures/canonical_symplectic.cpp)
//  * what cancels to rounding is scaled up to an equation (structures/paired_subspace.cpp)
//  * the Jacobi identity is not asked for (structures/lie_algebra.cpp)
//  * so(n) with the opposite brackets (structures/lie_algebra.cpp)
BOOST_AUTO_TEST_SUITE(matrix_structures)

using namespace courant;

namespace {

constexpr double tolerance = 1e-12;

std::shared_ptr<const Manifold> R(Index n) { return std::make_shared<Euclidean>(n); }

// ω, Λ and B of R⁴ and R^{4 × 2} that depend on the point.
ExprMatrix skew4(const ExprVector& x) {
  ExprMatrix A = ExprMatrix::Zero(4, 4);
  A(0, 1) = 1.0 + square(x[2]);
  A(0, 3) = x[1];
  A(1, 2) = -2.0;
  A(2, 3) = sin(x[0]);
  return A - ExprMatrix(A.transpose());
}
ExprMatrix two_columns(const ExprVector& x) {
  ExprMatrix B(4, 2);
  B << x[1], Expr(1.0), Expr(0.3), x[0] * x[3], Expr(1.0), Expr(-1.0), x[2], Expr(0.5);
  return B;
}

const VectorXd point = VectorXd{{0.4, -0.8, 1.3, 0.7}};
MatrixXd number(const MatrixField& field) { return values(field(constants(point))); }

VectorXd residual(const DiracStructure& D, const VectorXd& v, const VectorXd& alpha,
                  const VectorXd& u) {
  return values(D.membership(constants(point), constants(v), constants(alpha), constants(u)));
}

MatrixXd annihilator(const MatrixXd& A) { return kernel(A.transpose()); }

}  // namespace

BOOST_AUTO_TEST_CASE(dirac_on_a_manifold) {
  // D_x is a linear Dirac structure on T_xM at each x, here of S², n = 2 < 3 = Ñ.
  const auto S2 = std::make_shared<Sphere>(2);
  const Presymplectic D(S2, [](const ExprVector& x) { return test::hat(x); });
  const VectorXd x = VectorXd{{0.6, 0.0, 0.8}};
  const LinearDirac at_x = D.linear(x);
  BOOST_TEST(at_x.space_dimension() == 2);
  BOOST_TEST(at_x.kind() == "graph of a symplectic form");
  // ω(v, w) = vᵀ hat(x) w = v · (x × w) = ± the area: ±1 on orthonormal vectors.
  BOOST_TEST(std::abs(std::abs(LuDecomposition(at_x.form().omega).determinant()) - 1.0) <
             tolerance);
}

// Where the normal is along an axis but for 1e-34, the equations across the tangent space are all
// noise of that size, which must not be scaled up to equations.
BOOST_AUTO_TEST_CASE(noise_across_the_tangent_space_is_no_equation) {
  const auto tilted = std::make_shared<ImplicitSubmanifold>(
      "Tilted", std::make_shared<SpecialOrthogonal3>(),
      [](const ExprVector& x) { return ExprVector(ExprVector::Constant(1, x[8] - 0.5)); }, 1);
  const double c = 0.5, s = std::sqrt(0.75);
  VectorXd x(12);
  x << 1.0, 1.8e-34, -4.1e-33, -3.6e-33, c, -s, 2.3e-34, s, c, 0.0, 0.3, 0.2;
  const auto M = std::make_shared<CotangentBundle>(tilted);
  const FibreRanks ranks = fibre_ranks(CanonicalSymplectic(M), x);
  BOOST_TEST(ranks.dimension == 4);
  BOOST_TEST(ranks.equations == 4);
}

BOOST_AUTO_TEST_CASE(example_2_2_1) {
  const auto by_forms = Distribution::annihilated_by(R(4), 2, two_columns);
  const MatrixXd mu = number(two_columns), F = annihilator(mu);
  const LinearDirac expected = LinearDirac::annihilator_sum(F);
  BOOST_TEST(distance(by_forms.linear(point), expected) < tolerance);
  // The same by the fields that span F.
  const auto by_fields = Distribution::spanned_by(R(4), 2, test::constant_field(F));
  BOOST_TEST(distance(by_fields.linear(point), expected) < tolerance);
  // The unknowns of both are those of α = μ λ and v = X c, with their sign.
  const VectorXd lambda = VectorXd{{0.9, -0.4}}, w = F * VectorXd{{0.7, -1.2}};
  const VectorXd alpha = mu * lambda;
  BOOST_TEST(residual(by_forms, w, alpha, lambda).norm() < tolerance);
  BOOST_TEST(residual(by_forms, w, alpha, -lambda).norm() > 0.1);
  BOOST_TEST(residual(by_fields, w, alpha, VectorXd{{0.7, -1.2}}).norm() < tolerance);
  BOOST_TEST(residual(by_fields, w, alpha, VectorXd{{-0.7, 1.2}}).norm() > 0.1);
  // Negative control: F itself in the place of its annihilator.
  BOOST_TEST(distance(Distribution::spanned_by(R(4), 2, two_columns).linear(point), expected) >
             0.1);
}

BOOST_AUTO_TEST_CASE(example_2_2_2) {
  const Presymplectic D(R(4), skew4);
  BOOST_TEST(distance(D.linear(point), LinearDirac::graph_of_form(number(skew4))) < tolerance);
  // ω♭(u)(v) = ω(u, v): the sign.
  const VectorXd u = VectorXd{{1.0, 2.0, -1.0, 0.5}};
  BOOST_TEST(residual(D, u, number(skew4).transpose() * u, VectorXd(0)).norm() < tolerance);
  BOOST_TEST(residual(D, u, number(skew4) * u, VectorXd(0)).norm() > 0.1);
  // The canonical form of T*R² by its matrix is CanonicalSymplectic.
  const auto M = std::make_shared<CotangentBundle>(R(2));
  MatrixXd omega = MatrixXd::Zero(4, 4);  // dq ∧ dp
  omega.topRightCorner(2, 2).setIdentity();
  omega.bottomLeftCorner(2, 2) = -MatrixXd::Identity(2, 2);
  BOOST_TEST(distance(Presymplectic(R(4), test::constant_field(omega)).linear(point),
                      CanonicalSymplectic(M).linear(point)) < tolerance);
}

BOOST_AUTO_TEST_CASE(theorem_2_4) {
  const RestrictedTwoForm D(R(4), skew4, 2, two_columns);
  const MatrixXd omega = number(skew4), F = annihilator(number(two_columns));
  const LinearDirac at_x = D.linear(point);
  // F_D = F and ω_D = ω_F, and it is the only Dirac structure with these.
  const auto [range, form] = at_x.form();
  BOOST_TEST((range - F * QrDecomposition::in_order(F).solve(range)).norm() < tolerance);
  BOOST_TEST(range.cols() == 2);
  BOOST_TEST((form - range.transpose() * omega * range).norm() < tolerance);
  const FormOnSubspace pair{F, F.transpose() * omega * F};
  BOOST_TEST(distance(at_x, LinearDirac(pair)) < tolerance);
  // By its definition: α(w) = ω(v, w) for v, w ∈ F.
  for (Index k = 0; k < at_x.dimension(); ++k) {
    const VectorXd v = at_x.vectors().col(k), alpha = at_x.covectors().col(k);
    BOOST_TEST((F.transpose() * (alpha - omega.transpose() * v)).norm() < tolerance);
  }
  // The multipliers are those of α = ωᵀ v + μ λ, with their sign: constraint forces are read off.
  const VectorXd v = F * VectorXd{{0.7, -1.2}}, multipliers = VectorXd{{0.9, -0.4}};
  const VectorXd alpha = omega.transpose() * v + number(two_columns) * multipliers;
  BOOST_TEST(residual(D, v, alpha, multipliers).norm() < tolerance);
  BOOST_TEST(residual(D, v, alpha, -multipliers).norm() > 0.1);
  // ω = 0 gives F ⊕ F°, F = TM the graph of ω.
  const MatrixField zero = test::constant_field(MatrixXd::Zero(4, 4));
  BOOST_TEST(distance(RestrictedTwoForm(R(4), zero, 2, two_columns).linear(point),
                      LinearDirac::annihilator_sum(F)) < tolerance);
  const MatrixField none = test::constant_field(MatrixXd::Zero(4, 0));
  BOOST_TEST(distance(RestrictedTwoForm(R(4), skew4, 0, none).linear(point),
                      LinearDirac::graph_of_form(omega)) < tolerance);
}

BOOST_AUTO_TEST_CASE(theorem_2_5) {
  const RestrictedBivector D(R(4), skew4, 2, two_columns);
  const MatrixXd lambda = number(skew4), F = annihilator(number(two_columns));  // F^(*)
  const LinearDirac at_x = D.linear(point);
  const BivectorOnSubspace pair{F, F.transpose() * lambda * F};
  BOOST_TEST(distance(at_x, LinearDirac(pair)) < tolerance);
  for (Index k = 0; k < at_x.dimension(); ++k) {
    const VectorXd v = at_x.vectors().col(k), alpha = at_x.covectors().col(k);
    BOOST_TEST((number(two_columns).transpose() * alpha).norm() < tolerance);
    BOOST_TEST((F.transpose() * (v - lambda * alpha)).norm() < tolerance);
  }
  // The multipliers are those of v = Λ α + X λ, with their sign.
  const VectorXd alpha = F * VectorXd{{0.7, -1.2}}, multipliers = VectorXd{{0.9, -0.4}};
  const VectorXd v = lambda * alpha + number(two_columns) * multipliers;
  BOOST_TEST(residual(D, v, alpha, multipliers).norm() < tolerance);
  BOOST_TEST(residual(D, v, alpha, -multipliers).norm() > 0.1);
  const MatrixField none = test::constant_field(MatrixXd::Zero(4, 0));
  BOOST_TEST(distance(RestrictedBivector(R(4), skew4, 0, none).linear(point),
                      LinearDirac::graph_of_bivector(lambda)) < tolerance);
}

BOOST_AUTO_TEST_CASE(equation_20) {
  // ẋ = J e + B u, y = Bᵀ e, and ⟨e, ẋ⟩ = ⟨y, u⟩.
  const OpenPortHamiltonian D(R(4), skew4, 2, two_columns);
  const VectorXd e = VectorXd{{1.0, -0.3, 0.2, 2.0}}, u = VectorXd{{0.7, -1.1}};
  const VectorXd v = number(skew4) * e + number(two_columns) * u;
  BOOST_TEST(residual(D, v, e, u).norm() < tolerance);
  const VectorXd y = values(D.output(constants(point), constants(e)));
  BOOST_TEST((y - number(two_columns).transpose() * e).norm() < tolerance);
  BOOST_TEST(std::abs(e.dot(v) - y.dot(u)) < tolerance);
  BOOST_TEST(residual(D, v, e, -u).norm() > 0.1);
}

BOOST_AUTO_TEST_CASE(equation_21) {
  BOOST_TEST(distance(Poisson(R(4), skew4).linear(point),
                      LinearDirac::graph_of_bivector(number(skew4))) < tolerance);
}

BOOST_AUTO_TEST_CASE(equation_22) {
  // With ∃ u: dimension n + rank B. (With ∀ u it is empty: v - B u = J α cannot hold for two u.)
  const OpenPortHamiltonian D(R(4), skew4, 2, two_columns);
  const PairedSubspace at_x = D.fibre(point);
  BOOST_TEST(at_x.dimension() == 6);
  MatrixXd X(4, 6), Y = MatrixXd::Zero(4, 6);
  X << number(skew4), number(two_columns);
  Y.leftCols(4).setIdentity();
  BOOST_TEST(distance(at_x, PairedSubspace::image(X, Y)) < tolerance);
}

BOOST_AUTO_TEST_CASE(equation_23) {
  const ClosedPortHamiltonian D(R(4), skew4, 2, two_columns);
  const ConstrainedRepresentation<MatrixXd> expected{number(skew4), number(two_columns)};
  BOOST_TEST(distance(D.linear(point), LinearDirac(expected)) < tolerance);
  // The unknowns are the u of v = J α + B u, with their sign.
  const VectorXd alpha = annihilator(number(two_columns)) * VectorXd{{0.7, -1.2}};
  const VectorXd u = VectorXd{{0.9, -0.4}};
  const VectorXd v = number(skew4) * alpha + number(two_columns) * u;
  BOOST_TEST(residual(D, v, alpha, u).norm() < tolerance);
  BOOST_TEST(residual(D, v, alpha, -u).norm() > 0.1);
  // The same set as in Theorem 2.5.
  BOOST_TEST(distance(D.linear(point),
                      RestrictedBivector(R(4), skew4, 2, two_columns).linear(point)) < tolerance);
}

BOOST_AUTO_TEST_CASE(proposition_7_1) {
  // On random J, B of any ranks: open coisotropic with D^⊥ = {v = Jα, Bᵀα = 0}, not Dirac unless
  // B = 0; closed Dirac and in the open one.
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 100; ++trial) {
    const Index n = 1 + trial % 7, m = static_cast<Index>(generator() % 4);
    const MatrixXd A = MatrixXd::NullaryExpr(n, n, [&] { return normal(generator); });
    MatrixXd B = MatrixXd::NullaryExpr(n, m, [&] { return normal(generator); });
    if (m > 1) B.col(1) = 2.0 * B.col(0);
    const auto J = test::constant_field(A - A.transpose()), input = test::constant_field(B);
    const VectorXd x = VectorXd::Zero(n);
    const OpenPortHamiltonian open(R(n), J, m, input);
    const ClosedPortHamiltonian closed(R(n), J, m, input);
    const PairedSubspace at_x = open.fibre(x);
    BOOST_TEST(at_x.is_coisotropic());
    BOOST_TEST(at_x.is_dirac() == (m == 0));
    BOOST_TEST(open.is_dirac() == (m == 0));
    if (m > 0) BOOST_CHECK_THROW(open.linear(x), std::domain_error);
    BOOST_TEST(closed.linear(x).is_dirac());
    BOOST_TEST(distance(intersection(at_x, closed.fibre(x)), closed.fibre(x)) < 1e-9);
    const PairedSubspace orthogonal = PairedSubspace::kernel(
        (MatrixXd(n + m, n) << MatrixXd::Identity(n, n), MatrixXd::Zero(m, n)).finished(),
        (MatrixXd(n + m, n) << -(A - A.transpose()), B.transpose()).finished());
    BOOST_TEST(distance(at_x.orthogonal(), orthogonal) < 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(equation_25) {
  // ẋ ⊕ dH ∈ D is ẋ = J dH + B u, u an auxiliary unknown.
  const auto M = R(4);
  const auto H = std::make_shared<Hamiltonian>(
      M, [](const ExprVector& x, const Expr&) { return square(x[0]) * x[1] + cos(x[2]) + x[3]; });
  const DiracSystem system(std::make_shared<OpenPortHamiltonian>(M, skew4, 2, two_columns), H);
  const VectorXd dH = VectorXd{{2.0 * 0.4 * -0.8, 0.16, -std::sin(1.3), 1.0}};
  const VectorXd u = VectorXd{{0.2, 0.9}};
  const VectorXd v = number(skew4) * dH + number(two_columns) * u;
  BOOST_TEST(system.residual(point, v, u, 0.0).norm() < tolerance);
  BOOST_TEST(system.residual(point, v, VectorXd::Zero(2), 0.0).norm() > 0.1);
}

BOOST_AUTO_TEST_CASE(equation_27) {
  // ẋ = J dH + B u, 0 = Bᵀ dH: the second part holds or does not, whatever ẋ and u are.
  const auto M = R(4);
  const auto H = std::make_shared<Hamiltonian>(
      M, [](const ExprVector& x, const Expr&) { return ExprVector(x).dot(x) / 2.0 + x[0] * x[1]; });
  const DiracSystem system(std::make_shared<ClosedPortHamiltonian>(M, skew4, 2, two_columns), H);
  VectorXd dH = point;
  dH[0] += point[1];
  dH[1] += point[0];
  const VectorXd u = VectorXd{{0.2, 0.9}};
  const VectorXd v = number(skew4) * dH + number(two_columns) * u;
  const VectorXd r = system.residual(point, v, u, 0.0);
  BOOST_TEST(r.head(4).norm() < tolerance);
  BOOST_TEST((r.tail(2) - number(two_columns).transpose() * dH).norm() < tolerance);
}

BOOST_AUTO_TEST_CASE(lie_poisson_of_so3_is_the_euler_equation) {
  const LiePoisson D(LieAlgebra::so3());
  const Eigen::Vector3d mu(0.3, -0.5, 0.8), omega(1.0, 0.4, -0.2), v = mu.cross(omega);
  const auto r = [&](const VectorXd& velocity) {
    return VectorXd(
        values(D.membership(constants(mu), constants(velocity), constants(omega), ExprVector(0))));
  };
  BOOST_TEST(r(v).norm() < 1e-15);
  BOOST_TEST(r(-v).norm() > 0.1);
  // Casimir covectors are the multiples of μ = d(|μ|²/2).
  const MatrixXd casimirs = D.linear(mu).covector_kernel();
  BOOST_TEST(casimirs.cols() == 1);
  BOOST_TEST(Eigen::Vector3d(casimirs.col(0)).cross(mu).norm() < 1e-14);
}

BOOST_AUTO_TEST_CASE(lie_poisson_of_se3_is_the_heavy_top) {
  // μ̇ = μ × Ω + γ × χ, γ̇ = γ × Ω with (Ω, χ) = dH.
  const LiePoisson D(LieAlgebra::se3());
  const Eigen::Vector3d mu(0.3, -0.5, 0.8), gamma(0.1, 0.9, 0.4), omega(1.0, 0.4, -0.2),
      chi(0.7, 0.0, 1.1);
  VectorXd x(6), v(6), dH(6);
  x << mu, gamma;
  v << mu.cross(omega) + gamma.cross(chi), gamma.cross(omega);
  dH << omega, chi;
  BOOST_TEST(values(D.membership(constants(x), constants(v), constants(dH), ExprVector(0))).norm() <
             1e-15);
  // Two Casimirs: |γ|² and ⟨μ, γ⟩.
  BOOST_TEST(fibre_ranks(D, x).casimirs() == 2);
}

BOOST_AUTO_TEST_CASE(lie_algebras) {
  // so(3) of the general family is that of the cross product, up to the sign of the second basis
  // vector: E_01 = -ê₂, E_02 = ê₁, E_12 = -ê₀.
  const LieAlgebra general = LieAlgebra::so(3);
  const auto to_r3 = [](const VectorXd& a) { return Eigen::Vector3d(-a[2], a[1], -a[0]); };
  const VectorXd a = VectorXd{{0.2, 1.0, -0.4}}, b = VectorXd{{0.9, -0.3, 0.5}};
  BOOST_TEST((to_r3(general.bracket(a, b)) - to_r3(a).cross(to_r3(b))).norm() < 1e-15);
  BOOST_TEST(LieAlgebra::so(0).dimension() == 0);
  BOOST_TEST(LieAlgebra::so(5).dimension() == 10);
  BOOST_TEST(LieAlgebra::se3().dimension() == 6);
  // The Galilean algebra of the line: a translation acts on (x, 1).
  BOOST_TEST(LieAlgebra::semidirect(LieAlgebra::abelian(1), {MatrixXd{{0.0, 1.0}, {0.0, 0.0}}})
                 .dimension() == 3);
  BOOST_CHECK_THROW(LieAlgebra("wrong", {MatrixXd::Identity(1, 1)}), std::domain_error);
  auto twisted = LieAlgebra::se3().constants();
  twisted[0](3, 4) += 0.1;
  twisted[0](4, 3) -= 0.1;
  BOOST_CHECK_THROW(LieAlgebra("no Jacobi identity", twisted), std::domain_error);
  // Not a representation: the matrices commute, the algebra does not.
  BOOST_CHECK_THROW(
      LieAlgebra::semidirect(LieAlgebra::so3(), std::vector<MatrixXd>(3, MatrixXd::Identity(2, 2))),
      std::domain_error);
}

BOOST_AUTO_TEST_CASE(sizes_are_checked) {
  const Poisson wrong(R(4), test::constant_field(MatrixXd::Zero(3, 3)));
  BOOST_CHECK_THROW(wrong.fibre(point), std::invalid_argument);
  BOOST_CHECK_THROW(LiePoisson(LieAlgebra::so3(), R(4)), std::invalid_argument);
  BOOST_CHECK_THROW(Presymplectic(nullptr, skew4), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
