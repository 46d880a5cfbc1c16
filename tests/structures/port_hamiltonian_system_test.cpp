#include "courant/structures/port_hamiltonian_system.hpp"

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

#include "catalogue.hpp"
#include "courant/core/expressions/derivative.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/structures/closed_port_hamiltonian.hpp"
#include "courant/structures/dirac_system.hpp"

// Mistakes that these cases have to notice:
//  * resistors give energy instead of taking it
//  * ports act with the wrong sign
//  * inputs are those at time 0
//  * the energy of the equations is that at time 0
//  * what is missing is used before it is checked
BOOST_AUTO_TEST_SUITE(port_hamiltonian_system)

using namespace courant;

namespace {

constexpr double kTolerance = 1e-14;

// On R³, all of them functions of the point: J skew, R = g gᵀ, B with two columns, and
// H = x₀² x₁ + cos x₂ + t x₁.
ExprMatrix J(const ExprVector& x) {
  ExprMatrix A = ExprMatrix::Zero(3, 3);
  A(0, 1) = 1.0 + square(x[2]);
  A(0, 2) = x[1];
  A(1, 2) = -2.0;
  return A - ExprMatrix(A.transpose());
}
ExprMatrix R(const ExprVector& x) {
  ExprVector g(3);
  g << x[0], Expr(0.7), x[1] * x[2];
  return g * g.transpose();
}
ExprMatrix B(const ExprVector& x) {
  ExprMatrix columns(3, 2);
  columns << x[1], Expr(1.0), Expr(0.3), x[0] * x[2], Expr(-1.0), x[2];
  return columns;
}
Expr H(const ExprVector& x, const Expr& t) { return square(x[0]) * x[1] + cos(x[2]) + t * x[1]; }

const VectorXd kPoint = VectorXd{{0.4, -0.8, 1.3}};
constexpr double kTime = 0.6;

VectorXd dH() { return VectorXd{{2.0 * 0.4 * -0.8, 0.4 * 0.4 + kTime, -std::sin(1.3)}}; }
MatrixXd number(ExprMatrix (*field)(const ExprVector&)) { return values(field(constants(kPoint))); }

std::shared_ptr<const GeneratingFamily> energy() {
  return std::make_shared<Hamiltonian>(std::make_shared<Euclidean>(3), H);
}

using Input = PortHamiltonianSystem::Input;

PortHamiltonianSystem with_ports(std::optional<Input> input, MatrixField resistance = R) {
  return PortHamiltonianSystem({.J = J, .R = std::move(resistance), .B = B, .m = 2}, energy(),
                               std::move(input));
}

// u₀ = sin t - 2 y₀, u₁ = y₀ y₁ + t: of time and of both outputs.
ExprVector feedback(const Expr& t, const ExprVector& y) {
  ExprVector u(2);
  u << sin(t) - 2.0 * y[0], y[0] * y[1] + t;
  return u;
}
VectorXd fed_back(const VectorXd& y) {
  return VectorXd{{std::sin(kTime) - 2.0 * y[0], y[0] * y[1] + kTime}};
}

// dH/dt along the motion with ports u, less what time itself changes in H.
double power(const VectorXd& v) { return dH().dot(v); }

}  // namespace

// v = (J - R) dH + B u with each of J, R, B at the point, and dH at the time.
BOOST_AUTO_TEST_CASE(motion_of_the_open_system) {
  const PortHamiltonianSystem open = with_ports(feedback);
  BOOST_TEST(!open.is_free(0));
  BOOST_TEST(open.auxiliary_size() == 2);
  BOOST_TEST(open.equation_count() == 5);
  const VectorXd y = number(B).transpose() * dH(), u = fed_back(y);
  const VectorXd v = (number(J) - number(R)) * dH() + number(B) * u;
  BOOST_TEST(open.residual(kPoint, v, u, kTime).norm() < kTolerance);
  // Each entry of v and of u counts, and so does time.
  for (Index i = 0; i < 3; ++i)
    BOOST_TEST(open.residual(kPoint, v + 1e-3 * VectorXd::Unit(3, i), u, kTime).norm() > 5e-4);
  for (Index i = 0; i < 2; ++i)
    BOOST_TEST(open.residual(kPoint, v, u + 1e-3 * VectorXd::Unit(2, i), kTime).norm() > 5e-4);
  BOOST_TEST(open.residual(kPoint, v, u, kTime + 1e-2).norm() > 1e-3);
}

// y = B(x)ᵀ dH(x, t) is what u is fed back from: without feedthrough y does not contain u.
BOOST_AUTO_TEST_CASE(outputs_and_the_feedback_from_them) {
  const PortHamiltonianSystem open = with_ports(feedback);
  const VectorXd y = values(open.output(constants(kPoint), constants(dH()), ExprVector(2)));
  BOOST_TEST((y - number(B).transpose() * dH()).norm() < kTolerance);
  // The last equations are u - input(t, y), whatever v and u are.
  const VectorXd v = VectorXd{{0.3, 2.0, -1.0}}, u = VectorXd{{0.9, -0.2}};
  const VectorXd r = open.residual(kPoint, v, u, kTime);
  BOOST_TEST((r.tail(2) - (u - fed_back(y))).norm() < kTolerance);
}

// With D(x), y = Bᵀ dH + D u, and u depends on itself by way of y. Along the motion
// dH/dt = ⟨y, u⟩ - dHᵀ R dH - uᵀ D u.
BOOST_AUTO_TEST_CASE(feedthrough) {
  const auto D = [](const ExprVector& x) {
    ExprMatrix matrix(2, 2);
    matrix << Expr(2.0), x[0], -x[0], square(x[1]);
    return matrix;
  };
  const auto system = [&](std::optional<Input> input) {
    return PortHamiltonianSystem({.J = J, .R = R, .B = B, .m = 2, .D = D}, energy(),
                                 std::move(input));
  };
  const VectorXd u = VectorXd{{0.9, -0.2}};
  const MatrixXd D_number = values(D(constants(kPoint)));
  const VectorXd y = number(B).transpose() * dH() + D_number * u;
  const VectorXd v = (number(J) - number(R)) * dH() + number(B) * u;
  const VectorXd r = system(feedback).residual(kPoint, v, u, kTime);
  BOOST_TEST(r.head(3).norm() < kTolerance);
  BOOST_TEST((r.tail(2) - (u - fed_back(y))).norm() < kTolerance);
  BOOST_TEST((system(std::nullopt).residual(kPoint, v, u, kTime).tail(2) - y).norm() < kTolerance);
  BOOST_TEST((values(system(feedback).output(constants(kPoint), constants(dH()), constants(u))) - y)
                 .norm() < kTolerance);
  BOOST_TEST(std::abs(power(v) - (y.dot(u) - dH().dot(number(R) * dH()) - u.dot(D_number * u))) <
             1e-13);
}

BOOST_AUTO_TEST_CASE(closed_ports_have_no_output) {
  const PortHamiltonianSystem closed = with_ports(std::nullopt);
  BOOST_TEST(closed.is_free(0));
  const VectorXd v = VectorXd{{0.3, 2.0, -1.0}}, u = VectorXd{{0.9, -0.2}};
  const VectorXd r = closed.residual(kPoint, v, u, kTime);
  BOOST_TEST((r.head(3) - (v - (number(J) - number(R)) * dH() - number(B) * u)).norm() <
             kTolerance);
  BOOST_TEST((r.tail(2) - number(B).transpose() * dH()).norm() < kTolerance);
}

// Without R it is the Dirac system of ClosedPortHamiltonian(J, B), equation for equation.
BOOST_AUTO_TEST_CASE(without_resistance_it_is_the_dirac_system_of_its_structure) {
  const auto family = energy();
  const PortHamiltonianSystem closed({.J = J, .R = {}, .B = B, .m = 2}, family, std::nullopt);
  const DiracSystem dirac(std::make_shared<ClosedPortHamiltonian>(family->manifold(), J, 2, B),
                          family);
  std::mt19937 generator(2);
  std::normal_distribution<double> normal;
  const auto random = [&](Index size) {
    return VectorXd(VectorXd::NullaryExpr(size, [&] { return normal(generator); }));
  };
  for (int trial = 0; trial < 10; ++trial) {
    const VectorXd x = random(3), v = random(3), u = random(2);
    const VectorXd difference = closed.residual(x, v, u, kTime) - dirac.residual(x, v, u, kTime);
    BOOST_TEST(difference.norm() < 1e-13);
  }
  // With R(x) the two differ by R dH in the first equations, and in those alone.
  const VectorXd v = VectorXd::Zero(3), u = VectorXd::Zero(2);
  const VectorXd loss =
      with_ports(std::nullopt).residual(kPoint, v, u, kTime) - dirac.residual(kPoint, v, u, kTime);
  BOOST_TEST((loss.head(3) - number(R) * dH()).norm() < kTolerance);
  BOOST_TEST(loss.tail(2).norm() == 0.0);
}

// dH/dt = ⟨y, u⟩ - dHᵀ R dH: the velocity is read off the residual, which is affine in it.
BOOST_AUTO_TEST_CASE(power_balance) {
  const auto velocity = [](const PortHamiltonianSystem& of, const VectorXd& u) {
    return VectorXd(-of.residual(kPoint, VectorXd::Zero(3), u, kTime).head(3));
  };
  const PortHamiltonianSystem open = with_ports(feedback), lossless = with_ports(feedback, {});
  const VectorXd y = values(open.output(constants(kPoint), constants(dH()), ExprVector(2)));
  for (const VectorXd& u : {VectorXd{{0.0, 0.0}}, VectorXd{{0.7, -1.1}}}) {
    const double dissipated = -power(velocity(open, u)) + y.dot(u);
    BOOST_TEST(dissipated == dH().dot(number(R) * dH()), boost::test_tools::tolerance(1e-12));
    BOOST_TEST(dissipated > 0.1);  // R ⪰ 0 takes energy out
    BOOST_TEST(std::abs(power(velocity(lossless, u)) - y.dot(u)) < kTolerance);
  }
}

// The energy is H at the point and the time, whatever u is.
BOOST_AUTO_TEST_CASE(energy_is_the_hamiltonian) {
  for (const PortHamiltonianSystem& any : {with_ports(feedback), with_ports(std::nullopt)}) {
    const auto value = any.energy(constants(kPoint), constants(VectorXd{{5.0, 6.0}}), Expr(kTime));
    BOOST_REQUIRE(value.has_value());
    BOOST_TEST(value->value() == 0.16 * -0.8 + std::cos(1.3) + kTime * -0.8,
               boost::test_tools::tolerance(1e-15));
  }
}

// On a sphere dH is the tangential part of the ambient gradient, and J = hat(x) turns it.
BOOST_AUTO_TEST_CASE(on_a_sphere) {
  const auto S2 = std::make_shared<Sphere>(2);
  const auto height = std::make_shared<Hamiltonian>(
      S2, [](const ExprVector& x, const Expr&) { return 2.0 * x[2] + square(x[0]); });
  const auto column = [](const ExprVector& x) {
    return ExprMatrix(test::hat(x).col(2));  // x × e₂, tangent
  };
  const PortHamiltonianSystem open({.J = test::hat, .R = {}, .B = column, .m = 1}, height,
                                   [](const Expr&, const ExprVector& y) { return -y; });
  const Eigen::Vector3d x(0.48, 0.6, 0.64), gradient(0.96, 0.0, 2.0);
  const Eigen::Vector3d covector = gradient - x * x.dot(gradient);
  const Eigen::Vector3d b = x.cross(Eigen::Vector3d::UnitZ());
  const double y = b.dot(covector);
  const VectorXd v = x.cross(covector) - b * y;
  BOOST_TEST(open.residual(x, v, VectorXd::Constant(1, -y), 0.0).norm() < kTolerance);
  BOOST_TEST(std::abs(y) > 0.1);
}

BOOST_AUTO_TEST_CASE(what_is_missing_is_refused) {
  const PortHamiltonianSystem::Matrices right{.J = J, .R = R, .B = B, .m = 2};
  BOOST_CHECK_THROW(PortHamiltonianSystem(right, nullptr, std::nullopt), std::invalid_argument);
  auto without_J = right, without_B = right;
  without_J.J = {};
  without_B.B = {};
  BOOST_CHECK_THROW(PortHamiltonianSystem(without_J, energy(), std::nullopt),
                    std::invalid_argument);
  BOOST_CHECK_THROW(PortHamiltonianSystem(without_B, energy(), std::nullopt),
                    std::invalid_argument);
  const auto phase_space = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(1));
  const auto with_parameters = std::make_shared<Lagrangian>(
      phase_space,
      [](const ExprVector& q, const ExprVector& w, const Expr&) { return square(w[0]) - q[0]; });
  BOOST_CHECK_THROW(
      PortHamiltonianSystem({.J = J, .R = {}, .B = B, .m = 2}, with_parameters, std::nullopt),
      std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
